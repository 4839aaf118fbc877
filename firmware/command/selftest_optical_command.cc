// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <optional>
#include <string>

#include "firmware/base/interrupt.h"
#include "firmware/base/output_folder.h"
#include "firmware/checks/acceptance_report.h"
#include "firmware/command/commands.h"
#include "firmware/jobs/watched_job.h"

namespace relievo::firmware {
namespace {

std::string file_name(std::string name) {
  std::replace(name.begin(), name.end(), ' ', '_');
  return name + ".png";
}

}  // namespace

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
    options.show = [&](const std::string& name, const hal::Picture& picture) -> Result<void> {
      const auto written = hal::write_picture(folder->path() / file_name(name), picture.view());
      if (!written) return written.error().at((args.output / file_name(name)).string());
      return {};
    };
  }
  services.console.say("photographing " + std::to_string(options.boards) + " boards, " +
                       std::to_string(options.dumbbells.size()) + " dumbbells and " +
                       std::to_string(options.plates.size()) + " plates: a minute or two");
  OpticalCheckJob job(services.photograph, options);
  RELIEVO_TRY(run_watched(job, services.console, [&job] { return job.stage(); }));
  for (const std::string& line : acceptance_table(job.report(), options, job.calibration().quality))
    services.console.say(line);
  if (folder) {
    RELIEVO_TRY(write_text(folder->path() / "report.json",
                           acceptance_json(job.report(), options, job.calibration().quality), args.output));
    RELIEVO_TRY(folder->commit());
    services.console.say("report and pictures: " + args.output.string());
  }
  return job.report().verdict(limits_at(options.scale));
}

}  // namespace relievo::firmware
