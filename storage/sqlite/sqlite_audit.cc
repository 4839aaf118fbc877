// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "storage/sqlite/sqlite_audit.h"

#include <algorithm>

#include "storage/byte_order.h"
#include "storage/sodium_sha256.h"
#include "storage/sqlite/sqlite_change.h"

namespace relievo::storage {
namespace {

struct Line {
  std::int64_t number = 0;
  std::int64_t at_ms = 0;
  std::int64_t subject = 0;
  std::string_view what;
  std::string_view detail;
};

Sha256 chained(std::span<const std::byte> before, const Line& line) {
  std::vector<std::byte> bytes;
  bytes.reserve(before.size() + 5 * 8 + line.what.size() + line.detail.size());
  ByteWriter to(bytes);
  to.put(before);
  to.put(line.number);
  to.put(line.at_ms);
  to.put(line.subject);
  // Lengths first: moving a letter from one field to the next is a change too.
  for (const std::string_view text : {line.what, line.detail}) {
    to.put(static_cast<std::uint64_t>(text.size()));
    to.put(bytes_of(text));
  }
  return sha256(bytes);
}

struct End {
  std::int64_t number = 0;
  Sha256 hash{};
};

Error broken(const Database& database) {
  return Error{Errc::StoreCorrupt, "the audit log was changed or is damaged"}.at(database.where());
}

Result<End> read_end(Database& database) {
  RELIEVO_TRY_ASSIGN(auto query, database.prepare("SELECT number, hash FROM audit_end"));
  RELIEVO_TRY_ASSIGN(const bool row, query.step());
  End end;
  if (!row || query.blob(1).size() != end.hash.size()) return broken(database);
  end.number = query.integer(0);
  std::ranges::copy(query.blob(1), end.hash.begin());
  return end;
}

}  // namespace

Result<void> append_audit_line(Database& database, const AuditEvent& event, WallTime at) {
  if (event.what.empty() || event.what.size() > kMaxNameBytes || event.detail.size() > kMaxTextBytes) {
    return Error{Errc::InvalidInput, "a line of the audit log needs a word, and has a longest length"};
  }
  RELIEVO_TRY_ASSIGN(const End end, read_end(database));
  const Line line{end.number + 1, to_ms(at), number(event.subject), event.what, event.detail};
  const Sha256 hash = chained(end.hash, line);
  RELIEVO_TRY_ASSIGN(auto insert,
                     database.prepare("INSERT INTO audit (number, at_ms, what, subject_id, detail, hash) "
                                      "VALUES (?, ?, ?, ?, ?, ?)"));
  insert.bind(line.number).bind(line.at_ms).bind(line.what).bind(line.subject).bind(line.detail).bind(hash);
  RELIEVO_TRY(insert.run());
  RELIEVO_TRY_ASSIGN(auto move, database.prepare("UPDATE audit_end SET number = ?, hash = ?"));
  return move.bind(line.number).bind(hash).run();
}

Result<void> check_audit_chain(Database& database) {
  RELIEVO_TRY_ASSIGN(const End end, read_end(database));
  RELIEVO_TRY_ASSIGN(auto query, database.prepare("SELECT number, at_ms, subject_id, what, detail, hash "
                                                  "FROM audit ORDER BY number"));
  End reached;
  for (;;) {
    RELIEVO_TRY_ASSIGN(const bool row, query.step());
    if (!row) break;
    const Line line{query.integer(0), query.integer(1), query.integer(2), query.text(3), query.text(4)};
    if (line.number != reached.number + 1) return broken(database);
    reached = {line.number, chained(reached.hash, line)};
    if (!std::ranges::equal(query.blob(5), reached.hash)) return broken(database);
  }
  if (reached.number != end.number || reached.hash != end.hash) return broken(database);
  return {};
}

Result<void> SqliteStore::append_audit(const AuditEvent& event) {
  return change([&](WallTime at) { return append_audit_line(*database_, event, at); });
}

Result<std::vector<AuditRecord>> SqliteStore::audit(std::int64_t after_number, std::int64_t limit) {
  return without_exceptions(database_->where(), [&]() -> Result<std::vector<AuditRecord>> {
    RELIEVO_TRY_ASSIGN(auto query,
                       database_->prepare("SELECT number, at_ms, what, subject_id, detail FROM audit "
                                          "WHERE number > ? ORDER BY number LIMIT ?"));
    query.bind(after_number).bind(limit);
    std::vector<AuditRecord> records;
    for (;;) {
      RELIEVO_TRY_ASSIGN(const bool row, query.step());
      if (!row) return records;
      records.push_back(
          {query.integer(0),
           from_ms(query.integer(1)),
           {std::string(query.text(2)), SubjectId{query.integer(3)}, std::string(query.text(4))}});
    }
  });
}

}  // namespace relievo::storage
