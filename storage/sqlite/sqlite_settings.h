// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The settings: one sealed value, bound to the line of the audit log that tells of the last change. So one
// that was changed, or an older one that was put back, is refused: StoreCorrupt. Thread: the store's.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "hal/base/result.h"
#include "storage/sqlite/sqlite_database.h"
#include "storage/sqlite/sqlite_keys.h"

namespace relievo::storage {

using Settings = std::map<std::string, std::string, std::less<>>;

Result<Settings> read_settings(Database& database, const StoreKeys& keys);

// Inside the caller's transaction. `line`: of the log, the last that tells of a change.
Result<void> write_settings(Database& database, const StoreKeys& keys, const Settings& settings,
                            std::int64_t line);

// 0: no setting was ever changed.
Result<std::int64_t> last_setting_line(Database& database);

}  // namespace relievo::storage
