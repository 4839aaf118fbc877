// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Brings an open database to this program's version, or makes a new one.
//
//   empty file ──► schema.sql
//   version n  ──► copied aside ──► migrations n+1 ...
//   version n < 7 ──► copied aside ──► migrations n+1 ... 7 ──► sealed (sqlite_sealed_rows.h)
//              ──► migrations 8 ... ──► the copy removed
//   newer, but compatible with ours ──► used as it is
//   newer ──► StoreNewer, untouched
#pragma once

#include <cstdint>
#include <filesystem>

#include "hal/base/result.h"
#include "storage/record.h"
#include "storage/sqlite/sqlite_database.h"
#include "storage/sqlite/sqlite_keys.h"

namespace relievo::storage {

inline constexpr std::int64_t kApplicationId = 0x524c5631;  // "RLV1"

std::int64_t store_version();  // of this program: the number of its migrations

// Looks, changes nothing. InvalidInput: another program's database. StoreNewer. Returns the version
// of the file, 0 if it is empty.
Result<std::int64_t> version_of(Database& database);

// Afterwards `keys` are those of the store: loaded, or made for one that had none. All in one transaction,
// but for the sealing. MediaFull, IoFailed as every change, and what the keys' source says.
Result<void> make_current(Database& database, std::int64_t version, StoreKeys& keys, WallTime at);

// The database as it is now, in a file of 0600 that is whole or not there. IoFailed, MediaFull.
Result<void> copy_whole(Database& database, const std::filesystem::path& target);

// relievo.db.before-N, for each N this program can have made.
Result<void> remove_old_copies(const std::filesystem::path& database_file);
// Those in which people stand in the clear. What a power cut may have left is found at the next opening.
Result<void> remove_plain_copies(const std::filesystem::path& database_file);

}  // namespace relievo::storage
