// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// relievo calibrate as a command: run_calibrate() with its words on the console, Ctrl-C, and the store.
#include <chrono>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <streambuf>
#include <string>

#include "firmware/command/calibrate_command.h"
#include "firmware/command/calibration_history.h"
#include "firmware/command/commands.h"
#include "firmware/command/interrupt.h"
#include "firmware/command/wall_time.h"

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
      line_.push_back(static_cast<char>(c));
      return c;
    }
    console_.say(line_);
    line_.clear();
    return c;
  }
  Console& console_;
  std::string line_;
};

// Of a store that is not there yet, or holds no calibration, nothing is known.
Result<std::optional<pipeline::StereoCalibration>> in_use(const Path& folder, Services& services) {
  const auto store = services.open_store(folder, false);
  if (!store && store.error().code == Errc::NotFound) return std::optional<pipeline::StereoCalibration>();
  if (!store) return store.error();
  auto active = (*store)->active_calibration();
  if (!active && active.error().code == Errc::NotCalibrated) return std::optional<pipeline::StereoCalibration>();
  if (!active) return active.error();
  return std::optional(*std::move(active));
}

}  // namespace

Result<void> run_calibrate_and_store(const CalibrateArgs& args, Services& services) {
  (void)interrupted();  // from here on Ctrl-C is ours
  ConsoleLines lines(services.console);
  std::ostream out(&lines);
  out.exceptions(std::ios::badbit);  // lets Stopped through
  try {
    RigToday today;
    today.made_at = text_of(std::chrono::floor<std::chrono::milliseconds>(services.clock.wall_now()));
    if (!args.store.empty()) {
      RELIEVO_TRY_ASSIGN(today.in_use, in_use(args.store, services));
    }
    RELIEVO_TRY_ASSIGN(const auto result, run_calibrate(args, out, today));
    if (args.store.empty()) return {};
    RELIEVO_TRY_ASSIGN(const auto store, services.open_store(args.store, true));
    RELIEVO_TRY_ASSIGN(const auto revision,
                       store->save_calibration(result.calibration, "calibrated from " + args.pictures.filename().string(),
                                               figures_of(result.quality)));
    services.console.say("stored: calibration " + std::to_string(revision) + ", in use from now on");
    return {};
  } catch (const Stopped&) {
    return Error{Errc::Cancelled, "cancelled: nothing was written"}.at(args.output.string());
  } catch (const std::bad_alloc&) {
    return Error{Errc::OutOfMemory, "there is not enough memory for these pictures: use fewer or smaller ones"}.at(args.pictures.string());
  } catch (const std::exception&) {
    return Error{Errc::LibraryFailed, "a library gave up on these pictures: look for a damaged one"}.at(args.pictures.string());
  }
}

}  // namespace relievo::firmware
