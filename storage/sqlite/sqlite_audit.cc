// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// SqliteStore: the audit log, and the settings, which are bound to a line of it.
#include "storage/sqlite/sqlite_parts.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <map>
#include <set>

#include "storage/byte_order.h"
#include "storage/sodium_sha256.h"
#include "storage/text.h"

namespace relievo::storage {
namespace {

struct Line {
  std::int64_t number = 0;
  std::int64_t at_ms = 0;
  std::int64_t subject = 0;
  std::string_view what;
  std::span<const std::byte> detail;  // as it is stored
};

// `of` is given every line as it is stored, and its row, whose sixth column is its hash.
template <typename Of>
Result<void> each_line(Database& database, const Of& of) {
  constexpr std::string_view kLines =
      "SELECT number, at_ms, subject_id, what, detail, hash FROM audit ORDER BY number";
  return database.each(kLines, [&](const Statement& row) -> Result<void> {
    return of(Line{row.integer(0), row.integer(1), row.integer(2), row.text(3), row.blob(4)}, row);
  });
}

// What audit_end holds, and the next line is chained to. Keyed on its own: nobody without the key can make
// another line the last.
KeyedHash end_at(const StoreKeys& keys, std::int64_t number, std::span<const std::byte> hash) {
  std::vector<std::byte> bytes;
  ByteWriter to(bytes);
  to.put(bytes_of("end"));
  to.put(number);
  to.put(hash);
  return keyed_hash(keys.chain(), bytes);
}

std::vector<std::byte> chained(std::span<const std::byte> before, const Line& line) {
  std::vector<std::byte> bytes;
  bytes.reserve(before.size() + 5 * 8 + line.what.size() + line.detail.size());
  ByteWriter to(bytes);
  to.put(before);
  to.put(line.number);
  to.put(line.at_ms);
  to.put(line.subject);
  // Lengths first: moving a letter from one field to the next is a change too.
  for (const auto field : {bytes_of(line.what), line.detail}) {
    to.put(std::uint64_t(field.size()));
    to.put(field);
  }
  return bytes;
}

Place detail_of(std::int64_t line) { return {"audit", "detail", line}; }
Place settings_of(std::int64_t line) { return {"settings", "record", line}; }

// Nothing stays nothing: most lines have no detail.
std::vector<std::byte> sealed_detail(const StoreKeys& keys, std::int64_t line, std::string_view detail) {
  if (detail.empty()) return {};
  return seal(keys.device(), detail_of(line), bytes_of(detail));
}

struct End {
  std::int64_t number = 0;
  KeyedHash hash{};
};

Error broken(const Database& database) {
  return database.error(Errc::StoreCorrupt, "the audit log was changed or is damaged: restore a copy");
}

Result<End> read_end(Database& database) {
  RELIEVO_TRY_ASSIGN(const auto row, database.row("SELECT number, hash FROM audit_end"));
  End end;
  if (!row || row->blob(1).size() != end.hash.size()) return broken(database);
  end.number = row->integer(0);
  std::ranges::copy(row->blob(1), end.hash.begin());
  return end;
}

End empty_log(const StoreKeys& keys) { return {0, end_at(keys, 0, {})}; }

KeyedHash next_hash(const StoreKeys& keys, const End& end, const Line& line) {
  return keyed_hash(keys.chain(), chained(end.hash, line));
}

// Who is there, each with their enrolments; and from which number on the log tells of them: people and
// enrolments of before there was a log have no line.
struct People {
  std::map<std::int64_t, std::set<std::int64_t>> enrolments;
  std::int64_t first = std::numeric_limits<std::int64_t>::max(), first_enrolment = first;

  void read(const Line& line, std::string_view detail) {
    std::int64_t enrolment = 0;
    std::from_chars(detail.data(), detail.data() + detail.size(), enrolment);
    if (line.what == kSubjectAdded) {
      enrolments[line.subject];
      first = std::min(first, line.subject);
    } else if (line.what == kEnrolmentAdded) {
      enrolments[line.subject].insert(enrolment);
      first_enrolment = std::min(first_enrolment, enrolment);
    } else if (line.what == kEnrolmentRenewed) {
      enrolments[line.subject] = {enrolment};
    } else if (line.what == kSubjectErased) {
      enrolments.erase(line.subject);
    }
  }
};

Result<void> compare(Database& database, const People& told) {
  People there;
  RELIEVO_TRY(database.each(
      "SELECT subject.id, enrolment.id FROM subject LEFT JOIN enrolment ON subject_id = subject.id "
      "WHERE code_hash IS NOT NULL",
      [&](const Statement& row) {
        auto& theirs = there.enrolments[row.integer(0)];
        if (row.integer(1) != 0) theirs.insert(row.integer(1));
      }));
  const auto wrong = [](const char* kind, std::int64_t number, Literal what) {
    return Error{Errc::StoreCorrupt, what}.at(kind + std::to_string(number));
  };
  constexpr Literal kGone = "is gone, and the audit log tells of no erasure: restore a copy";
  constexpr Literal kUntold = "is there, and the audit log does not tell since when: restore a copy";
  for (const auto& [person, enrolments] : told.enrolments) {
    const auto found = there.enrolments.find(person);
    if (found == there.enrolments.end()) return wrong("subject ", person, kGone);
    for (const std::int64_t one : enrolments)
      if (!found->second.contains(one)) return wrong("enrolment ", one, kGone);
  }
  for (const auto& [person, enrolments] : there.enrolments) {
    const auto found = told.enrolments.find(person);
    const bool known = found != told.enrolments.end();
    if (!known && person >= told.first) return wrong("subject ", person, kUntold);
    for (const std::int64_t one : enrolments)
      if (one >= told.first_enrolment && !(known && found->second.contains(one)))
        return wrong("enrolment ", one, kUntold);
  }
  return {};
}

}  // namespace

Result<std::string> open_detail(const StoreKeys& keys, std::int64_t line, std::span<const std::byte> sealed) {
  if (sealed.empty()) return std::string();
  RELIEVO_TRY_ASSIGN(const auto plain, unseal(keys.device(), detail_of(line), sealed));
  return std::string(text_of(plain));
}

Result<std::int64_t> append_audit_line(Database& database, const StoreKeys& keys, const AuditEvent& event,
                                       WallTime at) {
  if (event.what.empty() || event.what.size() > kMaxNameBytes || event.detail.size() > kMaxTextBytes) {
    return invalid("a line of the audit log needs a word, and has a longest length");
  }
  RELIEVO_TRY_ASSIGN(const End end, read_end(database));
  const auto detail = sealed_detail(keys, end.number + 1, event.detail);
  const Line line{end.number + 1, to_ms(at), number(event.subject), event.what, detail};
  const KeyedHash hash = next_hash(keys, end, line);
  RELIEVO_TRY(database.run(
      "INSERT INTO audit (number, at_ms, what, subject_id, detail, hash) VALUES (?, ?, ?, ?, ?, ?)",
      line.number, line.at_ms, line.what, line.subject, detail, hash));
  RELIEVO_TRY(database.run("UPDATE audit_end SET number = ?, hash = ?", line.number,
                           end_at(keys, line.number, hash)));
  return line.number;
}

Result<void> begin_audit(Database& database, const StoreKeys& keys) {
  return database.run("UPDATE audit_end SET hash = ?", empty_log(keys).hash);
}

Result<bool> ended_so(Database& database, const StoreKeys& keys, std::int64_t number,
                      std::span<const std::byte> end) {
  if (number == 0) return std::ranges::equal(end, empty_log(keys).hash);
  RELIEVO_TRY_ASSIGN(const auto line, database.row("SELECT hash FROM audit WHERE number = ?", number));
  return line && std::ranges::equal(end, end_at(keys, number, line->blob(0)));
}

Result<void> check_audit(Database& database, const StoreKeys& keys) {
  // Log, people and recovery of one instant: a kiosk may be changing them.
  struct Instant {
    Database& database;
    ~Instant() {
      if (database.in_transaction()) (void)database.run("ROLLBACK");
    }
  } instant{database};
  if (!database.in_transaction()) RELIEVO_TRY(database.run("BEGIN"));
  RELIEVO_TRY_ASSIGN(const End end, read_end(database));
  End reached = empty_log(keys);
  People told;
  RELIEVO_TRY(each_line(database, [&](const Line& line, const Statement& row) -> Result<void> {
    const KeyedHash hash = next_hash(keys, reached, line);
    if (line.number != reached.number + 1 || !std::ranges::equal(row.blob(5), hash)) return broken(database);
    reached = {line.number, end_at(keys, line.number, hash)};
    RELIEVO_TRY_ASSIGN(const std::string detail, open_detail(keys, line.number, line.detail));
    told.read(line, detail);
    return {};
  }));
  if (reached.number != end.number || reached.hash != end.hash) return broken(database);
  RELIEVO_TRY(compare(database, told));
  return keys.check_recovery(database);
}

Result<void> key_audit_end(Database& database, const StoreKeys& keys) {
  RELIEVO_TRY_ASSIGN(const End end, read_end(database));
  End old, made = empty_log(keys);
  bool whole = true;
  RELIEVO_TRY(each_line(database, [&](const Line& line, const Statement& row) -> Result<void> {
    const KeyedHash before = next_hash(keys, old, line);
    whole = whole && line.number == old.number + 1 && std::ranges::equal(row.blob(5), before);
    if (!whole) return {};
    old = {line.number, before};
    const KeyedHash hash = next_hash(keys, made, line);
    made = {line.number, end_at(keys, line.number, hash)};
    return database.run("UPDATE audit SET hash = ? WHERE number = ?", hash, line.number);
  }));
  if (!whole || old.number != end.number || old.hash != end.hash) return {};
  // An empty log needs no key: whoever has emptied theirs could say that their store is of version 8.
  RELIEVO_TRY_ASSIGN(
      const std::int64_t others,
      database.integer("SELECT (SELECT count(*) FROM subject) + (SELECT count(*) FROM calibration)"));
  if (end.number == 0 && others != 0) return {};
  return database.run("UPDATE audit_end SET hash = ?", made.hash);
}

Result<void> seal_audit(Database& database, const StoreKeys& keys) {
  RELIEVO_TRY_ASSIGN(const End end, read_end(database));
  End old, made = empty_log(keys);
  RELIEVO_TRY(each_line(database, [&](Line line, const Statement& row) {
    line.detail = bytes_of(row.text(4));
    old.hash = sha256(chained(old.hash, line));
    const bool whole = line.number == old.number + 1 && std::ranges::equal(row.blob(5), old.hash);
    const auto detail = sealed_detail(keys, line.number, row.text(4));
    line.detail = detail;
    const KeyedHash hash = next_hash(keys, made, line);
    made = {line.number, end_at(keys, line.number, hash)};
    const auto kept = whole ? std::span<const std::byte>(hash) : row.blob(5);
    if (row.blob(5).size() == old.hash.size()) std::ranges::copy(row.blob(5), old.hash.begin());
    old.number = line.number;
    return database.run("UPDATE audit SET sealed_detail = ?, detail = '', hash = ? WHERE number = ?", detail,
                        kept, line.number);
  }));
  if (old.number != end.number || old.hash != end.hash) return {};
  return database.run("UPDATE audit_end SET hash = ?", made.hash);
}

Result<void> SqliteStore::append_line(const AuditEvent& event, WallTime at) {
  RELIEVO_TRY(append_audit_line(*database_, *keys_, event, at));
  return {};
}

Result<void> SqliteStore::append_audit(const AuditEvent& event) {
  constexpr std::string_view kOwn[] = {kSettingChanged,   kSubjectAdded,      kSubjectErased, kEnrolmentAdded,
                                       kEnrolmentRenewed, kRecoveryWordsMade, kRekeyed};
  if (std::ranges::find(kOwn, event.what) != std::end(kOwn))
    return invalid("only the store itself writes this line of the audit log").at(event.what);
  // What is exported from a full disk makes room there, and may not fail for its line.
  const Result<void> done = change_in_reserve([&](WallTime at) { return append_line(event, at); });
  if (done) set_aside_reserve(home_, reserve_bytes_);
  return done;
}

Result<std::vector<AuditRecord>> SqliteStore::audit(std::int64_t after_number, std::int64_t limit) {
  return without_exceptions(database_->where(), [&]() -> Result<std::vector<AuditRecord>> {
    std::vector<AuditRecord> records;
    const auto read = [&](const Statement& row) -> Result<void> {
      RELIEVO_TRY_ASSIGN(auto detail, open_detail(*keys_, row.integer(0), row.blob(4)));
      records.push_back({row.integer(0),
                         from_ms(row.integer(1)),
                         {std::string(row.text(2)), SubjectId{row.integer(3)}, std::move(detail)}});
      return {};
    };
    RELIEVO_TRY(database_->each(
        "SELECT number, at_ms, what, subject_id, detail FROM audit WHERE number > ? ORDER BY number LIMIT ?",
        read, after_number, limit));
    return records;
  });
}

Result<std::int64_t> last_setting_line(Database& database) {
  return database.integer("SELECT max(number) FROM audit WHERE what = 'setting.changed'");
}

Result<Settings> read_settings(Database& database, const StoreKeys& keys) {
  RELIEVO_TRY_ASSIGN(const std::int64_t last, last_setting_line(database));
  RELIEVO_TRY_ASSIGN(const auto row,
                     database.row("SELECT line, record, (SELECT count(*) FROM settings) FROM settings"));
  Settings settings;
  if (!row && last == 0) return settings;
  if (!row || row->integer(0) != last || row->integer(2) != 1)
    return Error{Errc::StoreCorrupt,
                 "the settings are older than their last change: they were put back, or lost; restore a copy"}
        .at("settings, record");
  RELIEVO_TRY_ASSIGN(const auto plain, unseal(keys.device(), settings_of(last), row->blob(1)));
  for (ByteReader from(plain); from.ok() && from.left() > 0;) {
    std::string key;
    from.text(key);
    from.text(settings[key]);
  }
  return settings;
}

Result<void> write_settings(Database& database, const StoreKeys& keys, const Settings& settings,
                            std::int64_t line) {
  std::vector<std::byte> plain;
  ByteWriter to(plain);
  for (const auto& [key, value] : settings) {
    to.text(key);
    to.text(value);
  }
  const auto sealed = seal(keys.device(), settings_of(line), plain);
  RELIEVO_TRY(database.run("DELETE FROM settings"));
  return database.run("INSERT INTO settings (line, record) VALUES (?, ?)", line, sealed);
}

Result<std::string> SqliteStore::setting(std::string_view key) {
  return without_exceptions(database_->where(), [&]() -> Result<std::string> {
    RELIEVO_TRY_ASSIGN(auto settings, read_settings(*database_, *keys_));
    const auto found = settings.find(key);
    return found == settings.end() ? std::string() : std::move(found->second);
  });
}

Result<void> SqliteStore::set_setting(std::string_view key, std::string_view value) {
  if (!is_name(key) || value.size() > kMaxTextBytes) {
    return invalid("a setting needs a short key, and a value of at most a million bytes").at(key);
  }
  // Signing in writes one: on a full disk nobody could come in and make room.
  const Result<void> done = change_in_reserve([&](WallTime at) -> Result<void> {
    RELIEVO_TRY_ASSIGN(auto settings, read_settings(*database_, *keys_));
    settings.insert_or_assign(std::string(key), std::string(value));
    // The key only: a value may be a secret.
    RELIEVO_TRY_ASSIGN(
        const std::int64_t line,
        append_audit_line(*database_, *keys_, {std::string(kSettingChanged), {}, std::string(key)}, at));
    return write_settings(*database_, *keys_, settings, line);
  });
  if (done) set_aside_reserve(home_, reserve_bytes_);
  return done;
}

}  // namespace relievo::storage
