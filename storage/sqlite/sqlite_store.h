// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The one way to open a store of SQLite. It lives in DIR/relievo.db (directory 0700, file 0600);
// DIR/relievo.lock keeps a second writer out; DIR/relievo.db.before-N is the copy made before a
// migration to version N, removed by the next erasure.
//
// Errors: InvalidInput (another program's database, DIR is no directory); NotFound (opened to read,
// nothing there); StoreNewer (made by a newer Relievo: left untouched); StoreCorrupt; Timeout
// (another program has it open to write); MediaFull; IoFailed; OutOfMemory.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>

#include "hal/base/result.h"
#include "hal/clock.h"
#include "storage/store.h"

namespace relievo::storage {

enum class OpenMode : std::uint8_t { ReadWrite, ReadOnly };

struct SqliteStoreOptions {
  OpenMode mode = OpenMode::ReadWrite;
  std::chrono::milliseconds wait_for_lock{2000};
  std::int64_t max_bytes = 0;  // of the database file; 0: as much as the disk holds
};

// `clock` must outlive the store.
Result<std::unique_ptr<Store>> open_sqlite_store(const std::filesystem::path& dir, const hal::Clock& clock,
                                                 const SqliteStoreOptions& options = {});

}  // namespace relievo::storage
