// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <system_error>

#include "firmware/base/output_folder.h"
#include "firmware/records/bundle_manifest.h"
#include "hal/base/whole_file.h"

namespace relievo::firmware {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostFileBytes = std::size_t{1} << 31, kMostFiles = 100;

}  // namespace

Result<Sums> sums_of(const fs::path& folder) {
  Sums sums;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    RELIEVO_TRY_ASSIGN(const auto bytes, read_whole_file(entry->path(), kMostFileBytes));
    sums[entry->path().filename().string()] = storage::sha256(bytes);
  }
  if (error) return Error{Errc::IoFailed, "the folder cannot be read back", error.value()};
  return sums;
}

Result<void> write_manifest(storage::Store& store, const CopyOf& of, const fs::path& folder,
                            const fs::path& place) {
  RELIEVO_TRY_ASSIGN(Sums sums, sums_of(folder));
  RELIEVO_TRY_ASSIGN(const auto files, manifest_files(store, of, std::move(sums)));
  for (const storage::BundleFile& file : files)
    if (const auto written = write_whole_file(folder / file.name, file.bytes); !written)
      return written.error().at(place.native());
  return {};
}

Result<std::vector<storage::BundleFile>> read_bundle_folder(const fs::path& folder) {
  std::vector<storage::BundleFile> files;
  std::size_t left = kMostFileBytes;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (name.starts_with('.')) continue;  // what a computer leaves behind
    if (!storage::is_plain_name(name) || files.size() == kMostFiles ||
        !fs::is_regular_file(fs::symlink_status(entry->path(), error)))
      return Error{Errc::InvalidInput, "is no file as it was exported: nothing was taken"}.at(name);
    RELIEVO_TRY_ASSIGN(auto bytes, read_whole_file(entry->path(), left));
    left -= bytes.size();
    files.push_back({name, std::move(bytes)});
  }
  if (error) return Error{Errc::IoFailed, "the folder cannot be read", error.value()}.at(folder.native());
  return files;
}

}  // namespace relievo::firmware
