// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <sqlite3.h>

#include "tests/storage/raw_database.h"

namespace relievo::storage::test {

Raw::Raw(const std::filesystem::path& file) { EXPECT_EQ(sqlite3_open(file.c_str(), &db_), SQLITE_OK); }
Raw::~Raw() { sqlite3_close_v2(db_); }

void Raw::run(const std::string& sql) {
  char* message = nullptr;
  EXPECT_EQ(sqlite3_exec(db_, sql.c_str(), nullptr, nullptr, &message), SQLITE_OK)
      << sql << ": " << (message ? message : "");
  sqlite3_free(message);
}

void Raw::run(const std::string& sql, std::span<const std::byte> blob) {
  sqlite3_stmt* statement = nullptr;
  ASSERT_EQ(sqlite3_prepare_v2(db_, sql.c_str(), -1, &statement, nullptr), SQLITE_OK) << sql;
  sqlite3_bind_blob64(statement, 1, blob.data(), blob.size(), SQLITE_STATIC);
  EXPECT_EQ(sqlite3_step(statement), SQLITE_DONE) << sqlite3_errmsg(db_);
  sqlite3_finalize(statement);
}

std::vector<std::string> Raw::rows(const std::string& sql) {
  std::vector<std::string> found;
  const auto keep = [](void* to, int count, char** values, char**) {
    std::string row;
    for (int i = 0; i < count; ++i) row += std::string(values[i] ? values[i] : "NULL") + "|";
    static_cast<std::vector<std::string>*>(to)->push_back(row);
    return 0;
  };
  EXPECT_EQ(sqlite3_exec(db_, sql.c_str(), keep, &found, nullptr), SQLITE_OK) << sql;
  return found;
}

}  // namespace relievo::storage::test
