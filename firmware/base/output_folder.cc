// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/base/output_folder.h"

#include <cerrno>
#include <charconv>
#include <span>
#include <string>
#include <system_error>
#include <utility>

#include <signal.h>
#include <unistd.h>

#include "hal/base/whole_file.h"
#include "storage/store_folder.h"

namespace relievo::firmware {
namespace {

namespace fs = std::filesystem;

Error failed(const fs::path& place, int number) {
  Error error = number == ENOSPC || number == EDQUOT
                    ? Error{Errc::MediaFull, "the disk is full: make room or choose another folder", number}
                : number == EACCES || number == EROFS || number == EPERM
                    ? Error{Errc::IoFailed, "may not be written: choose a folder you own", number}
                    : Error{Errc::IoFailed, "cannot be written: check the disk and the path", number};
  return error.at(place.native());
}

// The topmost folder on the way to `folder` that does not exist yet; empty when all do.
fs::path first_missing(fs::path folder) {
  fs::path missing;
  std::error_code ignored;
  while (!folder.empty() && !fs::exists(folder, ignored)) {
    missing = folder;
    folder = folder.parent_path();
  }
  return missing;
}

// What runs that were killed have left: there may be a face in it.
void remove_abandoned(const fs::path& parent, const std::string& prefix) {
  std::error_code error, ignored;
  fs::directory_iterator entry(parent, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (!name.starts_with(prefix)) continue;
    pid_t process = 0;
    const auto [end, wrong] =
        std::from_chars(name.data() + prefix.size(), name.data() + name.size(), process);
    if (wrong != std::errc() || end != name.data() + name.size() || process <= 0) continue;
    const bool gone = process == ::getpid() || (::kill(process, 0) != 0 && errno == ESRCH);
    if (gone) fs::remove_all(entry->path(), ignored);
  }
}

}  // namespace

Result<OutputFolder> OutputFolder::begin(const fs::path& target) {
  std::error_code error;
  OutputFolder folder;
  folder.target_ = fs::absolute(target, error).lexically_normal();
  if (error) return failed(target, error.value());  // no name, or the current folder has been removed
  if (folder.target_.filename().empty()) folder.target_ = folder.target_.parent_path();  // "out/"
  if (fs::exists(folder.target_, error) && !fs::is_directory(folder.target_, error)) {
    return invalid("is a file, not a folder: choose another name").at(target.native());
  }
  if (storage::is_store_folder(folder.target_))
    return invalid("holds a store or its key: choose another folder").at(target.native());
  const fs::path parent = folder.target_.parent_path();
  folder.made_parent_ = first_missing(parent);
  const std::string prefix = "." + folder.target_.filename().string() + ".part";
  folder.work_ = parent / (prefix + std::to_string(getpid()));
  remove_abandoned(parent, prefix);
  fs::create_directories(folder.work_, error);
  if (error) return failed(target, error.value());
  return folder;
}

OutputFolder::OutputFolder(OutputFolder&& other) noexcept
    : target_(std::move(other.target_)),
      work_(std::exchange(other.work_, {})),
      made_parent_(std::exchange(other.made_parent_, {})) {}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  if (!work_.empty()) fs::remove_all(work_, ignored);
  // Only what is empty: somebody else may have begun to use the folders in the meantime.
  for (fs::path parent = target_.parent_path(); !made_parent_.empty(); parent = parent.parent_path()) {
    if (!fs::remove(parent, ignored) || parent == made_parent_) break;
  }
}

Result<void> OutputFolder::commit() {
  std::error_code error;
  if (!fs::exists(target_, error)) {
    fs::rename(work_, target_, error);
    if (error) return failed(target_, error.value());
    work_.clear();
    RELIEVO_TRY(sync_renamed(target_));
    // The folders that were made on the way have names, too.
    const fs::path made = std::exchange(made_parent_, {});
    if (made.empty()) return {};
    for (fs::path one = target_.parent_path(); one != made.parent_path(); one = one.parent_path())
      RELIEVO_TRY(sync_directory(one.parent_path()));
    return {};
  }
  fs::directory_iterator entry(work_, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    const fs::path to = target_ / entry->path().filename();
    fs::rename(entry->path(), to, error);
    if (error) return failed(to, error.value());
  }
  // What could not be listed has not been moved, and would go with this.
  if (error) return failed(target_, error.value());
  return sync_directory(target_);
}

Result<void> write_text(const fs::path& file, std::string_view text, const fs::path& place) {
  return write_whole_file(file, std::as_bytes(std::span(text))).at(place.native());
}

}  // namespace relievo::firmware
