// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/kiosk/stored_visits.h"

#include <algorithm>
#include <chrono>
#include <new>
#include <sstream>

#include "firmware/base/budget.h"
#include "firmware/base/settings.h"
#include "firmware/base/wall_time.h"
#include "firmware/records/receipt.h"
#include "firmware/report/report.h"
#include "hal/base/whole_file.h"

namespace relievo::firmware {
namespace {

constexpr std::int64_t kHourS = 3600;
constexpr const char* kMovedFacesSetting = "moved_faces";

}  // namespace

Result<CodeGuard::Record> CodeGuard::read() {
  const std::int64_t now_s =
      std::chrono::floor<std::chrono::seconds>(clock_.wall_now()).time_since_epoch().count();
  const Record fresh{0, now_s};
  RELIEVO_TRY_ASSIGN(const std::string text, store_.setting(kCodesSetting));
  if (text.empty()) return fresh;
  std::istringstream in(text);
  Record record;
  if (!(in >> record.wrong >> record.since_s) || record.wrong < 0) return Record{kMostWrongCodes, now_s};
  if (now_s < record.since_s) record.since_s = now_s;
  return now_s - record.since_s >= kHourS ? fresh : record;
}

Result<void> CodeGuard::write(const Record& record) {
  return store_.set_setting(kCodesSetting,
                            std::to_string(record.wrong) + " " + std::to_string(record.since_s));
}

Result<bool> CodeGuard::spend() {
  RELIEVO_TRY_ASSIGN(Record record, read());
  if (record.wrong >= kMostWrongCodes) {
    RELIEVO_TRY(write(record));  // an hour that began anew is kept
    return false;
  }
  ++record.wrong;
  RELIEVO_TRY(write(record));
  return true;
}

Result<void> CodeGuard::was_right() {
  RELIEVO_TRY_ASSIGN(Record record, read());
  record.wrong = std::max(0, record.wrong - 1);
  return write(record);
}

bool StoredVisits::has_room(std::int32_t least_mib) const {
  const auto room = disk_has_room(folder_, least_mib);
  return room || room.error().code != Errc::MediaFull;
}

Result<KeptVisit> StoredVisits::keep(const VisitRecord& record, const pipeline::FaceModel& model) {
  RELIEVO_TRY(disk_has_room(folder_, record.least_room_mib));
  const auto now = stored_time(clock_.wall_now());
  if (now < record.consent.given_at - std::chrono::minutes(1))
    return invalid("the clock went back after the person had agreed: set it");
  Report report{record.calibration_note, record.algorithms,     record.stages, {},
                peak_rss_bytes(),        model.quality,         record.drift,  {},
                model.landmarks,         model.head_from_camera};
  for (const StageRecord& stage : report.stages) report.total += stage.took;
  const std::string json = report_json(report);
  // Somebody new, unless a record was named by its code: that two people have one name must mix nothing up.
  const storage::SubjectChoice whose = record.whose ? storage::SubjectChoice(*record.whose)
                                                    : storage::NewSubject{std::string(record.name.view())};
  KeptVisit kept;
  storage::Subject owner;
  RELIEVO_TRY_ASSIGN(kept.enrolment, store_.add_enrolment(whose,
                                                          {model, record.consent, record.calibration,
                                                           record.algorithms, json, record.renews},
                                                          &owner));
  // It is stored: nothing from here on may fail, or its person would be told that it is not.
  kept.receipt = short_receipt_of(owner);
  kept.at = now;
  try {
    if (const auto link = link_number_of(store_, owner)) kept.link = std::string_view(*link);
  } catch (const std::bad_alloc&) {  // the code alone, then
  }
  return kept;
}

// Nothing but whether there is such a record leaves this function.
Result<RecordAnswer> StoredVisits::look_up(const RecordQuestion& question) {
  if (!question.code.empty()) {
    CodeGuard guard(store_, clock_);
    RELIEVO_TRY_ASSIGN(const bool listens, guard.spend());
    const Result<storage::Subject> subject =
        listens ? find_by_receipt(store_, question.code.view())
                : Result<storage::Subject>(Error{Errc::NotFound, "no code of a record"});
    if (!subject && subject.error().code != Errc::NotFound) return subject.error();
    if (!subject || subject->name != question.name.view()) return RecordAnswer{ui::Known::NoSuchCode};
    RELIEVO_TRY(guard.was_right());
    return RecordAnswer{ui::Known::Code, subject->id};
  }
  if (!question.tells_names) return RecordAnswer{ui::Known::Nobody};
  RELIEVO_TRY_ASSIGN(const auto same,
                     store_.subjects({.name = std::string(question.name.view()), .limit = 1}));
  return RecordAnswer{same.empty() ? ui::Known::Nobody : ui::Known::Name};
}

Result<MovedFaces::Said> MovedFaces::read(std::uint32_t revision) {
  revision_ = revision;
  kept_ = {};
  RELIEVO_TRY_ASSIGN(const std::string kept, store_.setting(kMovedFacesSetting));
  std::istringstream in(kept);
  int faces = 0;
  std::uint32_t of = 0;
  // Whatever else stands there was not written by this program: then the next faces say it again.
  if (!(in >> faces >> of) || of != revision || faces < 0) return kept_;
  kept_.faces = faces;
  if (in.get() == ' ') std::getline(in, kept_.note);
  return kept_;
}

void MovedFaces::keep(std::uint32_t revision, int faces, std::string_view note, SideTasks& side_tasks,
                      EventLog& log, hal::Instant now) {
  const bool said = faces != kept_.faces || note != kept_.note;
  const bool changed = said || revision != revision_;
  const bool again = retry_at_ && now >= *retry_at_;
  if (!changed && !again) return;
  const bool news = said || again;  // another calibration of which nothing is said needs no line
  revision_ = revision;
  if (said) kept_ = {faces, std::string(note)};
  if (!news && kept_ == Said{}) return;
  retry_at_.reset();
  side_tasks.send(
      JobLane::Keeper,
      [this, text = std::to_string(kept_.faces) + " " + std::to_string(revision) + " " +
                    kept_.note](JobControl&) { return store_.set_setting(kMovedFacesSetting, text); },
      [this, &log, again, now](const std::optional<Error>& error) {
        if (!error) return;
        retry_at_ = now + budget::kMovedFacesRetry;
        if (!again) log.fault(*error);
      },
      SideTasks::Whose::Device);
}

Result<std::unique_ptr<RunMark>> RunMark::set(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "relievo.running";
  std::error_code error;
  const bool there = std::filesystem::exists(file, error);
  // On the disk before anybody comes, and gone from it before the program says that it has ended.
  if (!there) RELIEVO_TRY(write_whole_file(file, {}, {}, 0600));
  return std::unique_ptr<RunMark>(new RunMark(file, there));
}

RunMark::~RunMark() {
  if (stays_) return;
  std::error_code error;
  std::filesystem::remove(file_, error);
  (void)sync_directory(file_.parent_path());
}

}  // namespace relievo::firmware
