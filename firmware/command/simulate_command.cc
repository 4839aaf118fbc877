// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/base/output_folder.h"
#include "firmware/command/commands.h"
#include "firmware/jobs/watched_job.h"

namespace relievo::firmware {
namespace {

class SimulateJob final : public Job {
 public:
  SimulateJob(const SimulateArgs& args, const Path& folder, const Services& services)
      : args_(args), folder_(folder), services_(services) {}
  Result<void> run(JobControl& control) override {
    RELIEVO_TRY(services_.simulate(args_, folder_));
    if (control.cancelled.load()) return Error{Errc::Cancelled, "cancelled: nothing was written"};
    return {};
  }

 private:
  const SimulateArgs& args_;
  const Path& folder_;
  const Services& services_;
};

}  // namespace

Result<void> run(const SimulateArgs& args, Services& services) {
  RELIEVO_TRY_ASSIGN(OutputFolder folder, OutputFolder::begin(args.output));
  SimulateJob job(args, folder.path(), services);
  if (const auto done = run_watched(job, services.console, [] { return "Simulate"; }); !done) {
    if (!args.held.picture.empty() && done.error().where() == args.held.picture.native()) return done.error();
    return done.error().at(args.output.string());  // not where the files lie for the moment
  }
  RELIEVO_TRY(folder.commit());
  services.console.say("pictures: " + args.output.string());
  return {};
}

}  // namespace relievo::firmware
