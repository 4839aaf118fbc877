// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>
#include <string>

#include "firmware/base/output_folder.h"
#include "firmware/base/version.h"
#include "firmware/command/commands.h"
#include "firmware/command/light_model.h"
#include "firmware/reconstruct/reconstruction.h"
#include "hal/base/sentence.h"
#include "storage/export/model_files.h"

namespace relievo::firmware {

Result<void> run_reconstruct(const ReconstructArgs& args, Services& services) {
  Reconstruction reconstruction;
  const WhenMoved when_moved = args.despite_drift ? WhenMoved::GoOn : WhenMoved::Refuse;
  RELIEVO_TRY(args.load.empty()
                  ? reconstruction.run(args.left, args.right, args.calibration, args.algorithms,
                                       services.console, when_moved)
                  : reconstruction.load(args.load, args.from, args.algorithms, services.console, when_moved));

  RELIEVO_TRY_ASSIGN(OutputFolder folder, OutputFolder::begin(args.output));
  RELIEVO_TRY_ASSIGN(const auto images, reconstruction.draw_images());
  storage::ExportOptions options(args.camera_frame ? storage::ExportFrame::Camera
                                                   : storage::ExportFrame::Head);
  options.version = kVersion;
  options.images = &images;
  if (const auto files = storage::write_model_files(reconstruction.model(), folder.path(), options); !files) {
    return files.error().at(args.output.string());
  }
  std::string light;
  if (args.lod > 0) {
    RELIEVO_TRY_ASSIGN(light, write_light_model(reconstruction.model(), args.lod, folder.path(),
                                                options.frame, args.output));
  }
  RELIEVO_TRY(write_text(folder.path() / "report.json", report_json(reconstruction.report()), args.output));
  if (!args.save.empty()) RELIEVO_TRY(reconstruction.save(args.save));
  RELIEVO_TRY(folder.commit());

  int number = static_cast<int>(State::Match);
  for (const StageRecord& stage : reconstruction.report().stages)
    services.console.say(line_of(stage) +
                         (number++ < static_cast<int>(reconstruction.begun_with()) ? "  (as saved)" : ""));
  services.console.say(line_of(*reconstruction.report().drift));
  for (const std::string& advice :
       {line_of_motion(*reconstruction.report().motion_px), line_of_light(*reconstruction.report().white)})
    if (!advice.empty()) services.console.say(advice);
  const pipeline::ModelQuality& q = reconstruction.report().quality;
  char line[160];
  std::snprintf(line, sizeof line, "%.0f x %.0f mm, nose %.1f mm before the cheeks, sigma %.3f mm",
                q.width_mm, q.height_mm, q.nose_relief_mm, q.median_sigma_mm);
  services.console.say(line);
  if (reconstruction.model().unjudged)
    services.console.say("not judged to be a face: " + Sentence(*reconstruction.model().unjudged).text());
  if (!light.empty()) services.console.say(light);
  services.console.say("model and report: " + args.output.string());
  if (!args.save.empty()) services.console.say("saved, with the person's face: " + args.save.string());
  return {};
}

}  // namespace relievo::firmware
