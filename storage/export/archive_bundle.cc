// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <archive.h>
#include <archive_entry.h>

#include <algorithm>
#include <memory>

#include "storage/export/bundle.h"

namespace relievo::storage {

Result<std::vector<std::byte>> bundle_bytes(std::span<const BundleFile> files) {
  constexpr std::size_t kBlock = 512, kEnd = 20 * kBlock;  // tar's, and what a whole record may add
  std::size_t room = kEnd;
  for (const BundleFile& file : files) room += 2 * kBlock + file.bytes.size();
  std::vector<std::byte> bytes(room);
  std::size_t used = 0;
  const std::unique_ptr<archive, int (*)(archive*)> tar(archive_write_new(), archive_write_free);
  const std::unique_ptr<archive_entry, void (*)(archive_entry*)> entry(archive_entry_new(),
                                                                       archive_entry_free);
  const auto failed = [](Errc code) { return Error{code, "the files could not be put into one"}; };
  if (!tar || !entry) return failed(Errc::OutOfMemory);
  if (archive_write_set_format_ustar(tar.get()) != ARCHIVE_OK ||
      archive_write_open_memory(tar.get(), bytes.data(), bytes.size(), &used) != ARCHIVE_OK)
    return failed(Errc::OutOfMemory);
  for (const BundleFile& file : files) {
    archive_entry_clear(entry.get());
    archive_entry_set_pathname(entry.get(), file.name.c_str());
    archive_entry_set_filetype(entry.get(), AE_IFREG);
    archive_entry_set_perm(entry.get(), 0600);
    archive_entry_set_size(entry.get(), static_cast<la_int64_t>(file.bytes.size()));
    if (archive_write_header(tar.get(), entry.get()) != ARCHIVE_OK ||
        archive_write_data(tar.get(), file.bytes.data(), file.bytes.size()) !=
            static_cast<la_ssize_t>(file.bytes.size()))
      return failed(Errc::InvalidInput);
  }
  if (archive_write_close(tar.get()) != ARCHIVE_OK) return failed(Errc::OutOfMemory);
  bytes.resize(used);
  return bytes;
}

bool is_plain_name(std::string_view name) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
           c == '_' || c == '-';
  };
  return !name.empty() && name.size() <= 100 && name.front() != '.' && std::ranges::all_of(name, plain);
}

Result<std::vector<BundleFile>> bundle_files(std::span<const std::byte> tar) {
  const Error strange{
      Errc::InvalidInput,
      "this is no bundle as it was exported: it was changed or cut, or packed by another program: unpack "
      "that and give the folder"};
  const std::unique_ptr<archive, int (*)(archive*)> reader(archive_read_new(), archive_read_free);
  if (!reader || archive_read_support_format_tar(reader.get()) != ARCHIVE_OK)
    return Error{Errc::OutOfMemory, "not enough memory to read the bundle"};
  if (archive_read_open_memory(reader.get(), tar.data(), tar.size()) != ARCHIVE_OK) return strange;
  std::vector<BundleFile> files;
  std::size_t left = tar.size();  // whatever the sizes say, no more than that is read
  archive_entry* entry = nullptr;
  int told = ARCHIVE_OK;
  while ((told = archive_read_next_header(reader.get(), &entry)) == ARCHIVE_OK) {
    const char* name = archive_entry_pathname(entry);
    if (archive_entry_filetype(entry) == AE_IFDIR) return strange;  // tar packs a folder before what is in it
    if (name == nullptr || !is_plain_name(name))
      return invalid("a file of the bundle would lie outside of it: nothing was taken")
          .at(name == nullptr ? "" : name);
    if (archive_entry_filetype(entry) != AE_IFREG || archive_entry_hardlink(entry) != nullptr)
      return invalid("is no file but a link or a device: nothing was taken").at(name);
    const auto size = std::size_t(std::max<la_int64_t>(0, archive_entry_size(entry)));
    if (size > left) return strange;
    left -= size;
    BundleFile& file = files.emplace_back(BundleFile{name, std::vector<std::byte>(size)});
    if (archive_read_data(reader.get(), file.bytes.data(), size) != static_cast<la_ssize_t>(size))
      return strange;
  }
  if (told != ARCHIVE_EOF) return strange;
  // Padding, dates, owners: what no checksum covers must be as it was written, too.
  RELIEVO_TRY_ASSIGN(const auto again, bundle_bytes(files));
  if (!std::ranges::equal(again, tar)) return strange;
  return files;
}

}  // namespace relievo::storage
