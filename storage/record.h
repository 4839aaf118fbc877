// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The records of the store: plain data, no SQL, no files.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "hal/base/result.h"
#include "pipeline/model/calibration.h"
#include "pipeline/model/face_model.h"

namespace relievo::storage {

using WallTime = std::chrono::sys_time<std::chrono::milliseconds>;

// Types of their own: a subject's number cannot be passed where an enrolment's is asked for.
// Numbers are never given twice, not even after an erasure.
enum class SubjectId : std::int64_t {};
enum class EnrolmentId : std::int64_t {};

struct NewSubject {
  std::string name;  // UTF-8, 1 to kMaxNameBytes bytes; two people may have the same
};

// The person an enrolment belongs to: known already, or made in the same transaction.
using SubjectChoice = std::variant<SubjectId, NewSubject>;

struct Subject {
  SubjectId id{};
  std::string name;
  WallTime created_at;
  int enrolments = 0;
  std::int64_t receipt = 0;  // drawn when they came (draw_receipt())
};

struct SubjectFilter {
  std::string name{};     // empty: everyone
  std::int64_t skip = 0;  // for paging; the newest come first
  std::int64_t limit = 1000;
  std::int64_t receipt = 0;  // not 0: only whose receipt it is
};

// What a person agreed to, when, and to which wording.
struct Consent {
  std::string wording;   // version of the text that was shown, as "2026-03"
  std::string language;  // as "en"
  WallTime given_at;
  bool operator==(const Consent&) const = default;
};

// Borrowed for the call. The strings are stored as they are.
struct NewEnrolment {
  const pipeline::FaceModel& model;
  Consent consent;
  std::uint32_t calibration_revision = 0;  // 0: made with one that is not in the store
  std::string_view algorithms;             // the set of algorithms, TOML
  std::string_view report_json;
  bool renews = false;  // the subject's earlier enrolments are erased in the same transaction
};

struct Enrolment {
  EnrolmentId id{};
  SubjectId subject{};
  WallTime created_at;
  Consent consent;
  std::uint32_t calibration_revision = 0;
  std::string algorithms;
  std::string report_json;
  std::int64_t model_bytes = 0;
};

enum class CalibrationGrade : std::uint8_t { Unknown, Pass, Usable, Refuse };

// How good a calibration was found when it was made; Unknown and 0 of one that came from a file.
struct CalibrationFigures {
  CalibrationGrade grade = CalibrationGrade::Unknown;
  double held_out_epipolar_px = 0;  // of single corners, in views that had no part in the fit
  double depth_sigma_mm = 0;        // of a head's distance, one standard deviation
  double shape_sigma_mm = 0;        // and of its shape
};

struct CalibrationInfo {
  std::uint32_t revision = 0;
  WallTime created_at;
  std::string note;  // where it came from, as a person would say it
  double rms_px = 0;
  double epipolar_shift_px = 0;
  double baseline_mm = 0;
  CalibrationFigures figures;
  int width_px = 0;
  int height_px = 0;
  int enrolments = 0;  // made with it
  bool active = false;
};

// A person as one store hands them to another: every row and model, without loss; the numbers of records stay
// behind. As bytes, little-endian, texts behind their length (u32):
//   "RPERSN" u16 version | name | i64 receipt | i64 created, ms | u32 portraits | for each: i64 created, ms
//   | i64 consent given, ms | wording | language | algorithms | report | u64 size and a calibration_record.h
//   | u64 size and a model_blob.h
// No checksum: what carries it is signed (a bundle's manifest). Thread: any. May throw std::bad_alloc.
struct PersonRecord {
  struct Portrait {
    WallTime created_at;
    Consent consent;
    std::string algorithms;
    std::string report_json;
    std::vector<std::byte> calibration;  // none: made with one that is in no store
    std::vector<std::byte> model;
    bool operator==(const Portrait&) const = default;
  };
  std::string name;
  std::int64_t receipt = 0;
  WallTime created_at;
  std::vector<Portrait> portraits;  // oldest first
  bool operator==(const PersonRecord&) const = default;
};

inline constexpr const char* kPersonFile = "person.record";  // in a bundle

std::vector<std::byte> encode_person(const PersonRecord& person);
// InvalidInput: no such bytes, cut, longer. StoreNewer: a version not known here. What is in it is the
// store's to judge (Store::add_person).
Result<PersonRecord> decode_person(std::span<const std::byte> bytes);

// Nobody's name goes into the audit log: `subject` is a number that means nothing after an erasure.
struct AuditEvent {
  std::string what;     // as "subject.erased"
  SubjectId subject{};  // 0: nobody's
  std::string detail;
};

struct AuditRecord {
  std::int64_t number = 0;  // 1, 2, 3 ... without a gap
  WallTime at;
  AuditEvent event;
};

// Ed25519 (cipher/seal.h).
struct Signed {
  std::array<std::byte, 32> by{};  // the public half
  std::array<std::byte, 64> signature{};
};

inline constexpr std::size_t kMaxNameBytes = 200;
inline constexpr std::size_t kMaxTextBytes = 1'000'000;  // algorithms, report, setting, note, detail

// The number in the code a person quotes for their erasure: twelve digits, drawn by the system's generator
// for keys, so that who knows some knows nothing of another. Thread: any. Errors: none.
inline constexpr std::int64_t kLeastReceipt = 1, kMostReceipt = 999'999'999'999;

std::int64_t draw_receipt();

}  // namespace relievo::storage
