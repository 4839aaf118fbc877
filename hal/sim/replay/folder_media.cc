// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/sim/replay/replay_device.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace relievo::hal {

void FolderMedia::plug(std::filesystem::path root) {
  const std::lock_guard lock(mutex_);
  root_ = std::move(root);
  ejected_.reset();
}

void FolderMedia::unplug() {
  const std::lock_guard lock(mutex_);
  root_.reset();
  ejected_.reset();
}

std::optional<std::filesystem::path> FolderMedia::current() {
  const std::lock_guard lock(mutex_);
  std::error_code failed;
  return root_ && std::filesystem::is_directory(*root_, failed) ? root_ : std::nullopt;
}

Result<void> FolderMedia::flush_and_eject() {
  const std::lock_guard lock(mutex_);
  if (!root_) return Error{Errc::MediaMissing, "there is no stick to eject"};
  const int folder = ::open(root_->c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return Error{Errc::MediaMissing, "the stick is gone", errno}.at(root_->native());
  const int failed = ::syncfs(folder) == 0 ? 0 : errno;
  ::close(folder);
  if (failed != 0)
    return Error{Errc::IoFailed, "the stick could not be flushed; do not trust what was written", failed}.at(
        root_->native());
  ejected_ = std::exchange(root_, std::nullopt);
  return {};
}

Result<void> FolderMedia::take_up_again() {
  const std::lock_guard lock(mutex_);
  std::error_code error;
  if (!ejected_ || !std::filesystem::is_directory(*ejected_, error))
    return Error{Errc::MediaMissing, "the stick is gone"};
  root_ = std::exchange(ejected_, std::nullopt);
  return {};
}

}  // namespace relievo::hal
