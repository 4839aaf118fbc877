// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/command/commands.h"
#include "firmware/command/interrupt.h"
#include "firmware/command/output_folder.h"

namespace relievo::firmware {

Result<void> run_simulate(const SimulateArgs& args, Services& services) {
  const std::atomic<bool>& stop = interrupted();
  RELIEVO_TRY_ASSIGN(OutputFolder folder, OutputFolder::begin(args.output));
  const auto progress = [&](float done) {
    services.console.progress("Simulate", done);
    return !stop.load();
  };
  if (const auto done = services.simulate(args, folder.path(), progress); !done) {
    return done.error().where().empty() ? done.error().at(args.output.string()) : done.error();
  }
  if (stop.load()) return Error{Errc::Cancelled, "cancelled: nothing was written"}.at(args.output.string());
  RELIEVO_TRY(folder.commit());
  services.console.say("pictures: " + args.output.string());
  return {};
}

}  // namespace relievo::firmware
