// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The commands, each in a file of its own: what is asked for says which runs. An error of one is told in one
// line; nothing half-written stays. Thread: main; the long ones use the worker and stop at Ctrl-C.
#pragma once

#include "firmware/services/services.h"

namespace relievo::firmware {

Result<void> run(const CalibrateArgs& args, Services& services);
Result<void> run(const CalibrateLiveArgs& args, Services& services);
Result<void> run(const PrintPatternArgs& args, Services& services);
Result<void> run(const CalibrationArgs& args, Services& services);
Result<void> run(const ReconstructArgs& args, Services& services);
Result<void> run(const CompareArgs& args, Services& services);
Result<void> run(const EnrolArgs& args, Services& services);
Result<void> run(const SubjectsArgs& args, Services& services);
Result<void> run(const StaffArgs& args, Services& services);
Result<void> run(const StoreArgs& args, Services& services);
Result<void> run(const SimulateArgs& args, Services& services);
Result<void> run(const SelfTestArgs& args, Services& services);
Result<void> run(const KioskArgs& args, Services& services);
Result<void> run(const AlgorithmsArgs& args, Services& services);
Result<void> run(const MemoryArgs& args, Services& services);
Result<void> run(const VersionArgs& args, Services& services);

// Does what was asked for. Returns the exit code; the error, if any, is told.
int run_command(const CommandLine& line, Services& services);

// The store in it, to write. Errors: NotFound (there is none, and none is made); as Services::open_store.
Result<std::unique_ptr<storage::Store>> open_kept_store(const Path& folder, Services& services);

// The one in use. None: of a store that is not there yet, or holds none. Errors: the store's.
Result<std::optional<pipeline::StereoCalibration>> known_calibration(const Path& folder, Services& services);

// From what a person typed to somebody in the store: a name, a number as "#3", or the code a visitor was
// given. Nobody: none has that name; a number or a code is somebody's, or NotFound. Errors: InvalidInput
// (several have the name: the numbers tell them apart; an empty word).
Result<std::optional<storage::SubjectId>> choose_subject(storage::Store& store,
                                                         std::string_view name_or_number);
// May somebody be enrolled by this name or number? Asked before anything is opened: nobody is photographed in
// vain. Who was stored with a space around the name is enrolled again by the number.
Result<void> check_subject(std::string_view name_or_number);

}  // namespace relievo::firmware
