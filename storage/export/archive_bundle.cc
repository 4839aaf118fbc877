// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <archive.h>
#include <archive_entry.h>

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

}  // namespace relievo::storage
