// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>
#include <span>

#include "firmware/boot_memory.h"
#include "firmware/command/algorithm_choice.h"
#include "firmware/command/commands.h"
#include "firmware/command/output_folder.h"
#include "firmware/command/picture_pair.h"
#include "firmware/command/report.h"
#include "firmware/command/watched_job.h"
#include "firmware/work/pipeline_stages.h"
#include "firmware/work/pool_size.h"
#include "firmware/work/reconstruct_job.h"
#include "hal/monotonic_clock.h"
#include "hal/whole_file.h"
#include "pipeline/calibrate/calibration_file.h"
#include "storage/export/model_files.h"

namespace relievo::firmware {
namespace {

void tell(const Report& report, Console& console) {
  for (const StageRecord& stage : report.stages) console.say(line_of(stage));
  char line[160];
  const pipeline::ModelQuality& q = report.quality;
  std::snprintf(line, sizeof line, "%.0f x %.0f mm, nose %.1f mm before the cheeks, sigma %.3f mm", q.width_mm,
                q.height_mm, q.nose_relief_mm, q.median_sigma_mm);
  console.say(line);
}

// Whose error it is: a stage does not know the names of the files it works on.
Error of_pair(const Error& error, const ReconstructArgs& args) {
  return error.where().empty() ? error.at(args.left.string()) : error;
}

Result<void> write_results(const ReconstructArgs& args, const pipeline::FaceModel& model, const Report& report) {
  RELIEVO_TRY_ASSIGN(OutputFolder folder, OutputFolder::begin(args.output));
  const auto frame = args.camera_frame ? storage::ExportFrame::Camera : storage::ExportFrame::Head;
  if (const auto files = storage::write_model_files(model, folder.path(), frame); !files) {
    return files.error().at(args.output.string());
  }
  const std::string json = report_json(report);
  if (const auto written = hal::write_whole_file(folder.path() / "report.json", std::as_bytes(std::span(json))); !written) {
    return written.error().at(args.output.string());
  }
  return folder.commit();
}

}  // namespace

Result<void> run_reconstruct(const ReconstructArgs& args, Services& services) {
  RELIEVO_TRY_ASSIGN(const auto calibration, pipeline::read_calibration(args.calibration));
  RELIEVO_TRY_ASSIGN(const PicturePair pictures, read_pair(args.left, args.right, calibration));
  RELIEVO_TRY_ASSIGN(auto pipeline, make_pipeline(args.algorithms, calibration));

  const BootMemory memory(0, budget::kOutputArenaBytes, budget::kScratchArenaBytes);
  EnrolmentSession session(memory);
  ThreadPool pool(pool_size());
  const hal::MonotonicClock clock;
  PipelineStages stages(std::move(pipeline));
  ReconstructJob job(stages, session, pool, clock);
  RELIEVO_TRY(session.open(""));
  session.products().frame = pictures.frame();
  if (const auto done = run_watched(job, services.console, [&job] { return name_of(job.stage()); }); !done) {
    return of_pair(done.error(), args);
  }
  const pipeline::FaceModel& model = *session.products().model;
  const Report report{args.calibration.string(), stages.pipeline().algorithms().to_text(), job.records(), job.took(),
                      peak_rss_bytes(), model.quality};
  RELIEVO_TRY(write_results(args, model, report));
  tell(report, services.console);
  services.console.say("model and report: " + args.output.string());
  return {};
}

}  // namespace relievo::firmware
