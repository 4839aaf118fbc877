// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "storage/sqlite/sqlite_keys.h"

#include <string>

#include "storage/byte_order.h"
#include "storage/sqlite/sqlite_change.h"
#include "storage/text.h"

namespace relievo::storage {
namespace {

constexpr std::string_view kAppliance = "appliance", kDevice = "device";
enum Purpose : std::uint64_t { kSearch = 1, kChain = 2 };

Place place_of(std::string_view kind) { return {"encryption_key", kind, 0}; }
Place slot_of(SubjectId id) { return {"subject_key", "slots", number(id)}; }

Result<std::int64_t> insert_key(Database& database, std::string_view kind, const SecretKey& by,
                                const SecretKey& key, WallTime at) {
  const auto wrapped = seal(by, place_of(kind), key.bytes());
  RELIEVO_TRY_ASSIGN(
      auto insert,
      database.prepare("INSERT INTO encryption_key (kind, created_at_ms, parameters) VALUES (?, ?, ?)"));
  RELIEVO_TRY(insert.bind(kind).bind(to_ms(at)).bind(wrapped).run());
  return database.last_row_id();
}

Result<std::int64_t> find_key(Database& database, std::string_view kind, std::vector<std::byte>& wrapped) {
  RELIEVO_TRY_ASSIGN(auto query,
                     database.prepare("SELECT id, parameters FROM encryption_key WHERE kind = ?"));
  RELIEVO_TRY_ASSIGN(const bool row, query.bind(kind).step());
  if (!row)
    return Error{Errc::StoreCorrupt, "the store has lost its keys: restore a copy"}.at(database.where());
  wrapped.assign(query.blob(1).begin(), query.blob(1).end());
  return query.integer(0);
}

}  // namespace

StoreKeys::StoreKeys(std::shared_ptr<KeySource> source, SecretKey (&&rooms)[6], SealedStream stream)
    : source_(std::move(source)),
      appliance_(std::move(rooms[0])),
      store_(std::move(rooms[1])),
      device_(std::move(rooms[2])),
      search_(std::move(rooms[3])),
      chain_(std::move(rooms[4])),
      subject_(std::move(rooms[5])),
      stream_(std::move(stream)) {}

Result<std::unique_ptr<StoreKeys>> StoreKeys::make(std::shared_ptr<KeySource> source) {
  RELIEVO_TRY_ASSIGN(auto a, SecretKey::make());
  RELIEVO_TRY_ASSIGN(auto b, SecretKey::make());
  RELIEVO_TRY_ASSIGN(auto c, SecretKey::make());
  RELIEVO_TRY_ASSIGN(auto d, SecretKey::make());
  RELIEVO_TRY_ASSIGN(auto e, SecretKey::make());
  RELIEVO_TRY_ASSIGN(auto f, SecretKey::make());
  RELIEVO_TRY_ASSIGN(auto stream, SealedStream::make());
  return std::unique_ptr<StoreKeys>(new StoreKeys(
      std::move(source), {std::move(a), std::move(b), std::move(c), std::move(d), std::move(e), std::move(f)},
      std::move(stream)));
}

void StoreKeys::derive() {
  search_.derive(device_, kSearch);
  chain_.derive(device_, kChain);
  appliance_.wipe();
}

Result<void> StoreKeys::create(Database& database, WallTime at) {
  auto there = source_->read(appliance_);
  if (!there && there.error().code == Errc::NotFound) there = source_->make(appliance_);
  if (!there) return there;
  store_.draw();
  device_.draw();
  RELIEVO_TRY_ASSIGN(id_, insert_key(database, kAppliance, appliance_, store_, at));
  RELIEVO_TRY_ASSIGN(const auto device, insert_key(database, kDevice, store_, device_, at));
  (void)device;
  derive();
  return {};
}

Result<void> StoreKeys::load(Database& database) {
  std::vector<std::byte> wrapped;
  RELIEVO_TRY_ASSIGN(id_, find_key(database, kAppliance, wrapped));
  RELIEVO_TRY(source_->read(appliance_));
  if (!unwrap(appliance_, place_of(kAppliance), wrapped, store_))
    return Error{Errc::InvalidInput,
                 "this is not the key of this store: name the right one (--key), or recover the store"}
        .at(database.where());
  RELIEVO_TRY_ASSIGN(const auto device, find_key(database, kDevice, wrapped));
  (void)device;
  RELIEVO_TRY(unwrap(store_, place_of(kDevice), wrapped, device_));
  derive();
  return {};
}

Result<void> StoreKeys::draw_subject_key(Database& database, SubjectId id) {
  subject_.draw();
  return KeySlots(database).write(id, seal(store_, slot_of(id), subject_.bytes()));
}

Result<void> StoreKeys::take_subject_key(KeySlots& slots, SubjectId id) {
  RELIEVO_TRY_ASSIGN(const auto wrapped, slots.read(id));
  return unwrap(store_, slot_of(id), wrapped, subject_);
}

KeyedHash StoreKeys::name_hash(std::string_view name) const {
  return keyed_hash(search_, bytes_of("name " + normal_name(name)));
}

KeyedHash StoreKeys::code_hash(std::int64_t code) const {
  return keyed_hash(search_, bytes_of("code " + std::to_string(code)));
}

}  // namespace relievo::storage
