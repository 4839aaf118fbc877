// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "storage/record.h"

#include <string_view>

#include "storage/byte_order.h"

namespace relievo::storage {
namespace {

constexpr std::string_view kPersonMagic = "RPERSN";
constexpr std::uint16_t kPersonVersion = 1;

void walk_time(ByteWriter& to, const WallTime& at) { to.put(std::int64_t{at.time_since_epoch().count()}); }
void walk_time(ByteReader& from, WallTime& at) {
  at = WallTime(std::chrono::milliseconds(from.get<std::int64_t>()));
}

template <typename Io, typename Portrait>
void walk(Io& io, Portrait& one) {
  walk_time(io, one.created_at);
  walk_time(io, one.consent.given_at);
  for (auto* text : {&one.consent.wording, &one.consent.language, &one.algorithms, &one.report_json})
    io.text(*text);
  io.template run<std::byte>(one.calibration);
  io.template run<std::byte>(one.model);
}

}  // namespace

std::vector<std::byte> encode_person(const PersonRecord& person) {
  std::vector<std::byte> out;
  ByteWriter to(out);
  to.put(bytes_of(kPersonMagic));
  to.put(kPersonVersion);
  to.text(person.name);
  to.put(person.receipt);
  walk_time(to, person.created_at);
  to.put(std::uint32_t(person.portraits.size()));
  for (const PersonRecord::Portrait& one : person.portraits) walk(to, one);
  return out;
}

Result<PersonRecord> decode_person(std::span<const std::byte> bytes) {
  const Error strange{Errc::InvalidInput, "this is no record of a person, or it was changed or cut"};
  if (!text_of(bytes).starts_with(kPersonMagic)) return strange;
  ByteReader from(bytes.subspan(kPersonMagic.size()));
  const auto version = from.get<std::uint16_t>();
  if (version > kPersonVersion)
    return Error{Errc::StoreNewer, "this person was exported by a newer version: update Relievo"};
  PersonRecord person;
  from.text(person.name);
  from.numbers(person.receipt);
  walk_time(from, person.created_at);
  for (auto left = from.get<std::uint32_t>(); left > 0 && from.ok(); --left)
    walk(from, person.portraits.emplace_back());
  if (version != kPersonVersion || !from.whole()) return strange;
  return person;
}

}  // namespace relievo::storage
