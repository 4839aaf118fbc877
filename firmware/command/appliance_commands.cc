// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// selftest, memory, version: what the appliance says about itself.
#include <algorithm>
#include <new>
#include <optional>
#include <string>
#include <type_traits>

#include "firmware/arguments/algorithm_choice.h"
#include "firmware/base/boot_memory.h"
#include "firmware/base/output_folder.h"
#include "firmware/base/settings.h"
#include "firmware/base/version.h"
#include "firmware/checks/optical_check.h"
#include "firmware/command/commands.h"
#include "firmware/jobs/job_thread.h"
#include "firmware/records/event_log.h"
#include "firmware/service/access.h"
#include "firmware/service/statistics.h"
#include "firmware/service/touch_trial.h"
#include "hal/base/words.h"

namespace relievo::firmware {
namespace {

std::string mib(std::size_t bytes) { return printed("%8.1f MiB", double(bytes) / double(budget::kMiB)); }

void say_plan(Console& console) {
  using Plan = budget::MemoryPlan;
  constexpr std::size_t kCommon = std::size_t{1920} * 1200, kMost = budget::kMostFramePixels;
  constexpr Plan common = budget::plan_of_a_head(kCommon), most = budget::plan_of_a_head(kMost);
  const auto say = [&](const char* what, std::size_t at_common, std::size_t at_most) {
    console.say(printed("%-16s", what) + mib(at_common) + " " + mib(at_most));
  };
  console.say("at                1920 x 1200   2448 x 2048");
  say("pictures", common.frames, most.frames);
  say("stage products", common.products, most.products);
  say("stage scratch", common.scratch, most.scratch);
  say("sides of a head", common.sides + common.follow, most.sides + most.follow);
  say("technician", budget::kTechnicianBytes, budget::kTechnicianBytes);
  say("live pictures", budget::kLiveBytes, budget::kLiveBytes);
  say("heap", budget::kHeapBytes, budget::kHeapBytes);
  say("solid", budget::kSolidBytes, budget::kSolidBytes);
  say("GL driver", budget::kDriverBytes, budget::kDriverBytes);
  say("all of it", budget::appliance_bytes(kCommon), budget::appliance_bytes(kMost));
  say("one pair's face", budget::plan_of_a_face(kCommon).all(), budget::plan_of_a_face(kMost).all());
}

std::string file_name(std::string name) {
  std::ranges::replace(name, ' ', '_');
  return name + ".png";
}

// The report and the pictures are written whatever the verdict: a failure wants to be looked at.
Result<void> run_optical_selftest(const SelfTestArgs& args, Services& services) {
  (void)interrupted();  // from here on Ctrl-C is ours: nothing half-written stays behind
  std::optional<OutputFolder> folder;
  OpticalCheckOptions options;
  options.seed = args.seed;
  options.scale = args.scale;
  if (!args.output.empty()) {
    RELIEVO_TRY_ASSIGN(OutputFolder made, OutputFolder::begin(args.output));
    folder.emplace(std::move(made));
    options.show = [&](const std::string& name, const hal::Picture& picture) {
      return hal::write_picture(folder->path() / file_name(name), picture.view())
          .at((args.output / file_name(name)).string());
    };
  }
  services.console.say("photographing " + std::to_string(options.boards) + " boards, " +
                       std::to_string(options.dumbbells.size()) + " dumbbells and " +
                       std::to_string(options.plates.size()) + " plates: a minute or two");
  OpticalCheck check;
  std::atomic<const char*> at{"Calibrate"};
  FunctionJob job([&](JobControl& control) -> Result<void> {
    RELIEVO_TRY_ASSIGN(check, check_optically(services.photograph, options, at, control));
    return {};
  });
  RELIEVO_TRY(run_watched(job, services.console, [&at] { return at.load(); }));
  for (const std::string& line : acceptance_table(check.report, options, check.calibration.quality))
    services.console.say(line);
  if (folder) {
    RELIEVO_TRY(write_text(folder->path() / "report.json",
                           acceptance_json(check.report, options, check.calibration.quality), args.output));
    RELIEVO_TRY(folder->commit());
    services.console.say("report and pictures: " + args.output.string());
  }
  return check.report.verdict(limits_at(options.scale));
}

// Both logs: the store's, which shows every edit, and the one the technician reads.
Result<void> note(storage::Store& store, const Path& folder, const hal::Clock& clock, const char* event,
                  const char* whose, ui::LogEvent line) {
  RELIEVO_TRY(store.append_audit({event, {}, whose}));
  EventLog log(clock, folder / kLogFile);
  log.say(line);
  return log.save();
}

// A stage that has its own memory says itself when that is used up. This is the machine's.
template <typename Args>
Result<void> run_in_memory_there_is(const Args& args, Services& services) {
  try {
    return run(args, services);
  } catch (const std::bad_alloc&) {
    return Error{Errc::OutOfMemory,
                 "this machine has too little free memory for that: end other programs, or give it more"};
  }
}

}  // namespace

Result<void> run(const VersionArgs&, Services& services) {
  services.console.say("relievo " + std::string(kVersion));
  return {};
}

Result<void> run(const MemoryArgs& args, Services& services) {
  Console& console = services.console;
  say_plan(console);
  if (args.store.empty()) return {};
  RELIEVO_TRY_ASSIGN(const auto store, services.open_store(args.store, false));
  RELIEVO_TRY_ASSIGN(const std::string kept, store->setting(kVisitCostsSetting));
  VisitCosts costs;
  costs.read(kept);
  const ui::VisitCostsView most = costs.view();
  if (most.visits == 0) {
    console.say("no visit of its kiosk has been measured yet");
    return {};
  }
  console.say(printed("the last %d visits at most, products and scratch together", most.visits));
  for (std::size_t stage = 0; stage < most.stages.size(); ++stage) {
    const std::string name(VisitCosts::name_of(ui::CostlyStage(stage)));
    console.say(printed("%-15s %8.1f MiB %6.2f s", name.c_str(), double(most.stages[stage].mib),
                        double(most.stages[stage].seconds)));
  }
  console.say(printed("all of it       %8.1f MiB resident", double(most.resident_mib)));
  return {};
}

// What can be wrong before anybody stands in front of the cameras: memory, store, calibration, the
// algorithms' own files.
Result<void> run(const SelfTestArgs& args, Services& services) {
  if (args.optical) return run_optical_selftest(args, services);
  const BootMemory memory;
  services.console.say("memory       in order: " + mib(memory.all().size()));
  RELIEVO_TRY_ASSIGN(const Path folder, store_folder(args.store));
  RELIEVO_TRY_ASSIGN(const auto store, services.open_store(folder, false));
  RELIEVO_TRY(store->check());
  services.console.say("store        in order: " + folder.string());
  RELIEVO_TRY_ASSIGN(const auto calibration, store->active_calibration());
  services.console.say("calibration  in order: revision " + std::to_string(calibration.revision));
  RELIEVO_TRY_ASSIGN(const auto pipeline, make_pipeline({}, calibration));
  (void)pipeline;
  services.console.say("algorithms   in order");
  return {};
}

// `relievo staff`: the way in of whoever administers the device, when the screen offers none. The store lets
// nobody else in while a kiosk has it.
Result<void> run(const StaffArgs& args, Services& services) {
  RELIEVO_TRY_ASSIGN(const Path folder, store_folder(args.store));
  RELIEVO_TRY_ASSIGN(const auto store, open_kept_store(folder, services));
  if (args.verb == StaffArgs::Verb::PlainTouch) {
    RELIEVO_TRY(store->set_setting(kTouchSetting, ui::text_of(ui::TouchMap{})));
    RELIEVO_TRY(note(*store, folder, services.clock, "staff.plain_touch", "", ui::LogEvent::TouchPlain));
    services.console.say("the touch screen is taken as it is");
    return {};
  }
  const char* role = args.technician ? "technician" : "operator";
  RELIEVO_TRY(Access(*store, services.clock)
                  .forget(args.technician ? ui::StaffRole::Technician : ui::StaffRole::Operator)
                  .at(role));
  RELIEVO_TRY(
      note(*store, folder, services.clock, "staff.pin_forgotten", role,
           args.technician ? ui::LogEvent::TechnicianPinForgotten : ui::LogEvent::OperatorPinForgotten));
  services.console.say(
      "the " + std::string(role) +
      "'s PIN is forgotten: start the kiosk and choose a new one at its screen, before anybody else does");
  return {};
}

Result<std::unique_ptr<storage::Store>> open_kept_store(const Path& folder, Services& services) {
  // To read needs the store: one that is named wrongly is not made. An older one can only be opened to write.
  if (const auto there = services.open_store(folder, false); !there && there.error().code == Errc::NotFound)
    return there.error();
  return services.open_store(folder, true);
}

int run_command(const CommandLine& line, Services& services) {
  return std::visit(
      [&](const auto& args) {
        if constexpr (std::is_same_v<std::decay_t<decltype(args)>, NothingArgs>) {
          return line.exit_code;
        } else {
          Result<void> done = run_in_memory_there_is(args, services);
          if (done) done = services.console.all_said();
          if (!done) services.console.fail(done.error());
          return done ? 0 : 1;
        }
      },
      line.command);
}

}  // namespace relievo::firmware
