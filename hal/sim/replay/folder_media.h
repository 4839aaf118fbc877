// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// FolderMedia: a folder that plays the USB stick. plug() and unplug() are what a hand would do.
// Thread: any.
#pragma once

#include <mutex>

#include "hal/removable_media.h"

namespace relievo::hal {

class FolderMedia final : public RemovableMedia {
 public:
  FolderMedia() = default;
  explicit FolderMedia(std::filesystem::path root) { plug(std::move(root)); }

  void plug(std::filesystem::path root);
  void unplug();

  std::optional<Medium> current() override;  // nothing when unplugged or the folder is gone
  Result<void> flush_and_eject() override;   // MediaMissing, IoFailed
  Result<void> take_up_again() override;     // MediaMissing

 private:
  std::mutex mutex_;
  std::optional<std::filesystem::path> root_, ejected_;
};

}  // namespace relievo::hal
