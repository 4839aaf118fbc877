// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <type_traits>

#include "firmware/base/settings.h"
#include "firmware/command/commands.h"

namespace relievo::firmware {
namespace {

Result<void> run(const CalibrateArgs& args, Services& services) {
  return run_calibrate_and_store(args, services);
}
Result<void> run(const CalibrateLiveArgs& args, Services& services) {
  return run_calibrate_live_and_store(args, services);
}
Result<void> run(const PrintPatternArgs& args, Services& services) {
  return run_print_pattern(args, services);
}
Result<void> run(const CalibrationArgs& args, Services& services) { return run_calibration(args, services); }
Result<void> run(const ReconstructArgs& args, Services& services) { return run_reconstruct(args, services); }
Result<void> run(const CompareArgs& args, Services& services) { return run_compare(args, services); }
Result<void> run(const EnrolArgs& args, Services& services) { return run_enrol(args, services); }
Result<void> run(const SubjectsArgs& args, Services& services) { return run_subjects(args, services); }
Result<void> run(const StaffArgs& args, Services& services) { return run_staff(args, services); }
Result<void> run(const StoreArgs& args, Services& services) { return run_store(args, services); }
Result<void> run(const SimulateArgs& args, Services& services) { return run_simulate(args, services); }
Result<void> run(const SelfTestArgs& args, Services& services) { return run_selftest(args, services); }
Result<void> run(const KioskArgs& args, Services& services) { return run_kiosk(args, services); }
Result<void> run(const AlgorithmsArgs& args, Services& services) { return run_algorithms(args, services); }
Result<void> run(const MemoryArgs& args, Services& services) { return run_memory(args, services); }
Result<void> run(const VersionArgs& args, Services& services) { return run_version(args, services); }

}  // namespace

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
          const Result<void> done = run(args, services);
          if (!done) services.console.fail(done.error());
          return done ? 0 : 1;
        }
      },
      line.command);
}

}  // namespace relievo::firmware
