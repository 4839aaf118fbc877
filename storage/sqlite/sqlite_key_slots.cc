// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "storage/sqlite/sqlite_key_slots.h"

#include "storage/sqlite/sqlite_change.h"

namespace relievo::storage {
namespace {

std::size_t offset_of(SubjectId id) {
  return std::size_t(KeySlots::kHead +
                     number(id) % KeySlots::kPerBlock * std::int64_t(sizeof(KeySlots::Slot)));
}

}  // namespace

Result<void> KeySlots::open(SubjectId id) {
  const std::int64_t block = number(id) / kPerBlock;
  if (blob_ && block == block_) return {};
  blob_.reset();
  RELIEVO_TRY_ASSIGN(const std::int64_t there,
                     database_.integer("SELECT 1 FROM subject_key WHERE block = ?", block));
  if (there == 0 && !to_write_)
    return Error{Errc::StoreCorrupt, "the store has lost this person's key: restore a copy"}.at(
        "subject " + std::to_string(number(id)));
  if (there == 0)
    RELIEVO_TRY(database_.run("INSERT INTO subject_key (block, slots) VALUES (?, ?)", block,
                              Zeros{kHead + kPerBlock * std::int64_t(sizeof(Slot))}));
  RELIEVO_TRY_ASSIGN(auto blob, Blob::open(database_, "subject_key", "slots", block, to_write_));
  blob_.emplace(std::move(blob));
  block_ = block;
  return {};
}

Result<KeySlots::Slot> KeySlots::read(SubjectId id) {
  RELIEVO_TRY(open(id));
  Slot slot{};
  RELIEVO_TRY(blob_->read(offset_of(id), slot));
  return slot;
}

Result<void> KeySlots::write(SubjectId id, std::span<const std::byte> wrapped) {
  RELIEVO_TRY(open(id));
  return blob_->write(offset_of(id), wrapped);
}

}  // namespace relievo::storage
