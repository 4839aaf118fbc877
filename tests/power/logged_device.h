// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A power cut below a real file system: an ext4 on a device whose writes and flushes the kernel writes down
// in their order (dm-log-writes), and what power may leave of that device, mounted again by the same kernel.
//
//   the program ─► ext4 ─► dm-log-writes ─► device, log ─► LoggedDevice::play ─► another device, mounted
//
// What a flush covered is there, and what was written past the device's memory (FUA). Of each write since, so
// many of its sectors are there as chance will have it. Needs root, and a kernel that may be risked:
// toolchain/vm. Thread: one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace relievo::test {

// Whether this run is to be on one: RELIEVO_POWER_CUT_DEVICE is set.
bool on_device();

class LoggedDevice {
 public:
  // An ext4 with what is in `folder`, mounted over it. Throws std::runtime_error.
  explicit LoggedDevice(const std::filesystem::path& folder);
  ~LoggedDevice();
  LoggedDevice(const LoggedDevice&) = delete;
  LoggedDevice& operator=(const LoggedDevice&) = delete;

  void acknowledge();
  // At any time, anywhere on the device; known once it was played.
  bool wrote(std::string_view text) const { return log_.find(text) != std::string::npos; }

  struct Cut {
    std::size_t entry;  // of the log
    std::size_t done;   // acknowledged before it
    bool acknowledged;  // the last of them just there
    std::string how;
  };
  // At every flush and acknowledgement: nothing of what was not flushed, and `seeds` times a part of it. Each
  // different disk is looked at once, until `look` says false. Returns how many cuts there were.
  long play(std::uint32_t seeds,
            const std::function<bool(const std::filesystem::path& mounted, const Cut&)>& look);

 private:
  struct Entry {
    std::uint64_t sector, sectors, flags;
    std::size_t data;  // where in the log
  };
  std::vector<Entry> entries() const;
  void apply(std::string& disk, const Entry& entry, std::uint64_t sectors) const;
  std::size_t hash_of(const std::string& disk) const;
  void mount_copy(const std::string& disk, const std::filesystem::path& place) const;

  TemporaryFolder work_;
  std::filesystem::path folder_;
  std::string name_, durable_, log_;
  std::vector<std::size_t> blocks_;  // that are ever written
  std::size_t acknowledged_ = 0;
};

}  // namespace relievo::test
