// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>
#include <vector>

#include "firmware/base/output_folder.h"
#include "firmware/base/version.h"
#include "firmware/command/commands.h"
#include "firmware/reconstruct/reconstruction.h"
#include "firmware/service/export_records.h"
#include "hal/base/words.h"
#include "hal/recording/capture_file.h"
#include "storage/export/model_files.h"
#include "storage/store_folder.h"

namespace relievo::firmware {
namespace {

// Model, pictures and report, and what is to be saved, all or nothing. A document that is there says that the
// folder is, too.
Result<std::vector<std::string>> write_results(const ReconstructArgs& args, Reconstruction& made) {
  RELIEVO_TRY_ASSIGN(OutputFolder folder, OutputFolder::begin(args.output));
  RELIEVO_TRY_ASSIGN(const auto images, made.draw_images());
  storage::ExportOptions options(args.camera_frame ? storage::ExportFrame::Camera
                                                   : storage::ExportFrame::Head);
  options.version = kVersion;
  options.images = &images;
  RELIEVO_TRY(storage::write_model_files(made.model(), folder.path(), options).at(args.output.string()));
  RELIEVO_TRY_ASSIGN(const std::vector<std::string> further,
                     write_further_models(made.model(), args.further, folder.path(), options.frame,
                                          args.output, interrupted()));
  RELIEVO_TRY(write_text(folder.path() / "report.json", report_json(made.report()), args.output));
  if (args.save.empty()) RELIEVO_TRY(folder.commit());
  else RELIEVO_TRY(made.save(args.save, [&folder] { return folder.commit(); }));
  return further;
}

void say_of_work(const Reconstruction& made, Console& console) {
  const Report& report = made.report();
  int number = int(State::Match);
  if (report.poses.empty())
    for (const StageRecord& stage : report.stages)
      console.say(line_of(stage) + (number++ < int(made.begun_with()) ? "  (as saved)" : ""));
  for (std::size_t k = 1; k < report.poses.size(); ++k) console.say(line_of(k + 1, report.poses[k]));
  if (report.by_hand > 0) console.say(std::to_string(report.by_hand) + " of the matches made by hand");
  console.say(line_of(*report.drift));
  for (const std::string& advice : {line_of_motion(report.motion_px.value_or(0)),
                                    line_of_light(report.white.value_or(pipeline::Overexposure{}))})
    if (!advice.empty()) console.say(advice);
}

void say_of_model(const pipeline::FaceModel& model, const std::vector<std::string>& further,
                  const Path& output, Console& console) {
  const pipeline::ModelQuality& q = model.quality;
  console.say(printed("%.0f x %.0f mm, nose %.1f mm before the cheeks, sigma %.3f mm", q.width_mm,
                      q.height_mm, q.nose_relief_mm, q.median_sigma_mm));
  if (model.unjudged) console.say("not judged to be a face: " + detail_of(*model.unjudged));
  for (const std::string& one : further) console.say(one);
  console.say("model and report: " + output.string());
}

Result<void> reconstruct_recording(const ReconstructArgs& args, Services& services) {
  ReconstructArgs named = args;
  RELIEVO_TRY_ASSIGN(named.pictures, hal::recorded_pictures(args.pictures[0]));
  if (named.pictures.size() > 2 * pipeline::kMostPoses)
    return invalid("seven pairs make a head; these are more").at(args.pictures[0].string());
  if (named.pictures.size() > 2 &&
      (!args.save.empty() || !args.by_hand.empty() || args.algorithms.whole_view))
    return invalid("holds a head from several pairs: --save, --by-hand and --region are of one pair alone")
        .at(args.pictures[0].string());
  return run(named, services);
}

}  // namespace

Result<void> run(const ReconstructArgs& args, Services& services) {
  if (args.pictures.size() == 1) return reconstruct_recording(args, services);
  if (!args.save.empty()) RELIEVO_TRY(storage::must_lie_outside_stores(args.save));
  Reconstruction made;
  RELIEVO_TRY(args.load.empty() ? made.run(args, services.console) : made.load(args, services.console));
  RELIEVO_TRY_ASSIGN(const std::vector<std::string> further, write_results(args, made));
  say_of_work(made, services.console);
  say_of_model(made.model(), further, args.output, services.console);
  if (!args.save.empty()) services.console.say("saved, with the person's face: " + args.save.string());
  return {};
}

}  // namespace relievo::firmware
