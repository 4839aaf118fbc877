// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/service/stick_folder.h"

#include <string>
#include <system_error>
#include <vector>

#include "storage/export/atomic_file.h"

namespace relievo::firmware {
namespace {

namespace fs = std::filesystem;

constexpr const char* kBefore = ".before";

fs::path before(const fs::path& target) {
  return target.parent_path() / ("." + target.filename().string() + kBefore);
}

// The name in ".NAME.part123" or ".NAME.before"; empty in any other.
std::string name_in(const std::string& entry) {
  const std::size_t end =
      entry.ends_with(kBefore) ? entry.size() - std::string_view(kBefore).size() : entry.rfind(".part");
  return entry.starts_with('.') && end != std::string::npos && end > 1 ? entry.substr(1, end - 1)
                                                                       : std::string();
}

}  // namespace

Result<void> replace_folder(OutputFolder& made, const fs::path& target) {
  std::error_code error;
  const bool replaces = fs::exists(target, error);
  if (replaces) {
    fs::rename(target, before(target), error);
    if (error)
      return Error{Errc::IoFailed, "the folder of an earlier export cannot be replaced: use another stick",
                   error.value()}
          .at(target.native());
  }
  if (const Result<void> done = made.commit(); !done) {
    if (replaces) fs::rename(before(target), target, error);
    return done;
  }
  RELIEVO_TRY(storage::sync_directory(target.parent_path()));
  fs::remove_all(before(target), error);
  return {};
}

void tidy_folder(const fs::path& folder, bool (*ours)(std::string_view name)) {
  std::error_code error;
  std::vector<fs::path> left;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = name_in(entry->path().filename().string());
    if (!name.empty() && ours(name)) left.push_back(entry->path());
  }
  for (const fs::path& one : left) {
    const fs::path target = folder / name_in(one.filename().string());
    if (one.filename().string().ends_with(kBefore) && !fs::exists(target, error))
      fs::rename(one, target, error);
    else fs::remove_all(one, error);
  }
}

}  // namespace relievo::firmware
