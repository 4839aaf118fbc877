// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Brings an open database to this program's version, or makes a new one.
//
//   empty file ──► schema.sql ─────────────────────────► kStoreVersion
//   version n  ──► copied aside ──► migrations n+1 ... ──► kStoreVersion
//   newer, but compatible with ours ──► used as it is;   newer ──► StoreNewer, untouched
#pragma once

#include <cstdint>
#include <filesystem>

#include "hal/base/result.h"
#include "storage/sqlite/sqlite_database.h"

namespace relievo::storage {

inline constexpr std::int64_t kApplicationId = 0x524c5631;  // "RLV1"

std::int64_t store_version();  // of this program: the number of its migrations

// Looks, changes nothing. InvalidInput: another program's database. StoreNewer. Returns the version
// of the file, 0 if it is empty.
Result<std::int64_t> version_of(Database& database);

// All in one transaction. MediaFull, IoFailed as every change.
Result<void> make_current(Database& database, std::int64_t version);

// relievo.db.before-N, for each N this program can have made.
Result<void> remove_old_copies(const std::filesystem::path& database_file);

}  // namespace relievo::storage
