// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// MountedStick: the stick that the system has mounted, at a folder or, as udisks does, in one below it. The
// system mounts; this looks, flushes and unmounts; and mounts it once more, to be read only, for who wants to
// know what it has kept. Thread: any.
#pragma once

#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "hal/removable_media.h"

namespace relievo::hal {

// What is mounted at a folder.
struct MountSource {
  std::string device;  // "/dev/sdb1"
  std::string type;    // of its file system, "vfat"
};

// The system calls, behind a seam. Errors are negative errnos.
class Mounts {
 public:
  virtual ~Mounts() = default;
  virtual bool is_mounted(const std::filesystem::path& folder) = 0;  // something, at this very folder
  virtual int flush(const std::filesystem::path& folder) = 0;        // syncfs
  virtual int unmount(const std::filesystem::path& folder) = 0;      // umount2, never lazily
  virtual std::optional<MountSource> source_of(
      const std::filesystem::path& folder) = 0;  // /proc/self/mountinfo
  virtual int mount_read_only(const MountSource& source,
                              const std::filesystem::path& folder) = 0;  // mount, nosuid, nodev, noexec
};
Mounts& real_mounts();
// Of a table in the form of /proc/self/mountinfo (proc(5)), the newest entry of this folder.
std::optional<MountSource> source_in(std::string_view mountinfo, std::string_view folder);

class MountedStick final : public RemovableMedia {
 public:
  // An empty folder: there is never a stick.
  explicit MountedStick(std::filesystem::path folder, Mounts& mounts = real_mounts())
      : folder_(std::move(folder)), mounts_(mounts) {}

  // Of several sticks the first by name. It waits for an unmount, never for a flush: the main thread asks.
  std::optional<std::filesystem::path> current() override;
  // Errors: MediaMissing (none, or pulled out meanwhile), IoFailed (not flushed: nothing written can be
  // trusted; still in use; not allowed).
  Result<void> flush_and_eject() override;
  // Where it was. Errors: MediaMissing (none was ejected, or it was pulled out meanwhile), Unsupported (the
  // system does not mount it).
  Result<void> take_up_again() override;
  bool is_taken_up() override;

 private:
  struct Ejected {
    MountSource source;
    std::filesystem::path root;
  };
  std::optional<std::filesystem::path> find() const;  // with mutex_
  std::mutex mutex_;  // nobody looks into a stick while it is unmounted or mounted; ejected_, taken_up_
  std::optional<Ejected> ejected_;
  std::optional<std::filesystem::path> taken_up_;  // where, until it is away
  std::filesystem::path folder_;
  Mounts& mounts_;
};

}  // namespace relievo::hal
