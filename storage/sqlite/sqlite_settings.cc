// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "storage/sqlite/sqlite_keys.h"

#include "storage/byte_order.h"
#include "storage/sqlite/sqlite_audit.h"
#include "storage/sqlite/sqlite_change.h"
#include "storage/text.h"

namespace relievo::storage {
namespace {

Place record_of(std::int64_t line) { return {"settings", "record", line}; }

}  // namespace

Result<std::int64_t> last_setting_line(Database& database) {
  return database.integer("SELECT max(number) FROM audit WHERE what = 'setting.changed'");
}

Result<Settings> read_settings(Database& database, const StoreKeys& keys) {
  RELIEVO_TRY_ASSIGN(const std::int64_t last, last_setting_line(database));
  RELIEVO_TRY_ASSIGN(auto query, database.prepare("SELECT line, record FROM settings"));
  RELIEVO_TRY_ASSIGN(const bool row, query.step());
  Settings settings;
  if (!row && last == 0) return settings;
  if (!row || query.integer(0) != last)
    return Error{Errc::StoreCorrupt,
                 "the settings are older than their last change: they were put back, or lost; restore a copy"}
        .at("settings, record");
  RELIEVO_TRY_ASSIGN(const auto plain, unseal(keys.device(), record_of(last), query.blob(1)));
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
  const auto sealed = seal(keys.device(), record_of(line), plain);
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
    return Error{Errc::InvalidInput, "a setting needs a short key, and a value of at most a million bytes"}
        .at(key);
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
