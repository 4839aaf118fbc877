// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/service/export_records.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <memory_resource>
#include <string>
#include <system_error>
#include <utility>

#include "firmware/base/boot_memory.h"
#include "firmware/base/budget.h"
#include "firmware/base/version.h"
#include "firmware/base/wall_time.h"
#include "firmware/jobs/job_thread.h"
#include "firmware/records/receipt.h"
#include "firmware/service/page_controller.h"
#include "hal/base/arena.h"
#include "hal/base/thread_pool.h"
#include "hal/base/words.h"
#include "pipeline/algorithms.h"
#include "pipeline/mesh/completion/solid_head.h"
#include "pipeline/mesh/detail/level_of_detail.h"
#include "pipeline/recognition/recognition_images.h"
#include "storage/export/model_files.h"

namespace relievo::firmware {
namespace {

namespace fs = std::filesystem;

constexpr const char* kBefore = ".before";

fs::path before(const fs::path& target) {
  return target.parent_path() / ("." + target.filename().string() + kBefore);
}

// The name in ".NAME.part123" or ".NAME.before"; empty in any other.
std::string name_in(const std::string& entry) {
  const std::size_t end =
      entry.ends_with(kBefore) ? entry.size() - std::string_view(kBefore).size() : entry.rfind(".part");
  return entry.starts_with('.') && end != std::string::npos && end > 1 ? entry.substr(1, end - 1)
                                                                       : std::string();
}

Result<void> replace_folder(OutputFolder& made, const fs::path& target) {
  std::error_code error;
  const bool replaces = fs::exists(target, error);
  if (replaces) {
    fs::rename(target, before(target), error);
    if (error)
      return Error{Errc::IoFailed, "the folder of an earlier export cannot be replaced: use another stick",
                   error.value()}
          .at(target.native());
  }
  if (const Result<void> done = made.commit(); !done) {
    if (replaces) fs::rename(before(target), target, error);
    return done;
  }
  fs::remove_all(before(target), error);
  return {};
}

std::string note_of(const storage::Subject& subject, const storage::Enrolment& newest) {
  return "code: " + receipt_of(subject) + "\nname: " + subject.name +
         "\nkept since: " + text_of(subject.created_at) +
         "\nportraits: " + std::to_string(subject.enrolments) + "\nthis one: " + text_of(newest.created_at) +
         "\nconsent: " + newest.consent.wording + " (" + newest.consent.language + ") " +
         text_of(newest.consent.given_at) + "\n";
}

constexpr float kWritten = 0.85F;  // of the progress: what follows is compared once more

// One export: the errors of its steps, and its progress.
struct Export {
  storage::Store& store;
  const hal::Clock& clock;
  hal::RemovableMedia& media;
  const FurtherModels& further;
  StickWork work;
  std::vector<std::pair<fs::path, Sums>> made{};

  Result<void> one(storage::SubjectId id, const fs::path& root, float done, float share) {
    RELIEVO_TRY(work.reach(ExportStep::Load, done));
    RELIEVO_TRY_ASSIGN(const storage::Subject subject, store.subject(id));
    RELIEVO_TRY_ASSIGN(const auto enrolments, store.enrolments(id));
    if (enrolments.empty()) return Error{Errc::NotFound, "has no portrait"};
    std::pmr::monotonic_buffer_resource memory;
    RELIEVO_TRY_ASSIGN(const pipeline::FaceModel model, store.load_model(enrolments.back().id, &memory));
    const auto images = pipeline::make_recognition_images(model, memory, memory);
    if (!images && images.error().code == Errc::OutOfMemory) return images.error();
    RELIEVO_TRY(work.reach(ExportStep::Write, done + 0.15F * share));
    RELIEVO_TRY_ASSIGN(const fs::path target,
                       place_on_stick(root, fs::path("relievo") / receipt_of(subject)));
    RELIEVO_TRY_ASSIGN(OutputFolder folder, OutputFolder::begin(target));
    storage::ExportOptions options(storage::ExportFrame::Head);
    options.version = kVersion;
    if (images) options.images = &*images;  // without a surface there are none
    RELIEVO_TRY(storage::write_model_files(model, folder.path(), options));
    RELIEVO_TRY(work.reach(ExportStep::Write, done + 0.35F * share));
    RELIEVO_TRY_ASSIGN(const auto lines, write_further_models(model, further, folder.path(), options.frame,
                                                              target, work.control.cancelled));
    std::string note = note_of(subject, enrolments.back());
    for (const std::string& line : lines) note += line + "\n";  // of a solid also why there is none
    RELIEVO_TRY(write_text(folder.path() / "record.txt", note, "record.txt"));
    if (!enrolments.back().report_json.empty())
      RELIEVO_TRY(write_text(folder.path() / "report.json", enrolments.back().report_json, "report.json"));
    const auto now = std::chrono::time_point_cast<std::chrono::milliseconds>(clock.wall_now());
    RELIEVO_TRY(write_manifest(store, {subject, enrolments.back(), now}, folder.path(), "manifest.json"));
    RELIEVO_TRY(work.reach(ExportStep::Note, done + 0.5F * share));
    RELIEVO_TRY(log_export(store, {subject, enrolments.back(), now}));
    RELIEVO_TRY_ASSIGN(Sums written, keep_folder(folder, target, media, &work, done, share));
    made.emplace_back(target, std::move(written));
    return {};
  }

  Result<void> let_go() {
    RELIEVO_TRY(work.reach(ExportStep::LetGo, kWritten));
    std::error_code error;
    // Another stick may have come in the place of the first.
    for (const auto& [record, sums] : made)
      if (!fs::exists(record / "record.txt", error)) return pulled_too_early();
    RELIEVO_TRY(media.flush_and_eject());
    return compare_again();
  }

  // Now nothing but the stick can answer. It is read only, and is let go whatever comes of it.
  Result<void> compare_again() {
    ExportTrace& trace = work.trace;
    trace.step = ExportStep::Again;
    RELIEVO_TRY(media.take_up_again());
    trace.whole = 0;
    float compared = 0;
    Result<void> same;
    for (const auto& [record, sums] : made) {
      ++compared;
      work.control.progress.done.store(kWritten + (1 - kWritten) * compared / float(made.size() + 1));
      const Result<Sums> kept = sums_of(record);
      if (kept && *kept == sums) ++trace.whole;
      else if (same) same = kept ? not_as_written(record) : kept.error();
    }
    if (!media.current()) return pulled_too_early();
    if (same) trace.step = ExportStep::LetGo;
    const Result<void> gone = media.flush_and_eject();
    RELIEVO_TRY(same);
    return gone;
  }
};

}  // namespace

Result<fs::path> place_on_stick(const fs::path& root, const fs::path& place) {
  fs::path way = root;
  std::error_code error;
  for (const fs::path& step : place) {
    way /= step;
    if (fs::is_symlink(fs::symlink_status(way, error)))
      return Error{Errc::IoFailed, "is a link on the stick, which may lead anywhere: use another stick",
                   ELOOP}
          .at(step.native());
  }
  return way;
}

Result<void> StickWork::reach(ExportStep step, float share) {
  // What has its name stays: its stick is let go, whoever stops it now.
  if (step < ExportStep::LetGo && control.cancelled.load())
    return Error{Errc::Cancelled, "nothing was stored"};
  trace.step = step;
  control.progress.done.store(share);
  return {};
}

Result<Sums> keep_folder(OutputFolder& made, const fs::path& target, hal::RemovableMedia& media,
                         StickWork* work, float done, float share) {
  RELIEVO_TRY_ASSIGN(Sums written, sums_of(made.path()));
  if (work != nullptr) RELIEVO_TRY(work->reach(ExportStep::ReadBack, done + 0.6F * share));
  RELIEVO_TRY(media.settle(made.path()));
  if (work != nullptr) RELIEVO_TRY(work->reach(ExportStep::ReadBack, done + 0.8F * share));
  RELIEVO_TRY_ASSIGN(const Sums read, sums_of(made.path()));
  if (read != written) return not_as_written(target);
  RELIEVO_TRY(plugged_in(media));  // else it all lies in the empty place, on the device
  if (work != nullptr) RELIEVO_TRY(work->reach(ExportStep::Write, done + 0.9F * share));
  RELIEVO_TRY(replace_folder(made, target));
  return written;
}

Result<void> put_on_stick(hal::RemovableMedia& media, const fs::path& place, StickWork* work,
                          const std::function<Result<void>(const fs::path& target)>& write) {
  RELIEVO_TRY_ASSIGN(const fs::path stick, plugged_in(media));
  RELIEVO_TRY_ASSIGN(const fs::path target, place_on_stick(stick, place));
  tidy_folder(target.parent_path());
  const Result<void> written = write(target);
  // Whatever failed: a stick that is gone is the reason.
  std::error_code error;
  if (!media.current() || (written && !fs::exists(target, error))) return pulled_too_early();
  RELIEVO_TRY(written);
  if (work != nullptr) RELIEVO_TRY(work->reach(ExportStep::LetGo, 1));
  return media.flush_and_eject();
}

Result<fs::path> plugged_in(hal::RemovableMedia& media) {
  if (auto stick = media.current()) return *std::move(stick);
  return Error{Errc::MediaMissing, "there is no stick: plug one in"};
}

Error pulled_too_early() {
  return {Errc::Disconnected, "the stick was pulled out too early: plug it in and try again"};
}

Error not_as_written(const fs::path& file) {
  return Error{Errc::IoFailed, "what was read back from the stick is not what was written: use another stick"}
      .at(file.filename().string());
}

void tidy_folder(const fs::path& folder, bool (*ours)(std::string_view name)) {
  std::error_code error;
  std::vector<fs::path> left;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = name_in(entry->path().filename().string());
    if (!name.empty() && ours(name)) left.push_back(entry->path());
  }
  for (const fs::path& one : left) {
    const fs::path target = folder / name_in(one.filename().string());
    if (one.filename().string().ends_with(kBefore) && !fs::exists(target, error))
      fs::rename(one, target, error);
    else fs::remove_all(one, error);
  }
}

Result<void> export_records(storage::Store& store, const hal::Clock& clock, hal::RemovableMedia& media,
                            const std::vector<storage::SubjectId>& subjects, const FurtherModels& further,
                            JobControl& control, ExportTrace& trace) {
  trace = {};
  trace.asked = int(subjects.size());
  RELIEVO_TRY_ASSIGN(const fs::path stick, plugged_in(media));
  trace.step = ExportStep::Write;
  RELIEVO_TRY_ASSIGN(const fs::path ours, place_on_stick(stick, "relievo"));
  tidy_folder(ours, is_receipt);
  Export all{store, clock, media, further, {control, trace}};
  const float share = kWritten / float(std::max<std::size_t>(1, subjects.size()));
  float done = 0;
  for (const storage::SubjectId id : subjects) {
    const Result<void> written = all.one(id, stick, done, share);
    done += share;
    // Whatever failed: a stick that is gone is the reason.
    if (!media.current()) return pulled_too_early();
    if (!written && trace.step == ExportStep::Load &&
        (written.error().code == Errc::NotFound || written.error().code == Errc::StoreCorrupt)) {
      trace.left_out = written.error();
      continue;  // the others are written all the same
    }
    RELIEVO_TRY(written);
    ++trace.whole;
  }
  if (trace.left_out && trace.whole == 0) return *trace.left_out;
  RELIEVO_TRY(all.let_go());
  if (!trace.left_out) return {};
  trace.step = ExportStep::Find;  // no fault of the stick's
  return *trace.left_out;
}

ui::Outcome outcome_of_export(const Error& error, const ExportTrace& trace) {
  const int number = error.sys_errno;
  const bool not_allowed = number == EROFS || number == EACCES || number == EPERM;
  const bool gone = number == ENOENT || number == ENODEV || number == ENXIO || number == ESTALE ||
                    error.code == Errc::MediaMissing;
  const bool of_the_stick =
      error.code == Errc::IoFailed || error.code == Errc::NotFound || error.code == Errc::MediaMissing;
  // All but who is left out is there. How the stick was let go would not tell of them; the log tells both.
  const bool written = trace.step == ExportStep::Find || trace.step >= ExportStep::LetGo;
  if (trace.left_out && trace.whole > 0 && written && !gone) return ui::Outcome::Failed;
  if (trace.step == ExportStep::Again && error.code == Errc::Unsupported) return ui::Outcome::StickUnchecked;
  if (trace.step == ExportStep::Note) return ui::Outcome::Failed;  // the store's, not the stick's
  if (trace.step >= ExportStep::Write && of_the_stick) {
    if (gone) return ui::Outcome::StickGone;
    if (trace.step == ExportStep::LetGo && (not_allowed || number == EBUSY)) return ui::Outcome::StickHeld;
    if (trace.step == ExportStep::Write && not_allowed) return ui::Outcome::StickLocked;
    if (trace.step != ExportStep::Write || number == EIO || number == ELOOP) return ui::Outcome::StickBad;
  }
  return outcome_of(error);
}

namespace {

Result<void> write_files(const pipeline::FaceModel& model, std::string_view stem,
                         const std::filesystem::path& folder, storage::ExportFrame frame,
                         const std::filesystem::path& place) {
  storage::ExportOptions options(frame);
  options.version = kVersion;
  options.stem = stem;
  RELIEVO_TRY(storage::write_model_files(model, folder, options).at(place.string()));
  return {};
}

Result<std::string> write_light(const pipeline::FaceModel& model, int triangles,
                                const std::filesystem::path& folder, storage::ExportFrame frame,
                                const std::filesystem::path& place) {
  std::pmr::monotonic_buffer_resource memory;
  pipeline::DetailOptions options;
  options.triangles = triangles;
  RELIEVO_TRY_ASSIGN(const pipeline::LighterModel light, pipeline::lighten(model, options, &memory));
  RELIEVO_TRY(write_files(light.model, "light", folder, frame, place));
  std::error_code unknown;
  const auto glb_bytes = std::filesystem::file_size(folder / "light.glb", unknown);
  return printed("light: %zu triangles, %ju bytes as GLB, off the model by %.3f mm rms, %.3f mm at most",
                 light.model.mesh.triangles.size(), static_cast<std::uintmax_t>(glb_bytes),
                 light.rms_error_mm, light.max_error_mm);
}

Result<std::string> write_solid(const pipeline::FaceModel& model, const std::filesystem::path& folder,
                                storage::ExportFrame frame, const std::filesystem::path& place,
                                const std::atomic<bool>& cancelled) {
  // Of its own, since a visit's may still be on the page. The kernel clears what is given back.
  const BootMemory memory(0, budget::kSolidProductBytes, budget::kSolidScratchBytes);
  Arena output(memory.output()), scratch(memory.scratch());
  ThreadPool pool(pool_size());
  pipeline::Progress progress;
  pipeline::StageContext context{output, scratch, pool, progress, cancelled};
  pipeline::AlgorithmSet set;
  RELIEVO_TRY(set.set("completion", "generic-head"));
  RELIEVO_TRY_ASSIGN(const auto algorithms, pipeline::make_algorithms(set));
  auto mesh = pipeline::make_solid(model, algorithms.completion, context);
  // The model is no worse for it.
  if (!mesh && (mesh.error().code == Errc::PoorGeometry || mesh.error().code == Errc::OutOfMemory))
    return "no solid: " + std::string(mesh.error().what.view());
  if (!mesh) return mesh.error().at(place.string());
  pipeline::FaceModel solid(&output);
  solid.mesh = *std::move(mesh);
  solid.landmarks = model.landmarks;
  solid.head_from_camera = model.head_from_camera;
  const std::size_t triangles = solid.mesh.triangles.size();
  RELIEVO_TRY(write_files(solid, "solid", folder, frame, place));
  return "solid: " + std::to_string(triangles) + " triangles, closed, cut flat at the neck";
}

}  // namespace

Result<std::vector<std::string>> write_further_models(
    const pipeline::FaceModel& model, const FurtherModels& wanted, const std::filesystem::path& folder,
    storage::ExportFrame frame, const std::filesystem::path& place, const std::atomic<bool>& cancelled) {
  std::vector<std::string> lines;
  if (wanted.lod > 0) {
    RELIEVO_TRY_ASSIGN(std::string line, write_light(model, wanted.lod, folder, frame, place));
    lines.push_back(std::move(line));
  }
  if (wanted.watertight) {
    RELIEVO_TRY_ASSIGN(std::string line, write_solid(model, folder, frame, place, cancelled));
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace relievo::firmware
