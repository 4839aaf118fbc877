// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the subjects' wrapped keys lie: slots of one size in large blobs. SQLite copies small rows from page
// to page, and secure_delete leaves such copies behind; the overflow pages of a blob it never moves. So a
// slot that is overwritten is gone from the file, which is what erasing a person rests on.
//
//   row b of subject_key, slots: kHead bytes unused (they may lie in a page that is moved) | kPerBlock slots,
//   of subjects b * kPerBlock ... ; zeros: no key
// Errors: the database's. Thread: the store's; for the length of one verb.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "storage/cipher/seal.h"
#include "storage/record.h"
#include "storage/sqlite/sqlite_database.h"

namespace relievo::storage {

class KeySlots {
 public:
  using Slot = std::array<std::byte, kSealBytes + SecretKey::kBytes>;
  static constexpr std::int64_t kPerBlock = 1024, kHead = 4096;

  // To write, inside the caller's transaction.
  explicit KeySlots(Database& database, bool to_write = false) : database_(database), to_write_(to_write) {}
  Result<Slot> read(SubjectId id);
  Result<void> write(SubjectId id, std::span<const std::byte> wrapped);

 private:
  Result<void> open(SubjectId id);
  Database& database_;
  bool to_write_;
  std::optional<Blob> blob_;
  std::int64_t block_ = -1;
};

}  // namespace relievo::storage
