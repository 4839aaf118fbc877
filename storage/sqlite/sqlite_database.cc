// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "storage/sqlite/sqlite_database.h"

#include <sqlite3.h>

#include <algorithm>
#include <cerrno>

#include "hal/base/words.h"

namespace relievo::storage {
namespace {

constexpr std::size_t kBlobPieceBytes = 256 * 1024 + 64;  // as large as a sealed piece (cipher/seal.h)

// Null: it is not open.
sqlite3_file* log_of(sqlite3* db) {
  sqlite3_file* log = nullptr;
  const int code = sqlite3_file_control(db, "main", SQLITE_FCNTL_JOURNAL_POINTER, &log);
  return code == SQLITE_OK && log != nullptr && log->pMethods != nullptr ? log : nullptr;
}

// SQLite's own sqlite3_system_errno() forgets while it rolls back; the files remember.
int system_errno_of(sqlite3* db) {
  if (db == nullptr) return 0;
  int cause = sqlite3_system_errno(db);
  if (cause == 0) sqlite3_file_control(db, "main", SQLITE_FCNTL_LAST_ERRNO, &cause);
  if (sqlite3_file* log = cause == 0 ? log_of(db) : nullptr)
    log->pMethods->xFileControl(log, SQLITE_FCNTL_LAST_ERRNO, &cause);
  return cause;
}

constexpr Meaning kMeanings[] = {
    {{SQLITE_FULL},
     Errc::MediaFull,
     "the disk is full, nothing was changed: erase subjects or make room, then try again"},
    {{SQLITE_INTERRUPT}, Errc::Cancelled, "was stopped; nothing was changed"},
    {{SQLITE_NOMEM}, Errc::OutOfMemory, "not enough memory for this; nothing was changed"},
    {{SQLITE_BUSY, SQLITE_LOCKED},
     Errc::Timeout,
     "another program is using the store: close it, then try again"},
    {{SQLITE_CORRUPT, SQLITE_NOTADB},
     Errc::StoreCorrupt,
     "the store is damaged: stop using it and restore a copy"},
    {{SQLITE_IOERR, SQLITE_CANTOPEN},
     Errc::IoFailed,
     "the disk could not be read or written: check the disk and its permissions"},
    {{SQLITE_READONLY, SQLITE_PERM, SQLITE_AUTH},
     Errc::IoFailed,
     "the store may not be written here: check owner and permissions"},
    {{SQLITE_TOOBIG}, Errc::InvalidInput, "this is larger than the store takes"},
    {{}, Errc::LibraryFailed, "SQLite refused a request; please report this"}};

// The error for what `code` says; `where` is the store's path.
Error sqlite_error(int code, int system_errno, std::string_view where) {
  const bool full = system_errno == ENOSPC || system_errno == EDQUOT || system_errno == EFBIG;
  const int family = code & 0xff;
  if (code == SQLITE_IOERR_NOMEM) code = SQLITE_NOMEM;
  else if (full && (family == SQLITE_IOERR || family == SQLITE_CANTOPEN)) code = SQLITE_FULL;
  Error error = meaning_of(code & 0xff, kMeanings).at(where);
  error.sys_errno = system_errno;
  return error;
}

}  // namespace

Statement::~Statement() { sqlite3_finalize(handle_); }

Statement& Statement::note(int code) {
  if (code != SQLITE_OK && bind_code_ == SQLITE_OK) bind_code_ = code;
  return *this;
}
Statement& Statement::bind(std::int64_t value) { return note(sqlite3_bind_int64(handle_, ++bound_, value)); }
Statement& Statement::bind(std::string_view text) {
  // An empty view may carry a null pointer, which would mean NULL.
  return note(sqlite3_bind_text64(handle_, ++bound_, text.empty() ? "" : text.data(), text.size(),
                                  SQLITE_STATIC, SQLITE_UTF8));
}
Statement& Statement::bind(std::span<const std::byte> blob) {
  return note(sqlite3_bind_blob64(handle_, ++bound_,
                                  blob.empty() ? reinterpret_cast<const std::byte*>("") : blob.data(),
                                  blob.size(), SQLITE_STATIC));
}
Statement& Statement::bind(Zeros zeros) {
  return note(sqlite3_bind_zeroblob64(handle_, ++bound_, static_cast<sqlite3_uint64>(zeros.bytes)));
}

Result<bool> Statement::step() {
  if (bind_code_ != SQLITE_OK) return sqlite_error(bind_code_, 0, where_);
  const int code = sqlite3_step(handle_);
  if (code == SQLITE_ROW) return true;
  if (code == SQLITE_DONE) return false;
  sqlite3* db = sqlite3_db_handle(handle_);
  return sqlite_error(sqlite3_extended_errcode(db), system_errno_of(db), where_);
}

Result<void> Statement::run() {
  for (;;) {
    RELIEVO_TRY_ASSIGN(const bool row, step());
    if (!row) return {};
  }
}

void Statement::again() {
  sqlite3_reset(handle_);
  bound_ = 0;
}

std::int64_t Statement::integer(int column) const { return sqlite3_column_int64(handle_, column); }
std::string_view Statement::text(int column) const {
  // Out of memory while converting yields null: what follows fails at the next step().
  const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(handle_, column));
  return text == nullptr ? std::string_view{}
                         : std::string_view(text, std::size_t(sqlite3_column_bytes(handle_, column)));
}
std::span<const std::byte> Statement::blob(int column) const {
  const auto* bytes = static_cast<const std::byte*>(sqlite3_column_blob(handle_, column));
  return {bytes, bytes == nullptr ? 0 : std::size_t(sqlite3_column_bytes(handle_, column))};
}

Database::~Database() { close(); }

void Database::close() {
  sqlite3_close_v2(handle_);
  handle_ = nullptr;
}

Result<void> Database::open(bool writable) {
  const int flags = SQLITE_OPEN_NOFOLLOW | SQLITE_OPEN_FULLMUTEX | SQLITE_OPEN_EXRESCODE |
                    (writable ? SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE : SQLITE_OPEN_READONLY);
  RELIEVO_TRY(done(sqlite3_open_v2(where_.c_str(), &handle_, flags, nullptr)));
  // A store is data, never a program: no schema in it may run what we did not write.
  for (const auto& [option, value] : {std::pair{SQLITE_DBCONFIG_DEFENSIVE, 1},
                                      {SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0},
                                      {SQLITE_DBCONFIG_ENABLE_FKEY, 1},
                                      {SQLITE_DBCONFIG_ENABLE_TRIGGER, 0},
                                      {SQLITE_DBCONFIG_ENABLE_VIEW, 0},
                                      {SQLITE_DBCONFIG_ENABLE_LOAD_EXTENSION, 0},
                                      {SQLITE_DBCONFIG_DQS_DDL, 0},
                                      {SQLITE_DBCONFIG_DQS_DML, 0}}) {
    RELIEVO_TRY(done(sqlite3_db_config(handle_, option, value, nullptr)));
  }
  return tidy_up_on_close(false);
}

Result<void> Database::tidy_up_on_close(bool on) {
  return done(sqlite3_db_config(handle_, SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, on ? 0 : 1, nullptr));
}

void Database::stop_at(const std::atomic<bool>* flag) {
  constexpr int kSteps = 1000;  // of SQLite's machine: a millisecond at most
  stop_ = flag;
  sqlite3_progress_handler(
      handle_, flag != nullptr ? kSteps : 0,
      [](void* stop) -> int { return static_cast<Database*>(stop)->stop_->load(); }, this);
}

Result<void> Database::go_on() const {
  return stop_ != nullptr && stop_->load() ? sqlite_error(SQLITE_INTERRUPT, 0, where_) : Result<void>();
}

Result<bool> Database::empty_log() {
  RELIEVO_TRY_ASSIGN(const std::int64_t busy, integer("PRAGMA wal_checkpoint(TRUNCATE)"));
  if (busy != 0) return false;
  // SQLite cuts it off and leaves it to the system when: until then a power cut brings all of it back.
  sqlite3_file* log = log_of(handle_);
  if (log != nullptr) RELIEVO_TRY(done(log->pMethods->xSync(log, SQLITE_SYNC_FULL)));
  return true;
}

Result<void> Database::done(int code) const { return code == SQLITE_OK ? Result<void>() : error(code); }
Error Database::error(int code) const { return sqlite_error(code, system_errno_of(handle_), where_); }
Error Database::error() const { return error(sqlite3_extended_errcode(handle_)); }

Result<void> Database::run(const char* sql) {
  return done(sqlite3_exec(handle_, sql, nullptr, nullptr, nullptr));
}

Result<Statement> Database::compile(std::string_view sql) {
  sqlite3_stmt* handle = nullptr;
  RELIEVO_TRY(done(sqlite3_prepare_v2(handle_, sql.data(), int(sql.size()), &handle, nullptr)));
  return Statement(handle, where_);
}

std::int64_t Database::last_row_id() const { return sqlite3_last_insert_rowid(handle_); }
std::int64_t Database::changes() const { return sqlite3_changes64(handle_); }
bool Database::in_transaction() const { return sqlite3_get_autocommit(handle_) == 0; }

Result<Blob> Blob::open(Database& database, const char* table, const char* column, std::int64_t row,
                        bool writable) {
  sqlite3_blob* handle = nullptr;
  const int code = sqlite3_blob_open(database.handle_, "main", table, column, row, writable ? 1 : 0, &handle);
  Blob blob(database, handle);
  RELIEVO_TRY(database.done(code));
  return blob;
}

Blob::~Blob() { sqlite3_blob_close(handle_); }

std::size_t Blob::size() const { return std::size_t(sqlite3_blob_bytes(handle_)); }

Result<void> Blob::write(std::size_t at, std::span<const std::byte> bytes) {
  for (std::size_t done = 0; done < bytes.size(); done += kBlobPieceBytes) {
    const auto piece = bytes.subspan(done, std::min(kBlobPieceBytes, bytes.size() - done));
    RELIEVO_TRY(database_.done(sqlite3_blob_write(handle_, piece.data(), int(piece.size()), int(at + done))));
  }
  return {};
}

Result<void> Blob::read(std::size_t at, std::span<std::byte> bytes) {
  if (size() < at + bytes.size()) return database_.error(SQLITE_CORRUPT);
  for (std::size_t done = 0; done < bytes.size(); done += kBlobPieceBytes) {
    const auto piece = bytes.subspan(done, std::min(kBlobPieceBytes, bytes.size() - done));
    RELIEVO_TRY(database_.done(sqlite3_blob_read(handle_, piece.data(), int(piece.size()), int(at + done))));
  }
  return {};
}

Result<void> Database::copy_to(const std::filesystem::path& target) {
  Database copy(target);
  RELIEVO_TRY(copy.open(true));
  sqlite3_backup* backup = sqlite3_backup_init(copy.handle_, "main", handle_, "main");
  if (backup == nullptr) return copy.error();
  sqlite3_backup_step(backup, -1);
  const int code = sqlite3_backup_finish(backup);
  if (code != SQLITE_OK) return sqlite_error(code, system_errno_of(copy.handle_), copy.where());
  RELIEVO_TRY(copy.tidy_up_on_close(true));
  return copy.run("PRAGMA journal_mode = DELETE");  // one file, nothing beside it
}

Result<void> Database::lie_in(std::span<std::byte> room, std::size_t used, bool writable) {
  return done(sqlite3_deserialize(handle_, "main", reinterpret_cast<unsigned char*>(room.data()),
                                  static_cast<sqlite3_int64>(used), static_cast<sqlite3_int64>(room.size()),
                                  writable ? 0 : SQLITE_DESERIALIZE_READONLY));
}

Transaction::~Transaction() {
  // Some errors have rolled back already; where this fails, the next begin() or close() does it.
  if (open_ && database_.in_transaction()) (void)database_.run("ROLLBACK");
}

Result<void> Transaction::begin() {
  // A rollback may have failed for want of memory: it is made up for here.
  if (database_.in_transaction()) RELIEVO_TRY(database_.run("ROLLBACK"));
  RELIEVO_TRY(database_.run("BEGIN IMMEDIATE"));
  open_ = true;
  return {};
}

Result<void> Transaction::commit() {
  RELIEVO_TRY(database_.run("COMMIT"));
  open_ = false;
  return {};
}

}  // namespace relievo::storage
