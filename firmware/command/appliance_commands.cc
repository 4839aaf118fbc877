// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// selftest, memory, version: what the appliance says about itself.
#include <cstdio>
#include <string>

#include "firmware/arguments/algorithm_choice.h"
#include "firmware/base/boot_memory.h"
#include "firmware/base/version.h"
#include "firmware/command/commands.h"
#include "firmware/report/report.h"

namespace relievo::firmware {
namespace {

std::string mib(std::size_t bytes) {
  char text[32];
  std::snprintf(text, sizeof text, "%8.1f MiB",
                static_cast<double>(bytes) / static_cast<double>(budget::kMiB));
  return text;
}

}  // namespace

Result<void> run(const VersionArgs&, Services& services) {
  services.console.say("relievo " + std::string(kVersion));
  return {};
}

Result<void> run(const MemoryArgs&, Services& services) {
  Console& console = services.console;
  console.say("pictures        " + mib(budget::kFramePoolBytes));
  console.say("stage products  " + mib(budget::kOutputArenaBytes));
  console.say("stage scratch   " + mib(budget::kScratchArenaBytes));
  console.say("sides of a head " + mib(budget::kSidesBytes + budget::kFollowBytes));
  console.say("technician      " + mib(budget::kTechnicianBytes));
  console.say("libraries       " + mib(budget::kLibraryBytes));
  console.say("queues          " + mib(budget::kQueueBytes));
  console.say("of              " + mib(budget::kApplianceBytes));
  return {};
}

// What can be wrong before anybody stands in front of the cameras: memory, store, calibration, the
// algorithms' own files.
Result<void> run(const SelfTestArgs& args, Services& services) {
  if (args.optical) return run_optical_selftest(args, services);
  const BootMemory memory;
  services.console.say("memory       in order: " + mib(memory.all().size()));
  RELIEVO_TRY_ASSIGN(const auto store, services.open_store(store_folder(args.store), false));
  RELIEVO_TRY(store->check());
  services.console.say("store        in order: " + store_folder(args.store).string());
  RELIEVO_TRY_ASSIGN(const auto calibration, store->active_calibration());
  services.console.say("calibration  in order: revision " + std::to_string(calibration.revision));
  RELIEVO_TRY_ASSIGN(const auto pipeline, make_pipeline({}, calibration));
  (void)pipeline;
  services.console.say("algorithms   in order");
  return {};
}

}  // namespace relievo::firmware
