// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>
#include <string>

#include "firmware/command/commands.h"
#include "firmware/command/wall_time.h"
#include "pipeline/calibrate/file/calibration_file.h"

namespace relievo::firmware {
namespace {

Result<void> list(storage::Store& store, Console& console) {
  RELIEVO_TRY_ASSIGN(const auto all, store.calibrations());
  if (all.empty()) console.say("no calibration is in the store: 'relievo calibrate' makes one");
  for (auto one = all.rbegin(); one != all.rend(); ++one) {
    char line[96];
    std::snprintf(line, sizeof line, "%c %4u  %s  %dx%d  %.3f px  ", one->active ? '*' : ' ', one->revision,
                  text_of(one->created_at).c_str(), one->width_px, one->height_px, one->rms_px);
    console.say(line + one->note);
  }
  return {};
}

Result<pipeline::StereoCalibration> chosen(storage::Store& store, int revision) {
  if (revision == 0) return store.active_calibration();
  return store.calibration(static_cast<std::uint32_t>(revision));
}

}  // namespace

Result<void> run_calibration(const CalibrationArgs& args, Services& services) {
  using Verb = CalibrationArgs::Verb;
  // The file first: a wrong one leaves the store unopened.
  pipeline::StereoCalibration imported;
  if (args.verb == Verb::Import) {
    RELIEVO_TRY_ASSIGN(imported, pipeline::read_calibration(args.file));
  }
  RELIEVO_TRY_ASSIGN(const auto store, services.open_store(store_folder(args.store), args.verb == Verb::Import));
  if (args.verb == Verb::List) return list(*store, services.console);
  if (args.verb == Verb::Import) {
    RELIEVO_TRY_ASSIGN(const auto revision, store->save_calibration(imported, "imported from " + args.file.filename().string()));
    // Echoed, so that whoever imported it sees what the appliance will measure with.
    services.console.say(pipeline::calibration_text(imported));
    services.console.say("revision " + std::to_string(revision) + ", in use from now on");
    return {};
  }
  RELIEVO_TRY_ASSIGN(const auto calibration, chosen(*store, args.revision));
  if (args.verb == Verb::Export) return pipeline::write_calibration(args.file, calibration);
  services.console.say(pipeline::calibration_text(calibration));
  return {};
}

}  // namespace relievo::firmware
