// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "storage/sqlite/sqlite_parts.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <string>

#include "hal/base/whole_file.h"
#include "storage/byte_order.h"
#include "storage/sodium_sha256.h"

namespace relievo::storage {
namespace {

constexpr off_t kRecordBytes = 8 + sizeof(KeyedHash);
constexpr std::size_t kMostListBytes = 64'000'000;  // a million people and a half

std::filesystem::path list_of(const Database& database) {
  return database.file().parent_path() / "relievo.erased";
}

// Of the hash of the person's code, which nobody has a second time: not of a number, which a copy may give
// again.
KeyedHash trace_of(const StoreKeys& keys, std::span<const std::byte> code_hash) {
  return keyed_hash(keys.chain(), code_hash);
}

Result<std::int64_t> last_line(Database& database) {
  return database.integer("SELECT number FROM audit_end");
}

bool append(const std::filesystem::path& file, std::span<const std::byte> record) {
  const auto folder = file.parent_path();
  const int fd = ::open(file.c_str(), O_CREAT | O_WRONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0600);
  if (fd < 0) return false;
  give_to_owner_of(folder, fd);
  // What a power cut left of a record does not shift those behind it.
  struct stat status {};
  bool done = ::fstat(fd, &status) == 0 && S_ISREG(status.st_mode);
  const off_t end = status.st_size - status.st_size % kRecordBytes;
  done = done && ::pwrite(fd, record.data(), record.size(), end) == static_cast<ssize_t>(record.size()) &&
         ::fsync(fd) == 0;
  ::close(fd);
  return done && sync_directory(folder).has_value();
}

struct Erased {
  std::int64_t line = 0;
  KeyedHash trace{};
};

// A list that cannot be read is not an empty one: an older copy would bring everybody back.
Result<std::vector<Erased>> read_list(const Database& database) {
  const auto list = list_of(database);
  const auto bytes = read_own_file(list, kMostListBytes);
  std::vector<Erased> all;
  if (!bytes && bytes.error().code == Errc::NotFound) return all;
  if (!bytes)
    return Error{bytes.error().code,
                 "who was erased cannot be read here: it must be a file that the store's owner may read",
                 bytes.error().sys_errno}
        .at(list.native());
  ByteReader from(*bytes);
  while (from.left() >= std::size_t(kRecordBytes)) {
    Erased& one = all.emplace_back();
    one.line = from.get<std::int64_t>();
    from.get(one.trace);
  }
  return all;
}

// NotFound: they are erased already.
Result<KeyedHash> trace_of(Database& database, const StoreKeys& keys, SubjectId id) {
  RELIEVO_TRY_ASSIGN(const auto row, database.row("SELECT code_hash FROM subject WHERE id = ?", number(id)));
  if (!row) return Error{Errc::NotFound, "there is no subject with this number"};
  return trace_of(keys, row->blob(0));
}

}  // namespace

Result<bool> remember_erased(Database& database, const StoreKeys& keys, SubjectId id) {
  RELIEVO_TRY_ASSIGN(const std::int64_t line, last_line(database));
  RELIEVO_TRY_ASSIGN(const KeyedHash trace, trace_of(database, keys, id));
  std::vector<std::byte> record;
  ByteWriter to(record);
  to.put(line + 1);
  to.put(trace);
  const auto list = list_of(database);
  return append(list, record) || (give_up_reserve(list.parent_path()) && append(list, record));
}

Result<std::vector<SubjectId>> erased_and_back(Database& database, const StoreKeys& keys) {
  RELIEVO_TRY_ASSIGN(const std::int64_t last, last_line(database));
  RELIEVO_TRY_ASSIGN(const auto list, read_list(database));
  std::vector<KeyedHash> erased;
  for (const Erased& one : list)
    if (one.line > last) erased.push_back(one.trace);
  std::vector<SubjectId> back;
  if (erased.empty()) return back;
  std::ranges::sort(erased);
  RELIEVO_TRY(database.each("SELECT id, code_hash FROM main.subject WHERE code_hash IS NOT NULL",
                            [&](const Statement& row) {
                              if (std::ranges::binary_search(erased, trace_of(keys, row.blob(1))))
                                back.push_back(SubjectId{row.integer(0)});
                            }));
  return back;
}

Result<bool> was_erased(Database& database, const StoreKeys& keys, std::int64_t code) {
  const KeyedHash trace = trace_of(keys, keys.code_hash(code));
  RELIEVO_TRY_ASSIGN(const auto list, read_list(database));
  if (std::ranges::find(list, trace, &Erased::trace) != list.end()) return true;
  RELIEVO_TRY_ASSIGN(auto query,
                     database.prepare("SELECT number, detail FROM audit WHERE what = ?", kSubjectErased));
  for (;;) {
    RELIEVO_TRY_ASSIGN(const bool row, query.step());
    if (!row) return false;
    RELIEVO_TRY_ASSIGN(const std::string detail, open_detail(keys, query.integer(0), query.blob(1)));
    if (detail == hex_of(trace)) return true;
  }
}

Result<void> destroy_subject_key(Database& database, const StoreKeys& keys, SubjectId id, WallTime at) {
  RELIEVO_TRY_ASSIGN(const KeyedHash trace, trace_of(database, keys, id));
  RELIEVO_TRY(append_audit_line(database, keys, {std::string(kSubjectErased), id, hex_of(trace)}, at));
  RELIEVO_TRY(KeySlots(database, true).write(id, KeySlots::Slot{}));
  return database.run(
      "UPDATE subject SET name = x'00', name_hash = NULL, code = NULL, code_hash = NULL WHERE id = ?",
      number(id));
}

Result<void> remove_erased_rows(Database& database) {
  // Only of those the log knows as erased: whoever cuts a row short makes nobody disappear without a line.
  return database.run(
      "DELETE FROM subject WHERE code_hash IS NULL AND key_id IS NOT NULL AND EXISTS "
      "(SELECT 1 FROM audit WHERE what = 'subject.erased' AND subject_id = subject.id)");
}

Result<void> empty_the_log(Database& database) {
  RELIEVO_TRY_ASSIGN(const bool emptied, database.empty_log());
  if (emptied) return {};
  return database.error(Errc::Timeout,
                        "erased, but another program keeps traces in the log: close it, then restart");
}

}  // namespace relievo::storage
