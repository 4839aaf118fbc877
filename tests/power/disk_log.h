// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a disk was told, call by call, and what a power cut may leave of it:
//
//   the program ─► pwrite, ftruncate, rename, fsync ... (watched_calls.cc) ─► DiskLog ─► CutDisk ─► a folder
//
// What a sync covered is there. Of the rest every 512 bytes of a write are there, or not, or are junk; a
// change of size or of names is there or not, in any order. A sync of a file does not make its name durable:
// only a sync of its folder does. Thread: any; one log at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace relievo::test {

// Files and folders by number; the root is 0.
struct DiskTree {
  struct Node {
    bool folder = false;
    std::string bytes{};
    std::map<std::string, int> names{};
  };
  std::vector<Node> nodes;

  static DiskTree of(const std::filesystem::path& root);
  void write(const std::filesystem::path& target, int node = 0) const;  // in the place of what is there
};

struct DiskChange {
  enum class Kind : std::uint8_t { Write, Size, Names, Sync, SyncAll, Acknowledged };
  struct Name {
    int folder;
    std::string name;
    int node;  // -1: none any more
  };
  Kind kind;
  int node = -1;
  std::size_t at = 0;  // of a write; or the size; or the number of what was acknowledged
  std::string bytes{};
  std::vector<Name> names{};  // all at once
};

struct DiskLog {
  DiskTree before;
  std::vector<DiskChange> changes;
};

// Watches what is below `root` (no symbolic links) until it goes out of scope. No file there may be open yet.
class WatchedDisk {
 public:
  explicit WatchedDisk(const std::filesystem::path& root);
  ~WatchedDisk();
  WatchedDisk(const WatchedDisk&) = delete;
  WatchedDisk& operator=(const WatchedDisk&) = delete;
  void acknowledge(std::size_t number);
  const DiskLog& log() const;
  // Empty, or a file that is not as the calls would have it: one came by another way.
  std::string unseen() const;
};

// A log played again up to any point.
class CutDisk {
 public:
  explicit CutDisk(const DiskLog& log) : log_(log), disk_(log.before) {}
  void go_to(std::size_t change);  // forward only
  // Power goes before the change it stands at.
  DiskTree cut(std::uint32_t seed) const;
  // The process dies there, the system lives: all is there, half of the write it stands at.
  DiskTree killed() const;

 private:
  void sync(int node);
  const DiskLog& log_;
  DiskTree disk_;  // what is durable
  std::vector<const DiskChange*> pending_;
  std::size_t next_ = 0;
};

}  // namespace relievo::test
