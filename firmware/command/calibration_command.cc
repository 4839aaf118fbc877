// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "firmware/base/output_folder.h"
#include "firmware/base/settings.h"
#include "firmware/base/wall_time.h"
#include "firmware/calibrate/calibrate_command.h"
#include "firmware/command/commands.h"
#include "hal/base/whole_file.h"
#include "pipeline/calibrate/file/calibration_file.h"
#include "storage/store_folder.h"

namespace relievo::firmware {
namespace {

Result<void> list(const CalibrationArgs& args, Services& services) {
  RELIEVO_TRY_ASSIGN(const Path folder, store_folder(args.store));
  RELIEVO_TRY_ASSIGN(const auto store, services.open_store(folder, false));
  RELIEVO_TRY_ASSIGN(const auto all, store->calibrations());
  if (all.empty()) services.console.say("no calibration is in the store: 'relievo calibrate' makes one");
  else services.console.say(history_heading());
  for (auto one = all.rbegin(); one != all.rend(); ++one) services.console.say(line_of(*one));
  if (!all.empty() && std::ranges::none_of(all, [](const auto& one) { return one.active; }))
    services.console.say("none is in use: 'relievo calibration activate NO' takes one");
  return {};
}

Result<void> activate(const CalibrationArgs& args, Services& services) {
  RELIEVO_TRY_ASSIGN(const Path folder, store_folder(args.store));
  RELIEVO_TRY_ASSIGN(const auto store, open_kept_store(folder, services));
  RELIEVO_TRY(store->activate_calibration(std::uint32_t(args.revision)));
  services.console.say("revision " + std::to_string(args.revision) + ", in use from now on");
  return {};
}

Result<void> import_one(const CalibrationArgs& args, Services& services) {
  // The file first: a wrong one leaves the store unopened.
  RELIEVO_TRY_ASSIGN(
      const auto calibration,
      pipeline::read_calibration(args.file, {args.width_px, args.height_px, args.unit_mm}, args.other));
  RELIEVO_TRY_ASSIGN(const Path folder, store_folder(args.store));
  RELIEVO_TRY_ASSIGN(const auto store, services.open_store(folder, true));
  const std::string note = args.note.empty() ? "imported from " + args.file.filename().string() : args.note;
  RELIEVO_TRY_ASSIGN(const auto revision, store->save_calibration(calibration, note));
  // Echoed, so that whoever imported it sees what the appliance will measure with.
  services.console.say(pipeline::calibration_text(calibration));
  services.console.say("revision " + std::to_string(revision) + ", in use from now on");
  return {};
}

Result<pipeline::StereoCalibration> chosen(const CalibrationArgs& args, Services& services) {
  if (!args.source.empty()) return pipeline::read_calibration(args.source);
  RELIEVO_TRY_ASSIGN(const Path folder, store_folder(args.store));
  RELIEVO_TRY_ASSIGN(const auto store, services.open_store(folder, false));
  if (args.revision == 0) return store->active_calibration();
  return store->calibration(std::uint32_t(args.revision));
}

Result<void> export_one(const CalibrationArgs& args, Services& services) {
  if (!args.ros) RELIEVO_TRY(storage::must_lie_outside_stores(args.file));
  RELIEVO_TRY_ASSIGN(const auto calibration, chosen(args, services));
  if (!args.ros) return pipeline::write_calibration(args.file, calibration);
  RELIEVO_TRY_ASSIGN(const auto texts, pipeline::camera_info_texts(calibration));
  (void)interrupted();  // nothing half-written stays behind
  RELIEVO_TRY_ASSIGN(OutputFolder folder, OutputFolder::begin(args.file));
  RELIEVO_TRY(write_text(folder.path() / "left.yaml", texts.left, args.file));
  RELIEVO_TRY(write_text(folder.path() / "right.yaml", texts.right, args.file));
  return folder.commit();
}

// `relievo calibrate`, from a folder and live: with its words on the console, Ctrl-C, and the store.

using Calibrate = std::function<Result<pipeline::CalibratorOutput>(const Tell& tell, const RigToday& today)>;

struct Task {
  const Path& output;
  const Path& store;  // empty: not stored
  std::string from;   // for the words
};

Result<void> calibrate_and_store(const Task& task, Services& services, const Calibrate& calibrate) {
  const std::atomic<bool>& stop = interrupted();  // from here on Ctrl-C is ours
  const Tell tell = [&](const std::string& line) -> Result<void> {
    if (stop.load()) return Error{Errc::Cancelled, "cancelled: nothing was written"}.at(task.output.string());
    services.console.say(line);
    return {};
  };
  try {
    RigToday today;
    today.made_at = text_of(stored_time(services.clock.wall_now()));
    if (!task.store.empty()) {
      RELIEVO_TRY_ASSIGN(today.in_use, known_calibration(task.store, services));
    }
    RELIEVO_TRY_ASSIGN(const auto result, calibrate(tell, today));
    if (task.store.empty()) return {};
    RELIEVO_TRY_ASSIGN(const auto store, services.open_store(task.store, true));
    const Path from = task.from;  // "boards/" has no last name
    const std::string source =
        "calibrated from " + (from.has_filename() ? from : from.parent_path()).filename().string();
    RELIEVO_TRY_ASSIGN(const auto revision,
                       store->save_calibration(result.calibration, source, figures_of(result.quality)));
    services.console.say("stored: calibration " + std::to_string(revision) + ", in use from now on");
    return {};
  } catch (const std::bad_alloc&) {
    return Error{Errc::OutOfMemory,
                 "there is not enough memory for these pictures: use fewer or smaller ones"}
        .at(task.from);
  } catch (const std::exception&) {
    return Error{Errc::LibraryFailed, "a library gave up on these pictures: look for a damaged one"}.at(
        task.from);
  }
}

Result<std::unique_ptr<LivePairs>> open_pairs(const CalibrateLiveArgs& args, Services& services) {
  if (args.cameras == "sim") return services.hold_board(args);
  RELIEVO_TRY_ASSIGN(auto device, services.open_device(args.cameras));
  return make_device_pairs(std::move(device), args.cameras);
}

}  // namespace

Result<std::optional<pipeline::StereoCalibration>> known_calibration(const Path& folder, Services& services) {
  const auto store = services.open_store(folder, false);
  if (!store && store.error().code == Errc::NotFound) return std::optional<pipeline::StereoCalibration>();
  if (!store) return store.error();
  auto active = (*store)->active_calibration();
  if (!active && active.error().code == Errc::NotCalibrated)
    return std::optional<pipeline::StereoCalibration>();
  if (!active) return active.error();
  return std::optional(*active);
}

Result<void> run(const CalibrateArgs& args, Services& services) {
  return calibrate_and_store(
      {args.output, args.store, args.pictures.string()}, services,
      [&](const Tell& tell, const RigToday& today) { return run_calibrate(args, tell, today); });
}

Result<void> run(const CalibrateLiveArgs& args, Services& services) {
  const auto calibrate = [&](const Tell& tell, const RigToday& today) -> Result<pipeline::CalibratorOutput> {
    RELIEVO_TRY(pattern_of(args.board).check());
    RELIEVO_TRY_ASSIGN(const auto pairs, open_pairs(args, services));
    return run_calibrate_live(args, *pairs, tell, today);
  };
  return calibrate_and_store({args.output, args.store, args.cameras}, services, calibrate);
}

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
  RELIEVO_TRY(storage::must_lie_outside_stores(args.output));
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
