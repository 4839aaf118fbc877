// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <string>

#include "firmware/base/output_folder.h"
#include "firmware/calibrate/calibrate_command.h"
#include "firmware/calibrate/calibration_history.h"
#include "firmware/calibrate/print_pattern.h"
#include "firmware/command/commands.h"
#include "hal/base/whole_file.h"
#include "pipeline/calibrate/file/calibration_file.h"

namespace relievo::firmware {
namespace {

Result<void> list(const CalibrationArgs& args, Services& services) {
  RELIEVO_TRY_ASSIGN(const auto store, services.open_store(store_folder(args.store), false));
  RELIEVO_TRY_ASSIGN(const auto all, store->calibrations());
  if (all.empty()) services.console.say("no calibration is in the store: 'relievo calibrate' makes one");
  else services.console.say(history_heading());
  for (auto one = all.rbegin(); one != all.rend(); ++one) services.console.say(line_of(*one));
  if (!all.empty() && std::ranges::none_of(all, [](const auto& one) { return one.active; }))
    services.console.say("none is in use: 'relievo calibration activate NO' takes one");
  return {};
}

Result<void> activate(const CalibrationArgs& args, Services& services) {
  RELIEVO_TRY_ASSIGN(const auto store, open_kept_store(store_folder(args.store), services));
  RELIEVO_TRY(store->activate_calibration(std::uint32_t(args.revision)));
  services.console.say("revision " + std::to_string(args.revision) + ", in use from now on");
  return {};
}

Result<void> import_one(const CalibrationArgs& args, Services& services) {
  // The file first: a wrong one leaves the store unopened.
  RELIEVO_TRY_ASSIGN(
      const auto calibration,
      pipeline::read_calibration(args.file, {args.width_px, args.height_px, args.unit_mm}, args.other));
  RELIEVO_TRY_ASSIGN(const auto store, services.open_store(store_folder(args.store), true));
  const std::string note = args.note.empty() ? "imported from " + args.file.filename().string() : args.note;
  RELIEVO_TRY_ASSIGN(const auto revision, store->save_calibration(calibration, note));
  // Echoed, so that whoever imported it sees what the appliance will measure with.
  services.console.say(pipeline::calibration_text(calibration));
  services.console.say("revision " + std::to_string(revision) + ", in use from now on");
  return {};
}

Result<pipeline::StereoCalibration> chosen(const CalibrationArgs& args, Services& services) {
  if (!args.source.empty()) return pipeline::read_calibration(args.source);
  RELIEVO_TRY_ASSIGN(const auto store, services.open_store(store_folder(args.store), false));
  if (args.revision == 0) return store->active_calibration();
  return store->calibration(std::uint32_t(args.revision));
}

Result<void> export_one(const CalibrationArgs& args, Services& services) {
  RELIEVO_TRY_ASSIGN(const auto calibration, chosen(args, services));
  if (!args.ros) return pipeline::write_calibration(args.file, calibration);
  RELIEVO_TRY_ASSIGN(const auto texts, pipeline::camera_info_texts(calibration));
  RELIEVO_TRY_ASSIGN(OutputFolder folder, OutputFolder::begin(args.file));
  RELIEVO_TRY(write_text(folder.path() / "left.yaml", texts.left, args.file));
  RELIEVO_TRY(write_text(folder.path() / "right.yaml", texts.right, args.file));
  return folder.commit();
}

}  // namespace

Result<void> run(const CalibrationArgs& args, Services& services) {
  switch (args.verb) {
    case CalibrationArgs::Verb::List: return list(args, services);
    case CalibrationArgs::Verb::Activate: return activate(args, services);
    case CalibrationArgs::Verb::Import: return import_one(args, services);
    case CalibrationArgs::Verb::Export: return export_one(args, services);
    case CalibrationArgs::Verb::Show: break;
  }
  RELIEVO_TRY_ASSIGN(const auto calibration, chosen(args, services));
  services.console.say(pipeline::calibration_text(calibration));
  return {};
}

Result<void> run(const PrintPatternArgs& args, Services& services) {
  RELIEVO_TRY_ASSIGN(const PageFormat format, page_format(args.output.filename().native()));
  const pipeline::BoardPattern pattern = pattern_of(args.board);
  RELIEVO_TRY_ASSIGN(const PatternPage page, lay_out_pattern(pattern));
  RELIEVO_TRY_ASSIGN(const auto bytes, draw_page(page, pattern, format));
  RELIEVO_TRY(write_whole_file(args.output, bytes));
  const bool upright = page.height_mm > page.width_mm;
  services.console.say(args.output.string() + ": one page " + page.paper +
                       (upright ? " portrait" : " landscape") + "; print it at 100 % and measure its ruler");
  return {};
}

}  // namespace relievo::firmware
