// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "storage/sqlite/sqlite_parts.h"

#include <algorithm>

#include "storage/byte_order.h"

namespace relievo::storage {
namespace {

// Of one transaction: the log grows by as much.
constexpr int kMostPeople = 200;
constexpr std::size_t kMostBytes = 64'000'000;

constexpr std::size_t kNameStep = 64;

Place name_of(SubjectId id) { return {"subject", "name", number(id)}; }
Place code_of(SubjectId id) { return {"subject", "code", number(id)}; }
Place record_of(EnrolmentId id) { return {"enrolment", "record", number(id)}; }
Place consent_of(EnrolmentId id) { return {"consent", "record", number(id)}; }
Place model_of(EnrolmentId id) { return {"model", "bytes", number(id)}; }

// Sealed and whole, and yet not what we write: made by nobody we know.
Error strange() { return {Errc::StoreCorrupt, "a sealed record is not laid out as this version knows it"}; }

Result<std::size_t> seal_plain_model(Database& database, StoreKeys& keys, EnrolmentId id) {
  std::vector<std::byte> plain;
  {
    RELIEVO_TRY_ASSIGN(auto source, Blob::open(database, "model", "bytes", number(id), false));
    plain.resize(source.size());
    RELIEVO_TRY(source.read(0, plain));
  }
  RELIEVO_TRY(seal_model(database, keys, id, plain));
  // The plain one is about to go for good.
  RELIEVO_TRY_ASSIGN(const auto back, open_model(database, keys, id));
  if (back != plain)
    return database.error(Errc::StoreCorrupt,
                          "a model did not come back as it was sealed: check memory and disk");
  return plain.size();
}

Result<std::size_t> seal_person(Database& database, StoreKeys& keys, SubjectId id) {
  std::size_t bytes = 0;
  const auto seal_one = [&](const Statement& row) -> Result<void> {
    const EnrolmentId enrolment{row.integer(0)};
    const Consent consent{std::string(row.text(3)), std::string(row.text(4)), from_ms(row.integer(5))};
    RELIEVO_TRY(seal_enrolment(database, keys, enrolment, row.text(1), row.text(2)));
    RELIEVO_TRY(seal_consent(database, keys, enrolment, consent));
    RELIEVO_TRY_ASSIGN(const std::size_t model, seal_plain_model(database, keys, enrolment));
    bytes += model;
    return {};
  };
  RELIEVO_TRY(
      database.each("SELECT enrolment.id, algorithms, report_json, wording, language, given_at_ms "
                    "FROM enrolment JOIN consent ON enrolment_id = enrolment.id "
                    "WHERE subject_id = ? AND enrolment.record IS NULL ORDER BY enrolment.id",
                    seal_one, number(id)));
  return bytes;
}

// The stream's state opens a model as its key does: it is wiped on every way out.
struct StreamEnd {
  SealedStream& stream;
  ~StreamEnd() { stream.end(); }
};

// false: nobody is left.
Result<bool> seal_some_people(Database& database, StoreKeys& keys) {
  Transaction transaction(database);
  RELIEVO_TRY(transaction.begin());
  std::size_t bytes = 0;
  for (int people = 0; people < kMostPeople && bytes < kMostBytes; ++people) {
    SubjectId id{};
    {
      RELIEVO_TRY_ASSIGN(const auto row, database.row("SELECT id, name, receipt FROM subject WHERE code_hash "
                                                      "IS NULL AND key_id IS NULL ORDER BY id LIMIT 1"));
      if (!row) {
        RELIEVO_TRY(transaction.commit());
        return false;
      }
      id = SubjectId{row->integer(0)};
      const std::string name(text_of(row->blob(1)));
      RELIEVO_TRY(seal_subject(database, keys, id, name, row->integer(2)));
    }
    RELIEVO_TRY_ASSIGN(const std::size_t models, seal_person(database, keys, id));
    bytes += models;
  }
  RELIEVO_TRY(transaction.commit());
  return true;
}

Result<void> seal_notes(Database& database, const StoreKeys& keys) {
  return database.each("SELECT revision, note FROM calibration", [&](const Statement& row) {
    const std::int64_t revision = row.integer(0);
    const auto sealed = seal(keys.device(), calibration_note(revision), bytes_of(row.text(1)));
    return database.run("UPDATE calibration SET sealed_note = ?, note = '' WHERE revision = ?", sealed,
                        revision);
  });
}

Result<void> seal_settings(Database& database, const StoreKeys& keys) {
  Settings settings;
  RELIEVO_TRY(database.each("SELECT key, value FROM setting", [&](const Statement& row) {
    settings.insert_or_assign(std::string(row.text(0)), std::string(row.text(1)));
  }));
  RELIEVO_TRY_ASSIGN(const std::int64_t line, last_setting_line(database));
  return write_settings(database, keys, settings, line);
}

}  // namespace

Result<void> seal_people(Database& database, StoreKeys& keys) {
  for (;;) {
    RELIEVO_TRY_ASSIGN(const bool more, seal_some_people(database, keys));
    if (!more) return {};
  }
}

Result<void> seal_the_rest(Database& database, const StoreKeys& keys) {
  RELIEVO_TRY(database.run("UPDATE store_info SET plain_traces = 1"));
  RELIEVO_TRY(seal_notes(database, keys));
  RELIEVO_TRY(seal_settings(database, keys));
  return seal_audit(database, keys);
}

Result<void> remove_plain_traces(Database& database) {
  RELIEVO_TRY_ASSIGN(const std::int64_t traces, database.integer("SELECT plain_traces FROM store_info"));
  if (traces == 0) return {};
  // A new copy of all that is there, and of nothing else, takes the file's place. It would not fit into
  // memory.
  const auto copied = database.run("PRAGMA temp_store = FILE; VACUUM");
  RELIEVO_TRY(database.run("PRAGMA temp_store = MEMORY"));
  if (!copied) return copied.error().code == Errc::MediaFull ? Result<void>() : copied;
  return database.run("UPDATE store_info SET plain_traces = 0");
}

Result<void> seal_subject(Database& database, StoreKeys& keys, SubjectId id, std::string_view name,
                          std::int64_t code) {
  RELIEVO_TRY(keys.draw_subject_key(database, id));
  std::string padded(name);
  padded.resize((name.size() + kNameStep - 1) / kNameStep * kNameStep);
  const auto sealed_name = seal(keys.subject(), name_of(id), bytes_of(padded));
  const auto sealed_code = seal(keys.subject(), code_of(id), bytes_of(std::to_string(code)));
  const auto name_hash = keys.name_hash(name), code_hash = keys.code_hash(code);
  return database.run(
      "UPDATE subject SET key_id = ?, name = ?, name_hash = ?, code = ?, code_hash = ? WHERE id = ?",
      keys.id(), sealed_name, name_hash, sealed_code, code_hash, number(id));
}

Result<std::string> open_name(const StoreKeys& keys, SubjectId id, std::span<const std::byte> sealed) {
  RELIEVO_TRY_ASSIGN(const auto plain, unseal(keys.subject(), name_of(id), sealed));
  std::string name(text_of(plain));
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
  to.text(algorithms);
  to.text(report_json);
  const auto sealed = seal(keys.subject(), record_of(id), plain);
  return database.run("UPDATE enrolment SET record = ? WHERE id = ?", sealed, number(id));
}

Result<void> open_enrolment(const StoreKeys& keys, Enrolment& enrolment, std::span<const std::byte> sealed) {
  RELIEVO_TRY_ASSIGN(const auto plain, unseal(keys.subject(), record_of(enrolment.id), sealed));
  ByteReader from(plain);
  from.text(enrolment.algorithms);
  from.text(enrolment.report_json);
  return from.whole() ? Result<void>() : strange();
}

Result<void> seal_consent(Database& database, const StoreKeys& keys, EnrolmentId id, const Consent& consent) {
  std::vector<std::byte> plain;
  ByteWriter to(plain);
  to.put(to_ms(consent.given_at));
  to.text(consent.wording);
  to.text(consent.language);
  const auto sealed = seal(keys.subject(), consent_of(id), plain);
  return database.run("UPDATE consent SET record = ? WHERE enrolment_id = ?", sealed, number(id));
}

Result<Consent> open_consent(const StoreKeys& keys, EnrolmentId id, std::span<const std::byte> sealed) {
  RELIEVO_TRY_ASSIGN(const auto plain, unseal(keys.subject(), consent_of(id), sealed));
  ByteReader from(plain);
  Consent consent;
  consent.given_at = from_ms(from.get<std::int64_t>());
  from.text(consent.wording);
  from.text(consent.language);
  if (!from.whole()) return strange();
  return consent;
}

Result<void> seal_model(Database& database, StoreKeys& keys, EnrolmentId id,
                        std::span<const std::byte> blob) {
  SealedStream& stream = keys.stream();
  const StreamEnd end{stream};
  const StreamHeader header = stream.begin_sealing(keys.subject());
  RELIEVO_TRY(database.run("INSERT OR REPLACE INTO model (enrolment_id, nonce, bytes) VALUES (?, ?, ?)",
                           number(id), header, Zeros{std::int64_t(SealedStream::sealed_bytes(blob.size()))}));
  RELIEVO_TRY_ASSIGN(auto target, Blob::open(database, "model", "bytes", number(id), true));
  std::size_t at = 0;
  do {
    const auto piece = blob.first(std::min(blob.size(), SealedStream::kPieceBytes));
    blob = blob.subspan(piece.size());
    const auto sealed = stream.seal_piece(model_of(id), piece, blob.empty());
    RELIEVO_TRY(target.write(at, sealed));
    at += sealed.size();
  } while (!blob.empty());
  return {};
}

Result<std::vector<std::byte>> open_model(Database& database, StoreKeys& keys, EnrolmentId id) {
  StreamHeader header{};
  {
    RELIEVO_TRY_ASSIGN(const auto row,
                       database.row("SELECT nonce FROM model WHERE enrolment_id = ?", number(id)));
    if (!row) return corrupt(id, "a record of the store has lost its model: restore a copy");
    // A header of another length opens nothing; open_piece() says so, and where.
    if (row->blob(0).size() == header.size()) std::ranges::copy(row->blob(0), header.begin());
  }
  RELIEVO_TRY_ASSIGN(auto source, Blob::open(database, "model", "bytes", number(id), false));
  std::vector<std::byte> blob(SealedStream::plain_bytes(source.size()));
  std::vector<std::byte> piece(std::min(source.size(), SealedStream::kSealedPieceBytes));
  SealedStream& stream = keys.stream();
  const StreamEnd end{stream};
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
  return blob;
}

}  // namespace relievo::storage
