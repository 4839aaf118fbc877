// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// `relievo calibrate`, from a folder and live: with its words on the console, Ctrl-C, and the store.
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <streambuf>
#include <string>
#include <utility>

#include "firmware/base/interrupt.h"
#include "firmware/base/wall_time.h"
#include "firmware/calibrate/calibrate_command.h"
#include "firmware/calibrate/calibrate_live.h"
#include "firmware/calibrate/calibration_history.h"
#include "firmware/command/commands.h"

namespace relievo::firmware {
namespace {

struct Stopped : std::runtime_error {
  Stopped() : std::runtime_error("Ctrl-C") {}
};

// Lines go to the console; a line after Ctrl-C does not: the work unwinds and leaves nothing behind.
class ConsoleLines final : public std::streambuf {
 public:
  explicit ConsoleLines(Console& console) : console_(console) {}

 private:
  int overflow(int c) override {
    if (interrupted().load()) throw Stopped();
    if (c == traits_type::eof()) return 0;
    if (c != '\n') {
      line_.push_back(char(c));
      return c;
    }
    console_.say(line_);
    line_.clear();
    return c;
  }
  Console& console_;
  std::string line_;
};

using Calibrate = std::function<Result<pipeline::CalibratorOutput>(std::ostream& out, const RigToday& today)>;

struct Task {
  const Path& output;
  const Path& store;  // empty: not stored
  std::string from;   // for the words
};

Result<void> calibrate_and_store(const Task& task, Services& services, const Calibrate& calibrate) {
  (void)interrupted();  // from here on Ctrl-C is ours
  ConsoleLines lines(services.console);
  std::ostream out(&lines);
  out.exceptions(std::ios::badbit);  // lets Stopped through
  try {
    RigToday today;
    today.made_at = text_of(std::chrono::floor<std::chrono::milliseconds>(services.clock.wall_now()));
    if (!task.store.empty()) {
      RELIEVO_TRY_ASSIGN(today.in_use, known_calibration(task.store, services));
    }
    RELIEVO_TRY_ASSIGN(const auto result, calibrate(out, today));
    if (task.store.empty()) return {};
    RELIEVO_TRY_ASSIGN(const auto store, services.open_store(task.store, true));
    const std::string source = "calibrated from " + Path(task.from).filename().string();
    RELIEVO_TRY_ASSIGN(const auto revision,
                       store->save_calibration(result.calibration, source, figures_of(result.quality)));
    services.console.say("stored: calibration " + std::to_string(revision) + ", in use from now on");
    return {};
  } catch (const Stopped&) {
    return Error{Errc::Cancelled, "cancelled: nothing was written"}.at(task.output.string());
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
      [&](std::ostream& out, const RigToday& today) { return run_calibrate(args, out, today); });
}

Result<void> run(const CalibrateLiveArgs& args, Services& services) {
  const auto calibrate = [&](std::ostream& out, const RigToday& today) -> Result<pipeline::CalibratorOutput> {
    RELIEVO_TRY(pattern_of(args.board).check());
    RELIEVO_TRY_ASSIGN(const auto pairs, open_pairs(args, services));
    return run_calibrate_live(args, *pairs, out, today);
  };
  return calibrate_and_store({args.output, args.store, args.cameras}, services, calibrate);
}

}  // namespace relievo::firmware
