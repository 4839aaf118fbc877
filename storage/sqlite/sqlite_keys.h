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
// (KeySlots). Errors: InvalidInput (another store's key), StoreCorrupt, the key source's own.
// Thread: the store's.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hal/base/result.h"
#include "storage/cipher/key_source.h"
#include "storage/cipher/seal.h"
#include "storage/record.h"
#include "storage/sqlite/sqlite_database.h"

namespace relievo::storage {

// Where the subjects' wrapped keys lie: slots of one size in large blobs. SQLite copies small rows from page
// to page, and secure_delete leaves such copies behind; the overflow pages of a blob it never moves. So a
// slot that is overwritten is gone from the file, which is what erasing a person rests on.
//
//   row b of subject_key, slots: kHead bytes unused (they may lie in a page that is moved) | kPerBlock slots,
//   of subjects b * kPerBlock ... ; zeros: no key
// Errors: the database's. Thread: the store's; for the length of one verb.
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
  // What the audit log keeps of the recovery's rows, whenever they change: a damaged one opens nothing, and
  // only its words would tell. Empty: there are none.
  static Result<std::string> recovery_trace(Database& database);
  // StoreCorrupt: words were made, and what they open is gone, damaged, or another's.
  Result<void> check_recovery(Database& database) const;

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
  StoreKeys(std::shared_ptr<KeySource> source, std::vector<SecretKey> rooms, SealedStream stream)
      : source_(std::move(source)), rooms_(std::move(rooms)), stream_(std::move(stream)) {}
  void derive();
  Result<void> load_device(Database& database);
  Result<void> wrap_for_appliance(Database& database, KeySource& to, WallTime at);

  std::shared_ptr<KeySource> source_;
  std::vector<SecretKey> rooms_;
  SecretKey &appliance_ = rooms_[0], &store_ = rooms_[1], &device_ = rooms_[2], &search_ = rooms_[3],
            &chain_ = rooms_[4], &subject_ = rooms_[5];
  SealedStream stream_;
  std::int64_t id_ = 0;
};

// Where the note of a calibration is bound to: with the device's key.
inline Place calibration_note(std::int64_t revision) { return {"calibration", "note", revision}; }

// The settings: one sealed value, bound to the line of the audit log that tells of the last change. So one
// that was changed, or an older one that was put back, is refused: StoreCorrupt. Thread: the store's.
using Settings = std::map<std::string, std::string, std::less<>>;

Result<Settings> read_settings(Database& database, const StoreKeys& keys);

// Inside the caller's transaction. `line`: of the log, the last that tells of a change.
Result<void> write_settings(Database& database, const StoreKeys& keys, const Settings& settings,
                            std::int64_t line);

// 0: no setting was ever changed.
Result<std::int64_t> last_setting_line(Database& database);

}  // namespace relievo::storage
