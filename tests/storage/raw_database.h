// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A store's file as anybody's sqlite3 opens it: to look at what lies on the disk, and to tamper with it. What
// fails, fails the test.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

struct sqlite3;

namespace relievo::storage::test {

class Raw {
 public:
  explicit Raw(const std::filesystem::path& file);
  ~Raw();
  Raw(const Raw&) = delete;
  Raw& operator=(const Raw&) = delete;
  void run(const std::string& sql);
  void run(const std::string& sql, std::span<const std::byte> blob);  // one statement with one blob in it
  // Rows as text, columns joined by bars.
  std::vector<std::string> rows(const std::string& sql);

 private:
  sqlite3* db_ = nullptr;
};

}  // namespace relievo::storage::test
