// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// SqliteStore: calibrations.
#include <cmath>

#include "storage/byte_order.h"
#include "storage/calibration_record.h"
#include "storage/sqlite/sqlite_parts.h"

namespace relievo::storage {
namespace {

Result<void> check_entry(const pipeline::StereoCalibration& calibration, std::string_view note) {
  if (note.size() > kMaxTextBytes) return invalid("the note is longer than the store takes");
  return check_calibration(calibration);
}

// The record says itself which revision it is: a swapped one is noticed.
Result<pipeline::StereoCalibration> record_in(const Statement& row) {
  RELIEVO_TRY_ASSIGN(const auto stored, decode_calibration(row.blob(1)));
  if (stored.calibration.revision != row.integer(0)) {
    return Error{Errc::StoreCorrupt, "a stored calibration stands in the place of another"};
  }
  return stored.calibration;
}

}  // namespace

Result<void> SqliteStore::make_active(std::uint32_t revision) {
  RELIEVO_TRY(database_->run("UPDATE calibration SET active = 0 WHERE active = 1"));
  RELIEVO_TRY(database_->run("UPDATE calibration SET active = 1 WHERE revision = ?", revision));
  if (database_->changes() != 1) return not_found("there is no calibration of this revision", revision);
  return {};
}

Result<std::uint32_t> SqliteStore::insert_calibration(const pipeline::StereoCalibration& calibration,
                                                      std::string_view note,
                                                      const CalibrationFigures& figures, WallTime at) {
  RELIEVO_TRY(database_->run(
      "INSERT INTO calibration (created_at_ms, record, active) VALUES (?, zeroblob(0), 0)", to_ms(at)));
  pipeline::StereoCalibration numbered = calibration;
  numbered.revision = std::uint32_t(database_->last_row_id());
  const auto record = encode_calibration(numbered, figures);
  const auto sealed = seal(keys_->device(), calibration_note(numbered.revision), bytes_of(note));
  RELIEVO_TRY(database_->run("UPDATE calibration SET record = ?, note = ? WHERE revision = ?", record, sealed,
                             numbered.revision));
  RELIEVO_TRY(append_line({"calibration.saved", {}, std::to_string(numbered.revision)}, at));
  return numbered.revision;
}

Result<std::uint32_t> SqliteStore::save_calibration(const pipeline::StereoCalibration& calibration,
                                                    std::string_view note,
                                                    const CalibrationFigures& figures) {
  RELIEVO_TRY(check_entry(calibration, note));
  return change([&](WallTime at) -> Result<std::uint32_t> {
    RELIEVO_TRY_ASSIGN(const std::uint32_t revision, insert_calibration(calibration, note, figures, at));
    RELIEVO_TRY(make_active(revision));
    return revision;
  });
}

Result<std::uint32_t> SqliteStore::revision_of(const pipeline::StereoCalibration& calibration) {
  RELIEVO_TRY_ASSIGN(auto query, database_->prepare("SELECT record FROM calibration ORDER BY revision DESC"));
  pipeline::StereoCalibration wanted = calibration;
  for (;;) {
    RELIEVO_TRY_ASSIGN(const bool row, query.step());
    if (!row) return 0;
    RELIEVO_TRY_ASSIGN(const auto stored, decode_calibration(query.blob(0)));
    wanted.revision = stored.calibration.revision;
    if (encode_calibration(stored.calibration) == encode_calibration(wanted)) return wanted.revision;
  }
}

Result<std::uint32_t> SqliteStore::know_calibration(const pipeline::StereoCalibration& calibration,
                                                    std::string_view note) {
  RELIEVO_TRY(check_entry(calibration, note));
  return change([&](WallTime at) -> Result<std::uint32_t> {
    RELIEVO_TRY_ASSIGN(const std::uint32_t known, revision_of(calibration));
    if (known != 0) return known;
    return insert_calibration(calibration, note, {}, at);
  });
}

// Of a portrait that comes from another store. Inside the caller's transaction.
Result<std::uint32_t> SqliteStore::revision_for(std::span<const std::byte> calibration_record, WallTime at) {
  if (calibration_record.empty()) return 0;
  RELIEVO_TRY_ASSIGN(const auto read, decode_calibration(calibration_record));
  RELIEVO_TRY(check_calibration(read.calibration));
  RELIEVO_TRY_ASSIGN(const std::uint32_t known, revision_of(read.calibration));
  if (known != 0) return known;
  return insert_calibration(read.calibration, "came with somebody's record", read.figures, at);
}

Result<std::vector<CalibrationInfo>> SqliteStore::calibrations() {
  return without_exceptions(database_->where(), [&]() -> Result<std::vector<CalibrationInfo>> {
    std::vector<CalibrationInfo> found;
    const auto read = [&](const Statement& row) -> Result<void> {
      RELIEVO_TRY_ASSIGN(const auto stored, decode_calibration(row.blob(4)));
      RELIEVO_TRY_ASSIGN(const auto note,
                         unseal(keys_->device(), calibration_note(row.integer(0)), row.blob(2)));
      const pipeline::StereoCalibration& calibration = stored.calibration;
      const pipeline::Vec3d& t = calibration.right_from_left.translation_mm;
      found.push_back({.revision = std::uint32_t(row.integer(0)),
                       .created_at = from_ms(row.integer(1)),
                       .note = std::string(text_of(note)),
                       .rms_px = calibration.rms_px,
                       .epipolar_shift_px = calibration.epipolar_shift_px,
                       .baseline_mm = std::hypot(t.x, t.y, t.z),
                       .figures = stored.figures,
                       .width_px = calibration.left.width_px,
                       .height_px = calibration.left.height_px,
                       .enrolments = int(row.integer(5)),
                       .active = row.integer(3) != 0});
      return {};
    };
    RELIEVO_TRY(
        database_->each("SELECT revision, created_at_ms, note, active, record, (SELECT count(*) "
                        "FROM enrolment WHERE calibration_revision = revision) "
                        "FROM calibration ORDER BY revision DESC",
                        read));
    return found;
  });
}

Result<pipeline::StereoCalibration> SqliteStore::calibration(std::uint32_t revision) {
  return without_exceptions(database_->where(), [&]() -> Result<pipeline::StereoCalibration> {
    RELIEVO_TRY_ASSIGN(
        const auto row,
        database_->row("SELECT revision, record FROM calibration WHERE revision = ?", revision));
    if (!row) return not_found("there is no calibration of this revision", revision);
    return record_in(*row);
  });
}

Result<pipeline::StereoCalibration> SqliteStore::active_calibration() {
  return without_exceptions(database_->where(), [&]() -> Result<pipeline::StereoCalibration> {
    RELIEVO_TRY_ASSIGN(const auto row,
                       database_->row("SELECT revision, record FROM calibration WHERE active = 1"));
    if (row) return record_in(*row);
    RELIEVO_TRY_ASSIGN(const std::int64_t kept, database_->integer("SELECT count(*) FROM calibration"));
    constexpr Literal kNoneInUse = "none of the store's calibrations is in use: activate one, or calibrate",
                      kNone = "the store holds no calibration: calibrate first";
    return Error{Errc::NotCalibrated, kept > 0 ? kNoneInUse : kNone}.at(database_->where());
  });
}

Result<void> SqliteStore::activate_calibration(std::uint32_t revision) {
  return change([&](WallTime at) -> Result<void> {
    RELIEVO_TRY(make_active(revision));
    return append_line({"calibration.activated", {}, std::to_string(revision)}, at);
  });
}

}  // namespace relievo::storage
