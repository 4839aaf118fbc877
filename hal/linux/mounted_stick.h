// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// MountedStick: the stick that the system has mounted, at a folder or, as udisks does, in one below it. The system mounts; this looks,
// flushes and unmounts. Thread: any.
#pragma once

#include <mutex>
#include <string>

#include "hal/removable_media.h"

namespace relievo::hal {

// The system calls, behind a seam. Errors are negative errnos.
class Mounts {
 public:
  virtual ~Mounts() = default;
  // Whether something is mounted at this very folder, and what room it has.
  virtual std::optional<std::uint64_t> free_at(const std::filesystem::path& folder) = 0;
  virtual int flush(const std::filesystem::path& folder) = 0;     // syncfs
  virtual int unmount(const std::filesystem::path& folder) = 0;   // umount2, never lazily
};
Mounts& real_mounts();

class MountedStick final : public RemovableMedia {
 public:
  explicit MountedStick(std::filesystem::path folder, Mounts& mounts = real_mounts()) : folder_(std::move(folder)), mounts_(mounts) {}

  // Of several sticks the first by name.
  std::optional<Medium> current() override;
  // Errors: MediaMissing (none, or pulled out meanwhile), IoFailed (not flushed: nothing written can be trusted; still in use; not allowed).
  Result<void> flush_and_eject() override;

 private:
  std::optional<Medium> find() const;
  std::mutex mutex_;
  std::filesystem::path folder_;
  Mounts& mounts_;
};

}  // namespace relievo::hal
