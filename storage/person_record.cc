// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "storage/person_record.h"

#include <algorithm>
#include <string_view>

#include "storage/byte_order.h"

namespace relievo::storage {
namespace {

constexpr std::string_view kPersonMagic = "RPERSN";
constexpr std::uint16_t kPersonVersion = 1;

void put_time(ByteWriter& to, WallTime at) { to.put(std::int64_t{at.time_since_epoch().count()}); }
WallTime get_time(ByteReader& from) { return WallTime(std::chrono::milliseconds(from.get<std::int64_t>())); }

void put_piece(ByteWriter& to, std::span<const std::byte> piece) {
  to.put(std::uint64_t(piece.size()));
  to.put(piece);
}
std::vector<std::byte> get_piece(ByteReader& from) {
  const auto size = from.get<std::uint64_t>();
  std::vector<std::byte> piece(std::min<std::uint64_t>(size, from.left()));
  from.get_run<std::byte>(std::span(piece));
  return piece;
}

}  // namespace

std::vector<std::byte> encode_person(const PersonRecord& person) {
  std::vector<std::byte> out;
  ByteWriter to(out);
  to.put(bytes_of(kPersonMagic));
  to.put(kPersonVersion);
  put_text(to, person.name);
  to.put(person.receipt);
  put_time(to, person.created_at);
  to.put(std::uint32_t(person.portraits.size()));
  for (const PersonRecord::Portrait& one : person.portraits) {
    put_time(to, one.created_at);
    put_time(to, one.consent.given_at);
    for (const std::string_view text :
         {std::string_view(one.consent.wording), std::string_view(one.consent.language),
          std::string_view(one.algorithms), std::string_view(one.report_json)})
      put_text(to, text);
    put_piece(to, one.calibration);
    put_piece(to, one.model);
  }
  return out;
}

Result<PersonRecord> decode_person(std::span<const std::byte> bytes) {
  constexpr std::size_t kHead = kPersonMagic.size();
  const Error strange{Errc::InvalidInput, "this is no record of a person, or it was changed or cut"};
  if (bytes.size() < kHead || !std::ranges::equal(bytes.first(kHead), bytes_of(kPersonMagic))) return strange;
  ByteReader from(bytes.subspan(kHead));
  if (from.get<std::uint16_t>() > kPersonVersion)
    return Error{Errc::StoreNewer, "this person was exported by a newer version: update Relievo"};
  PersonRecord person;
  person.name = get_text(from);
  person.receipt = from.get<std::int64_t>();
  person.created_at = get_time(from);
  // What ends too early gives empty pieces, and is not written again as it was.
  for (auto left = from.get<std::uint32_t>(); left > 0 && from.ok(); --left) {
    PersonRecord::Portrait& one = person.portraits.emplace_back();
    one.created_at = get_time(from);
    one.consent.given_at = get_time(from);
    for (std::string* text : {&one.consent.wording, &one.consent.language, &one.algorithms, &one.report_json})
      *text = get_text(from);
    one.calibration = get_piece(from);
    one.model = get_piece(from);
  }
  if (encode_person(person) != std::vector<std::byte>(bytes.begin(), bytes.end())) return strange;
  return person;
}

}  // namespace relievo::storage
