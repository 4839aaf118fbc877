// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The keys of one open store, in locked memory until it is closed:
//
//   appliance's key (KeySource) ──► store key ──► a key for each subject ──► name, code, record, bytes
//                                          └────► device key ──► settings, notes, details of the audit log;
//                                                   │            what names and codes are found by (BLAKE2b)
//                                                   ├─► key of the audit chain
//                                                   └─► key that signs what is exported
//   recovery words (recovery.h) ──► store key
//
// An arrow is "wraps" (seal.h); what is wrapped stands in encryption_key and in subject_key
// (sqlite_key_slots.h). Errors: InvalidInput (another store's key), StoreCorrupt, the key source's own.
// Thread: the store's.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "hal/base/result.h"
#include "storage/cipher/key_source.h"
#include "storage/cipher/seal.h"
#include "storage/cipher/signature.h"
#include "storage/record.h"
#include "storage/sqlite/sqlite_database.h"
#include "storage/sqlite/sqlite_key_slots.h"

namespace relievo::storage {

class StoreKeys {
 public:
  static Result<std::unique_ptr<StoreKeys>> make(std::shared_ptr<KeySource> source);

  // Of a store that has none yet, in the caller's transaction. The appliance's key is made where it is
  // missing.
  Result<void> create(Database& database, WallTime at);
  // The appliance's key that a change of keys left half way takes its place, unless only `to_read`.
  Result<void> load(Database& database, bool to_read);

  // To change keys, in the caller's transaction; finish_change() when it is on the disk. `to`: where the
  // appliance's new key goes; where it only reads, the key stays the one it is.
  Result<void> rekey(Database& database, KeySource& to, WallTime at);
  // Of a store whose appliance's key is lost: nothing is loaded before. NotFound, InvalidInput, StoreCorrupt.
  Result<void> recover(Database& database, std::string_view words, KeySource& to, WallTime at);
  static Result<void> finish_change(KeySource& to);
  Result<void> keep_recovery_words(Database& database, std::string_view words, WallTime at);

  // The key of one subject at a time: drawn and wrapped for its slot, or unwrapped again.
  Result<void> draw_subject_key(Database& database, SubjectId id);
  Result<void> take_subject_key(KeySlots& slots, SubjectId id);
  const SecretKey& subject() const { return subject_; }

  const SecretKey& device() const { return device_; }
  const SecretKey& chain() const { return chain_; }
  // ASCII letters in either case are one; spaces at the ends do not count.
  KeyedHash name_hash(std::string_view name) const;
  KeyedHash code_hash(std::int64_t code) const;
  Result<Signed> sign(std::span<const std::byte> bytes) const;
  std::int64_t id() const { return id_; }  // of the row of encryption_key that subjects name
  SealedStream& stream() { return stream_; }

 private:
  StoreKeys(std::shared_ptr<KeySource> source, std::vector<SecretKey> rooms, SealedStream stream);
  void derive();
  Result<void> load_device(Database& database);
  Result<void> wrap_for_appliance(Database& database, KeySource& to, WallTime at);

  std::shared_ptr<KeySource> source_;
  SecretKey appliance_, store_, device_, search_, chain_, subject_;
  SealedStream stream_;
  std::int64_t id_ = 0;
};

// Where the note of a calibration is bound to: with the device's key.
inline Place calibration_note(std::int64_t revision) { return {"calibration", "note", revision}; }

}  // namespace relievo::storage
