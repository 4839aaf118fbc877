// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// SQLite, as this room wants it: handles that close themselves, results instead of codes.
//
// Errors: what SQLite says, told apart by what a person can do: MediaFull, IoFailed, Timeout (held by
// another program), StoreCorrupt, OutOfMemory, LibraryFailed (a bug of ours).
// Thread: one at a time.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "hal/base/result.h"

struct sqlite3;
struct sqlite3_blob;
struct sqlite3_stmt;

namespace relievo::storage {

struct Zeros {  // a blob of so many, to be written afterwards
  std::int64_t bytes = 0;
};

// One prepared statement. Bound text and blobs are borrowed until the last step().
class Statement {
 public:
  Statement(sqlite3_stmt* handle, std::string_view where) : handle_(handle), where_(where) {}
  ~Statement();
  Statement(Statement&& other) noexcept
      : handle_(std::exchange(other.handle_, nullptr)),
        where_(other.where_),
        bound_(other.bound_),
        bind_code_(other.bind_code_) {}
  Statement& operator=(Statement&&) = delete;

  // Placeholders are filled in order, from the first. A failure shows at step().
  Statement& bind(std::int64_t value);
  Statement& bind(std::string_view text);
  Statement& bind(std::span<const std::byte> blob);
  Statement& bind(Zeros zeros);

  Result<bool> step();  // true: there is a row
  Result<void> run();   // to the end, without rows
  void again();         // to be bound and run once more

  std::int64_t integer(int column) const;
  // Valid until the next step().
  std::string_view text(int column) const;
  std::span<const std::byte> blob(int column) const;

 private:
  Statement& note(int code);
  sqlite3_stmt* handle_;
  std::string_view where_;
  int bound_ = 0;
  int bind_code_ = 0;
};

class Database {
 public:
  explicit Database(std::filesystem::path file) : file_(std::move(file)), where_(file_.string()) {}
  ~Database();
  Database& operator=(Database&&) = delete;

  // Opens without changing a byte of it; a missing file is made only if `writable`.
  Result<void> open(bool writable);
  void close();

  Result<void> run(const char* sql);  // one or more statements without parameters
  // The values take the places of the placeholders, in their order.
  template <typename... Values>
  Result<Statement> prepare(std::string_view sql, const Values&... values) {
    RELIEVO_TRY_ASSIGN(auto statement, compile(sql));
    (statement.bind(values), ...);
    return statement;
  }
  template <typename First, typename... Rest>
  Result<void> run(std::string_view sql, const First& first, const Rest&... rest) {
    RELIEVO_TRY_ASSIGN(auto statement, prepare(sql, first, rest...));
    return statement.run();
  }
  // At its first row; none where there is none.
  template <typename... Values>
  Result<std::optional<Statement>> row(std::string_view sql, const Values&... values) {
    RELIEVO_TRY_ASSIGN(auto statement, prepare(sql, values...));
    RELIEVO_TRY_ASSIGN(const bool there, statement.step());
    return there ? std::optional(std::move(statement)) : std::nullopt;
  }
  // `of` is given every row; an error of it is the last one's.
  template <typename Of, typename... Values>
  Result<void> each(std::string_view sql, const Of& of, const Values&... values) {
    RELIEVO_TRY_ASSIGN(auto statement, prepare(sql, values...));
    for (;;) {
      RELIEVO_TRY_ASSIGN(const bool there, statement.step());
      if (!there) return {};
      if constexpr (std::is_void_v<decltype(of(std::as_const(statement)))>) of(std::as_const(statement));
      else RELIEVO_TRY(of(std::as_const(statement)));
    }
  }
  // The first column of the first row; 0 if there is none.
  template <typename... Values>
  Result<std::int64_t> integer(std::string_view sql, const Values&... values) {
    RELIEVO_TRY_ASSIGN(const auto first, row(sql, values...));
    return first ? first->integer(0) : 0;
  }
  std::int64_t last_row_id() const;
  std::int64_t changes() const;
  bool in_transaction() const;
  // Soon after the flag is true, what runs ends with Cancelled: a long statement by itself, a loop over rows
  // where it calls go_on(). The flag is borrowed until stop_at(nullptr).
  void stop_at(const std::atomic<bool>* flag);
  Result<void> go_on() const;
  // Whether closing moves the write-ahead log into the file: off until it is known to be ours.
  Result<void> tidy_up_on_close(bool on);
  // Moves the write-ahead log into the file; on the disk nothing is left in it. false: a reader is in the
  // way.
  Result<bool> empty_log();

  Result<void> copy_to(const std::filesystem::path& target);
  // Of an open database: from now on it is the first `used` of these bytes, borrowed until it is closed, and
  // touches no disk. `writable`: it may grow to all of them.
  Result<void> lie_in(std::span<std::byte> room, std::size_t used, bool writable);

  const std::filesystem::path& file() const { return file_; }
  std::string_view where() const { return where_; }
  Error error() const;  // for what failed last
  Error error(Errc code, Literal what) const { return Error{code, what}.at(where_); }

 private:
  friend class Blob;
  Result<void> done(int code) const;  // of what SQLite answered
  Error error(int code) const;
  Result<Statement> compile(std::string_view sql);
  sqlite3* handle_ = nullptr;
  const std::atomic<bool>* stop_ = nullptr;
  std::filesystem::path file_;
  std::string where_;
};

// One blob, read or written in pieces, so that SQLite never holds a second copy of a model.
class Blob {
 public:
  static Result<Blob> open(Database& database, const char* table, const char* column, std::int64_t row,
                           bool writable);
  ~Blob();
  Blob(Blob&& other) noexcept : database_(other.database_), handle_(std::exchange(other.handle_, nullptr)) {}
  Blob& operator=(Blob&&) = delete;

  std::size_t size() const;
  Result<void> write(std::size_t at, std::span<const std::byte> bytes);
  Result<void> read(std::size_t at, std::span<std::byte> bytes);

 private:
  Blob(Database& database, sqlite3_blob* handle) : database_(database), handle_(handle) {}
  Database& database_;
  sqlite3_blob* handle_;
};

// BEGIN IMMEDIATE ... COMMIT; rolls back unless commit() succeeded.
class Transaction {
 public:
  explicit Transaction(Database& database) : database_(database) {}
  ~Transaction();
  Transaction& operator=(Transaction&&) = delete;

  Result<void> begin();
  Result<void> commit();

 private:
  Database& database_;
  bool open_ = false;
};

// What every verb runs in: memory that runs out below is an error like another.
template <typename Work>
auto without_exceptions(std::string_view where, const Work& work) -> decltype(work()) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    return Error{Errc::OutOfMemory, "not enough memory for this; nothing was changed"}.at(where);
  }
}

}  // namespace relievo::storage
