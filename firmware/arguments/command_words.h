// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The words of the commands that have files of their own, for cli11_command_line.cc. What they fill must
// outlive the parsing; `args` of a command is copied into `chosen` when that command is met. Thread: main.
#pragma once

#include "firmware/arguments/command_line.h"

namespace CLI {
class App;
}

namespace relievo::firmware {

// What --board may be. The word on the command line and the file board.toml name the device (hal/device.h):
// they are kept because people type them and services name them.
inline constexpr const char* kDevices =
    "sim; folder:DIR with recorded pairs; linux, or linux:FILE that says what is wired where (default /etc/relievo/board.toml)";

inline constexpr const char* kKeyOption = "--key";
void add_store(CLI::App& command, Path& store);  // and kKeyOption, which CommandLine::key takes up
void add_kiosk(CLI::App& app, KioskArgs& args);  // the words before any command
void add_calibration(CLI::App& app, CommandArgs& chosen, CalibrationArgs& args);
void add_staff(CLI::App& app, CommandArgs& chosen, StaffArgs& args);
void add_store_keeping(CLI::App& app, CommandArgs& chosen, StoreArgs& args);
CLI::App* add_compare(CLI::App& app, CommandArgs& chosen, CompareArgs& args);
// Of `relievo simulate photograph`, what no other scene has.
void add_held_picture(CLI::App& command, HeldPictureArgs& args);

}  // namespace relievo::firmware
