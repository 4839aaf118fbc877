// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "storage/sqlite/sqlite_sealed_rows.h"

#include <algorithm>

#include "storage/byte_order.h"
#include "storage/sqlite/sqlite_change.h"

namespace relievo::storage {
namespace {

constexpr std::size_t kNameStep = 64;

Place name_of(SubjectId id) { return {"subject", "name", number(id)}; }
Place code_of(SubjectId id) { return {"subject", "code", number(id)}; }
Place record_of(EnrolmentId id) { return {"enrolment", "record", number(id)}; }
Place consent_of(EnrolmentId id) { return {"consent", "record", number(id)}; }
Place model_of(EnrolmentId id) { return {"model", "bytes", number(id)}; }

// Sealed and whole, and yet not what we write: made by nobody we know.
Error strange() { return {Errc::StoreCorrupt, "a sealed record is not laid out as this version knows it"}; }

}  // namespace

Result<void> seal_subject(Database& database, StoreKeys& keys, SubjectId id, std::string_view name,
                          std::int64_t code) {
  RELIEVO_TRY(keys.draw_subject_key(database, id));
  std::string padded(name);
  padded.resize((name.size() + kNameStep - 1) / kNameStep * kNameStep);
  const auto sealed_name = seal(keys.subject(), name_of(id), bytes_of(padded));
  const auto sealed_code = seal(keys.subject(), code_of(id), bytes_of(std::to_string(code)));
  const auto name_hash = keys.name_hash(name), code_hash = keys.code_hash(code);
  RELIEVO_TRY_ASSIGN(auto update, database.prepare("UPDATE subject SET key_id = ?, name = ?, name_hash = ?, "
                                                   "code = ?, code_hash = ? WHERE id = ?"));
  update.bind(keys.id()).bind(sealed_name).bind(name_hash).bind(sealed_code).bind(code_hash);
  return update.bind(number(id)).run();
}

Result<std::string> open_name(const StoreKeys& keys, SubjectId id, std::span<const std::byte> sealed) {
  RELIEVO_TRY_ASSIGN(const auto plain, unseal(keys.subject(), name_of(id), sealed));
  std::string name(reinterpret_cast<const char*>(plain.data()), plain.size());
  name.resize(name.find_last_not_of('\0') + 1);
  return name;
}

Result<std::int64_t> open_code(const StoreKeys& keys, SubjectId id, std::span<const std::byte> sealed) {
  RELIEVO_TRY_ASSIGN(const auto plain, unseal(keys.subject(), code_of(id), sealed));
  std::int64_t code = 0;
  for (const std::byte digit : plain) code = code * 10 + (std::to_integer<int>(digit) - '0');
  return code;
}

Result<void> seal_enrolment(Database& database, const StoreKeys& keys, EnrolmentId id,
                            std::string_view algorithms, std::string_view report_json) {
  std::vector<std::byte> plain;
  ByteWriter to(plain);
  put_text(to, algorithms);
  put_text(to, report_json);
  const auto sealed = seal(keys.subject(), record_of(id), plain);
  RELIEVO_TRY_ASSIGN(auto update, database.prepare("UPDATE enrolment SET record = ? WHERE id = ?"));
  return update.bind(sealed).bind(number(id)).run();
}

Result<EnrolmentTexts> open_enrolment(const StoreKeys& keys, EnrolmentId id,
                                      std::span<const std::byte> sealed) {
  RELIEVO_TRY_ASSIGN(const auto plain, unseal(keys.subject(), record_of(id), sealed));
  ByteReader from(plain);
  EnrolmentTexts texts;
  texts.algorithms = get_text(from);
  texts.report_json = get_text(from);
  if (!from.ok() || from.left() != 0) return strange();
  return texts;
}

Result<void> seal_consent(Database& database, const StoreKeys& keys, EnrolmentId id, const Consent& consent) {
  std::vector<std::byte> plain;
  ByteWriter to(plain);
  to.put(to_ms(consent.given_at));
  put_text(to, consent.wording);
  put_text(to, consent.language);
  const auto sealed = seal(keys.subject(), consent_of(id), plain);
  RELIEVO_TRY_ASSIGN(auto update, database.prepare("UPDATE consent SET record = ? WHERE enrolment_id = ?"));
  return update.bind(sealed).bind(number(id)).run();
}

Result<Consent> open_consent(const StoreKeys& keys, EnrolmentId id, std::span<const std::byte> sealed) {
  RELIEVO_TRY_ASSIGN(const auto plain, unseal(keys.subject(), consent_of(id), sealed));
  ByteReader from(plain);
  Consent consent;
  consent.given_at = from_ms(from.get<std::int64_t>());
  consent.wording = get_text(from);
  consent.language = get_text(from);
  if (!from.ok() || from.left() != 0) return strange();
  return consent;
}

Result<void> seal_model(Database& database, StoreKeys& keys, EnrolmentId id,
                        std::span<const std::byte> blob) {
  SealedStream& stream = keys.stream();
  const StreamHeader header = stream.begin_sealing(keys.subject());
  {
    RELIEVO_TRY_ASSIGN(
        auto row,
        database.prepare("INSERT OR REPLACE INTO model (enrolment_id, nonce, bytes) VALUES (?, ?, ?)"));
    row.bind(number(id)).bind(header);
    RELIEVO_TRY(row.bind_zeros(static_cast<std::int64_t>(SealedStream::sealed_bytes(blob.size()))).run());
  }
  RELIEVO_TRY_ASSIGN(auto target, Blob::open(database, "model", "bytes", number(id), true));
  std::size_t at = 0;
  do {
    const auto piece = blob.first(std::min(blob.size(), SealedStream::kPieceBytes));
    blob = blob.subspan(piece.size());
    const auto sealed = stream.seal_piece(model_of(id), piece, blob.empty());
    RELIEVO_TRY(target.write(at, sealed));
    at += sealed.size();
  } while (!blob.empty());
  stream.end();
  return {};
}

Result<std::vector<std::byte>> open_model(Database& database, StoreKeys& keys, EnrolmentId id) {
  StreamHeader header{};
  {
    RELIEVO_TRY_ASSIGN(auto query, database.prepare("SELECT nonce FROM model WHERE enrolment_id = ?"));
    RELIEVO_TRY_ASSIGN(const bool row, query.bind(number(id)).step());
    if (!row)
      return Error{Errc::StoreCorrupt, "a record of the store has lost its model: restore a copy"}.at(
          "enrolment " + std::to_string(number(id)));
    // A header of another length opens nothing; open_piece() says so, and where.
    if (query.blob(0).size() == header.size()) std::ranges::copy(query.blob(0), header.begin());
  }
  RELIEVO_TRY_ASSIGN(auto source, Blob::open(database, "model", "bytes", number(id), false));
  std::vector<std::byte> blob(SealedStream::plain_bytes(source.size()));
  std::vector<std::byte> piece(std::min(source.size(), SealedStream::kSealedPieceBytes));
  SealedStream& stream = keys.stream();
  stream.begin_opening(keys.subject(), header);
  auto rest = std::span(blob);
  std::size_t at = 0;
  do {
    const auto sealed = std::span(piece).first(std::min(piece.size(), source.size() - at));
    RELIEVO_TRY(source.read(at, sealed));
    at += sealed.size();
    const std::size_t plain =
        sealed.size() < SealedStream::kTagBytes ? 0 : sealed.size() - SealedStream::kTagBytes;
    // A last piece too short for its own tag leaves less room than it says: refused for its length.
    const auto room = rest.first(std::min(plain, rest.size()));
    RELIEVO_TRY(stream.open_piece(model_of(id), sealed, at == source.size(), room));
    rest = rest.subspan(room.size());
  } while (at < source.size());
  stream.end();
  return blob;
}

}  // namespace relievo::storage
