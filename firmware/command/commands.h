// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The commands, each in a file of its own. An error of one is told in one line; nothing half-written
// stays. Thread: main; the long ones use the worker and stop at Ctrl-C.
#pragma once

#include "firmware/base/settings.h"
#include "firmware/services/services.h"

namespace relievo::firmware {

Result<void> run_calibrate_and_store(const CalibrateArgs& args, Services& services);
Result<void> run_calibrate_live_and_store(const CalibrateLiveArgs& args, Services& services);
Result<void> run_print_pattern(const PrintPatternArgs& args, Services& services);
Result<void> run_calibration(const CalibrationArgs& args, Services& services);
Result<void> run_reconstruct(const ReconstructArgs& args, Services& services);
Result<void> run_compare(const CompareArgs& args, Services& services);
Result<void> run_enrol(const EnrolArgs& args, Services& services);
Result<void> run_subjects(const SubjectsArgs& args, Services& services);
Result<void> run_staff(const StaffArgs& args, Services& services);
Result<void> run_store(const StoreArgs& args, Services& services);
Result<void> run_simulate(const SimulateArgs& args, Services& services);
Result<void> run_selftest(const SelfTestArgs& args, Services& services);
Result<void> run_optical_selftest(const SelfTestArgs& args, Services& services);
Result<void> run_kiosk(const KioskArgs& args, Services& services);
Result<void> run_algorithms(const AlgorithmsArgs& args, Services& services);
Result<void> run_memory(const MemoryArgs& args, Services& services);
Result<void> run_version(const VersionArgs& args, Services& services);

// Does what was asked for. Returns the exit code; the error, if any, is told.
int run_command(const CommandLine& line, Services& services);

// The store in it, to write. Errors: NotFound (there is none, and none is made); as Services::open_store.
Result<std::unique_ptr<storage::Store>> open_kept_store(const Path& folder, Services& services);

}  // namespace relievo::firmware
