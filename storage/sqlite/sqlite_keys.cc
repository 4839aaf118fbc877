// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "storage/sqlite/sqlite_keys.h"

#include <algorithm>

#include "storage/byte_order.h"
#include "storage/cipher/recovery.h"
#include "storage/sodium_sha256.h"
#include "storage/sqlite/sqlite_parts.h"
#include "storage/text.h"

namespace relievo::storage {
namespace {

constexpr std::string_view kAppliance = "appliance", kDevice = "device", kRecovery = "recovery",
                           kRecoveryHalf = "recovery public half";
enum Purpose : std::uint64_t { kSearch = 1, kChain = 2, kSigning = 3 };

Place place_of(std::string_view kind) { return {"encryption_key", kind, 0}; }
Place slot_of(SubjectId id) { return {"subject_key", "slots", number(id)}; }

// Takes the place of the one that was there.
Result<void> put_key(Database& database, std::string_view kind, std::span<const std::byte> wrapped,
                     WallTime at) {
  RELIEVO_TRY(database.run("UPDATE encryption_key SET created_at_ms = ?, parameters = ? WHERE kind = ?",
                           to_ms(at), wrapped, kind));
  if (database.changes() > 0) return {};
  return database.run("INSERT INTO encryption_key (created_at_ms, parameters, kind) VALUES (?, ?, ?)",
                      to_ms(at), wrapped, kind);
}

// 0: there is none.
Result<std::int64_t> find_key(Database& database, std::string_view kind, std::vector<std::byte>& wrapped) {
  RELIEVO_TRY_ASSIGN(const auto row,
                     database.row("SELECT id, parameters FROM encryption_key WHERE kind = ?", kind));
  if (!row) return 0;
  wrapped.assign(row->blob(1).begin(), row->blob(1).end());
  return row->integer(0);
}

Error lost_keys(const Database& database) {
  return database.error(Errc::StoreCorrupt, "the store has lost its keys: restore a copy");
}

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
  if (there == 0 && !to_write_) return corrupt(id, "the store has lost this person's key: restore a copy");
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

Result<std::unique_ptr<StoreKeys>> StoreKeys::make(std::shared_ptr<KeySource> source) {
  std::vector<SecretKey> rooms;
  while (rooms.size() < 6) {
    RELIEVO_TRY_ASSIGN(auto room, SecretKey::make());
    rooms.push_back(std::move(room));
  }
  RELIEVO_TRY_ASSIGN(auto stream, SealedStream::make());
  return std::unique_ptr<StoreKeys>(new StoreKeys(std::move(source), std::move(rooms), std::move(stream)));
}

void StoreKeys::derive() {
  search_.derive(device_, kSearch);
  chain_.derive(device_, kChain);
  appliance_.wipe();
}

Result<void> StoreKeys::create(Database& database, WallTime at) {
  auto there = source_->read(appliance_);
  if (!there && there.error().code == Errc::NotFound) {
    there = source_->make_next(appliance_);
    if (there) there = source_->take_next();
  }
  if (!there) return there;
  store_.draw();
  device_.draw();
  RELIEVO_TRY(put_key(database, kAppliance, seal(appliance_, place_of(kAppliance), store_.bytes()), at));
  RELIEVO_TRY(put_key(database, kDevice, seal(store_, place_of(kDevice), device_.bytes()), at));
  RELIEVO_TRY_ASSIGN(id_, database.integer("SELECT id FROM encryption_key WHERE kind = ?", kAppliance));
  derive();
  return {};
}

Result<void> StoreKeys::load_device(Database& database) {
  std::vector<std::byte> wrapped;
  RELIEVO_TRY_ASSIGN(const auto device, find_key(database, kDevice, wrapped));
  if (device == 0) return lost_keys(database);
  RELIEVO_TRY(unwrap(store_, place_of(kDevice), wrapped, device_));
  derive();
  return {};
}

Result<void> StoreKeys::load(Database& database, bool to_read) {
  std::vector<std::byte> wrapped;
  RELIEVO_TRY_ASSIGN(id_, find_key(database, kAppliance, wrapped));
  if (id_ == 0) return lost_keys(database);
  const auto read = source_->read(appliance_);
  if (!read || !unwrap(appliance_, place_of(kAppliance), wrapped, store_)) {
    // Power may have gone between the store's going by a new key and the key's taking its place.
    if (!source_->read_next(appliance_) || !unwrap(appliance_, place_of(kAppliance), wrapped, store_)) {
      if (!read) return read;
      return database.error(
          Errc::InvalidInput,
          "this is not the key of this store: name the right one (--key), or recover the store");
    }
    if (!to_read) RELIEVO_TRY(source_->take_next());
  }
  return load_device(database);
}

Result<void> StoreKeys::wrap_for_appliance(Database& database, KeySource& to, WallTime at) {
  if (auto made = to.make_next(appliance_); !made && made.error().code == Errc::Unsupported)
    RELIEVO_TRY(to.read(appliance_));
  else if (!made) return made;
  return put_key(database, kAppliance, seal(appliance_, place_of(kAppliance), store_.bytes()), at);
}

Result<void> StoreKeys::finish_change(KeySource& to) {
  auto taken = to.take_next();
  return !taken && taken.error().code == Errc::Unsupported ? Result<void>() : taken;
}

Result<void> StoreKeys::rekey(Database& database, KeySource& to, WallTime at) {
  RELIEVO_TRY_ASSIGN(auto old, SecretKey::make());
  std::ranges::copy(store_.bytes(), old.bytes().begin());
  std::vector<std::byte> half;
  RELIEVO_TRY_ASSIGN(const auto recovery, find_key(database, kRecoveryHalf, half));
  if (recovery != 0) {
    RELIEVO_TRY_ASSIGN(half, unseal(old, place_of(kRecoveryHalf), half));
  }
  store_.draw();
  RELIEVO_TRY(wrap_for_appliance(database, to, at));
  RELIEVO_TRY(put_key(database, kDevice, seal(store_, place_of(kDevice), device_.bytes()), at));
  if (RecoveryPublic recipient{}; recovery != 0 && half.size() == recipient.size()) {
    std::ranges::copy(half, recipient.begin());
    RELIEVO_TRY(put_key(database, kRecoveryHalf, seal(store_, place_of(kRecoveryHalf), half), at));
    RELIEVO_TRY(put_key(database, kRecovery, seal_for(recipient, store_), at));
  }
  KeySlots slots(database, true);
  const auto wrap_anew = [&](const Statement& row) -> Result<void> {
    const SubjectId id{row.integer(0)};
    RELIEVO_TRY_ASSIGN(const auto wrapped, slots.read(id));
    RELIEVO_TRY(unwrap(old, slot_of(id), wrapped, subject_));
    return slots.write(id, seal(store_, slot_of(id), subject_.bytes()));
  };
  return database.each("SELECT id FROM subject WHERE code_hash IS NOT NULL ORDER BY id", wrap_anew);
}

Result<void> StoreKeys::keep_recovery_words(Database& database, std::string_view words, WallTime at) {
  RELIEVO_TRY_ASSIGN(const auto secret, recovery_secret(words));
  const RecoveryPublic half = recovery_public(secret);
  // Sealed: nobody without the store's key puts their own half here, to be given the next store key.
  RELIEVO_TRY(put_key(database, kRecoveryHalf, seal(store_, place_of(kRecoveryHalf), half), at));
  return put_key(database, kRecovery, seal_for(half, store_), at);
}

Result<std::string> StoreKeys::recovery_trace(Database& database) {
  std::vector<std::byte> half, wrapped;
  RELIEVO_TRY(find_key(database, kRecoveryHalf, half));
  RELIEVO_TRY(find_key(database, kRecovery, wrapped));
  if (half.empty() || wrapped.empty()) return std::string();
  half.insert(half.end(), wrapped.begin(), wrapped.end());
  return hex_of(sha256(half));
}

Result<void> StoreKeys::check_recovery(Database& database) const {
  const Error dead =
      database.error(Errc::StoreCorrupt,
                     "the recovery words no longer open this store: make new ones (store recovery-words)");
  RELIEVO_TRY_ASSIGN(const std::string trace, recovery_trace(database));
  RELIEVO_TRY_ASSIGN(const std::int64_t made,
                     database.integer("SELECT count(*) FROM audit WHERE what = ?", kRecoveryWordsMade));
  if (trace.empty()) return made == 0 ? Result<void>() : dead;
  std::vector<std::byte> half;
  RELIEVO_TRY(find_key(database, kRecoveryHalf, half));
  const auto opened = unseal(store_, place_of(kRecoveryHalf), half);
  if (!opened || opened->size() != sizeof(RecoveryPublic)) return dead;
  RELIEVO_TRY_ASSIGN(
      const auto last,
      database.row("SELECT number, detail FROM audit WHERE what IN (?, ?) ORDER BY number DESC",
                   kRecoveryWordsMade, kRekeyed));
  if (!last) return {};
  RELIEVO_TRY_ASSIGN(const std::string told, open_detail(*this, last->integer(0), last->blob(1)));
  return told.empty() || told == trace ? Result<void>() : dead;  // earlier versions told nothing
}

Result<void> StoreKeys::recover(Database& database, std::string_view words, KeySource& to, WallTime at) {
  RELIEVO_TRY_ASSIGN(const auto secret, recovery_secret(words));
  std::vector<std::byte> wrapped;
  RELIEVO_TRY_ASSIGN(const auto row, find_key(database, kRecovery, wrapped));
  if (row == 0)
    return database.error(Errc::NotFound,
                          "no recovery words were ever made for this store: only its key opens it");
  if (auto opened = open_recovered(secret, wrapped, store_); !opened)
    return opened.error().at(database.where());
  RELIEVO_TRY(load_device(database));
  return wrap_for_appliance(database, to, at);
}

Result<void> StoreKeys::draw_subject_key(Database& database, SubjectId id) {
  subject_.draw();
  return KeySlots(database, true).write(id, seal(store_, slot_of(id), subject_.bytes()));
}

Result<void> StoreKeys::take_subject_key(KeySlots& slots, SubjectId id) {
  RELIEVO_TRY_ASSIGN(const auto wrapped, slots.read(id));
  return unwrap(store_, slot_of(id), wrapped, subject_);
}

KeyedHash StoreKeys::name_hash(std::string_view name) const {
  return keyed_hash(search_, bytes_of("name " + normal_name(name)));
}

Result<Signed> StoreKeys::sign(std::span<const std::byte> bytes) const {
  RELIEVO_TRY_ASSIGN(auto seed, SecretKey::make());
  seed.derive(device_, kSigning);
  return sign_with(seed, bytes);
}

KeyedHash StoreKeys::code_hash(std::int64_t code) const {
  return keyed_hash(search_, bytes_of("code " + std::to_string(code)));
}

}  // namespace relievo::storage
