// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// TemporaryFolder: a folder of the test's own, gone with it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace relievo::test {

class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

// A disk of a few kilobytes, to be filled: a tmpfs, which only root may mount.
class TinyDisk {
 public:
  explicit TinyDisk(std::size_t bytes);
  ~TinyDisk();
  TinyDisk(const TinyDisk&) = delete;
  TinyDisk& operator=(const TinyDisk&) = delete;
  bool mounted() const { return mounted_; }
  // Nothing can be written to it any more, or again.
  bool protect(bool on) const;
  std::string why_not() const { return "mounting a small tmpfs needs root"; }
  const std::filesystem::path& path() const { return folder_.path(); }

 private:
  TemporaryFolder folder_;
  bool mounted_ = false;
};

// Everything in a folder, hidden files too, by its path from there, sorted.
std::string listing(const std::filesystem::path& folder);
void write_text(const std::filesystem::path& file, const std::string& text);
std::string read_text(const std::filesystem::path& file);

}  // namespace relievo::test
