// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "storage/store_folder.h"

#include <system_error>

namespace relievo::storage {

bool is_store_folder(const std::filesystem::path& folder) {
  std::error_code ignored;
  return std::filesystem::exists(folder / kLockFile, ignored) ||
         std::filesystem::exists(folder / kKeyFile, ignored);
}

Result<void> must_lie_outside_stores(const std::filesystem::path& file) {
  if (!is_store_folder(file.has_parent_path() ? file.parent_path() : std::filesystem::path("."))) return {};
  return Error{Errc::InvalidInput, "lies among a store's own files: choose another folder"}.at(file.native());
}

}  // namespace relievo::storage
