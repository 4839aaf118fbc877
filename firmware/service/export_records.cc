// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/service/export_records.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <memory_resource>
#include <string>
#include <utility>

#include "firmware/base/output_folder.h"
#include "firmware/base/version.h"
#include "firmware/base/wall_time.h"
#include "firmware/records/bundle_manifest.h"
#include "firmware/records/receipt.h"
#include "firmware/service/further_models.h"
#include "firmware/service/page_controller.h"
#include "firmware/service/stick_folder.h"
#include "pipeline/recognition/recognition_images.h"
#include "storage/export/model_files.h"

namespace relievo::firmware {
namespace {

namespace fs = std::filesystem;

std::string note_of(const storage::Subject& subject, const storage::Enrolment& newest) {
  return "code: " + receipt_of(subject) + "\nname: " + subject.name +
         "\nkept since: " + text_of(subject.created_at) +
         "\nportraits: " + std::to_string(subject.enrolments) + "\nthis one: " + text_of(newest.created_at) +
         "\nconsent: " + newest.consent.wording + " (" + newest.consent.language + ") " +
         text_of(newest.consent.given_at) + "\n";
}

constexpr float kWritten = 0.85F;  // of the progress: what follows is compared once more

// One export: the errors of its steps, and its progress.
class Export {
 public:
  Export(storage::Store& store, const hal::Clock& clock, hal::RemovableMedia& media,
         const FurtherModels& further, JobControl& control, ExportTrace& trace)
      : store_(store), clock_(clock), media_(media), further_(further), work_{control, trace} {}

  Result<void> one(storage::SubjectId id, const fs::path& root, float done, float share) {
    RELIEVO_TRY(work_.reach(ExportStep::Load, done));
    RELIEVO_TRY_ASSIGN(const storage::Subject subject, store_.subject(id));
    RELIEVO_TRY_ASSIGN(const auto enrolments, store_.enrolments(id));
    if (enrolments.empty()) return Error{Errc::NotFound, "has no portrait"};
    std::pmr::monotonic_buffer_resource memory;
    RELIEVO_TRY_ASSIGN(const pipeline::FaceModel model, store_.load_model(enrolments.back().id, &memory));
    const auto images = pipeline::make_recognition_images(model, memory, memory);
    if (!images && images.error().code == Errc::OutOfMemory) return images.error();
    RELIEVO_TRY(work_.reach(ExportStep::Write, done + 0.15F * share));
    RELIEVO_TRY_ASSIGN(const fs::path target,
                       place_on_stick(root, fs::path("relievo") / receipt_of(subject)));
    RELIEVO_TRY_ASSIGN(OutputFolder folder, OutputFolder::begin(target));
    storage::ExportOptions options(storage::ExportFrame::Head);
    options.version = kVersion;
    if (images) options.images = &*images;  // without a surface there are none
    RELIEVO_TRY(storage::write_model_files(model, folder.path(), options));
    RELIEVO_TRY(work_.reach(ExportStep::Write, done + 0.35F * share));
    RELIEVO_TRY_ASSIGN(const auto lines, write_further_models(model, further_, folder.path(), options.frame,
                                                              target, work_.control.cancelled));
    std::string note = note_of(subject, enrolments.back());
    for (const std::string& line : lines) note += line + "\n";  // of a solid also why there is none
    RELIEVO_TRY(write_text(folder.path() / "record.txt", note, "record.txt"));
    if (!enrolments.back().report_json.empty())
      RELIEVO_TRY(write_text(folder.path() / "report.json", enrolments.back().report_json, "report.json"));
    const auto now = std::chrono::time_point_cast<std::chrono::milliseconds>(clock_.wall_now());
    RELIEVO_TRY(write_manifest(store_, {subject, enrolments.back(), now}, folder.path(), "manifest.json"));
    RELIEVO_TRY_ASSIGN(Sums written, keep_folder(folder, target, media_, &work_, done, share));
    made_.emplace_back(target, std::move(written));
    return {};
  }

  Result<void> let_go() {
    RELIEVO_TRY(work_.reach(ExportStep::LetGo, kWritten));
    std::error_code error;
    // Another stick may have come in the place of the first.
    for (const auto& [record, sums] : made_)
      if (!fs::exists(record / "record.txt", error)) return pulled_too_early();
    RELIEVO_TRY(media_.flush_and_eject());
    return compare_again();
  }

 private:
  // Now nothing but the stick can answer. It is read only, and is let go whatever comes of it.
  Result<void> compare_again() {
    ExportTrace& trace = work_.trace;
    trace.step = ExportStep::Again;
    RELIEVO_TRY(media_.take_up_again());
    trace.whole = 0;
    float compared = 0;
    Result<void> same;
    for (const auto& [record, sums] : made_) {
      ++compared;
      work_.control.progress.done.store(kWritten + (1 - kWritten) * compared / float(made_.size() + 1));
      const Result<Sums> kept = sums_of(record);
      if (kept && *kept == sums) ++trace.whole;
      else if (same) same = kept ? not_as_written(record) : kept.error();
    }
    if (!media_.current()) return pulled_too_early();
    if (same) trace.step = ExportStep::LetGo;
    const Result<void> gone = media_.flush_and_eject();
    RELIEVO_TRY(same);
    return gone;
  }

  storage::Store& store_;
  const hal::Clock& clock_;
  hal::RemovableMedia& media_;
  FurtherModels further_;
  StickWork work_;
  std::vector<std::pair<fs::path, Sums>> made_;
};

}  // namespace

Result<void> export_records(storage::Store& store, const hal::Clock& clock, hal::RemovableMedia& media,
                            const std::vector<storage::SubjectId>& subjects, const FurtherModels& further,
                            JobControl& control, ExportTrace& trace) {
  trace = {.asked = int(subjects.size())};
  RELIEVO_TRY_ASSIGN(const fs::path stick, plugged_in(media));
  trace.step = ExportStep::Write;
  RELIEVO_TRY_ASSIGN(const fs::path ours, place_on_stick(stick, "relievo"));
  tidy_folder(ours, is_receipt);
  Export work(store, clock, media, further, control, trace);
  const float share = kWritten / float(std::max<std::size_t>(1, subjects.size()));
  for (const storage::SubjectId id : subjects) {
    const Result<void> written = work.one(id, stick, float(trace.whole) * share, share);
    // Whatever failed: a stick that is gone is the reason.
    if (!media.current()) return pulled_too_early();
    RELIEVO_TRY(written);
    ++trace.whole;
  }
  return work.let_go();
}

ui::Outcome outcome_of_export(const Error& error, const ExportTrace& trace) {
  const int number = error.sys_errno;
  const bool not_allowed = number == EROFS || number == EACCES || number == EPERM;
  const bool gone = number == ENOENT || number == ENODEV || number == ENXIO || number == ESTALE ||
                    error.code == Errc::MediaMissing;
  const bool of_the_stick =
      error.code == Errc::IoFailed || error.code == Errc::NotFound || error.code == Errc::MediaMissing;
  if (trace.step == ExportStep::Again && error.code == Errc::Unsupported) return ui::Outcome::StickUnchecked;
  if (trace.step >= ExportStep::Write && of_the_stick) {
    if (gone) return ui::Outcome::StickGone;
    if (trace.step == ExportStep::LetGo && (not_allowed || number == EBUSY)) return ui::Outcome::StickHeld;
    if (trace.step == ExportStep::Write && not_allowed) return ui::Outcome::StickLocked;
    if (trace.step != ExportStep::Write || number == EIO || number == ELOOP) return ui::Outcome::StickBad;
  }
  return outcome_of(error);
}

}  // namespace relievo::firmware
