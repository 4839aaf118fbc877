// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The words of `relievo staff`. Thread: main.
#pragma once

#include "firmware/arguments/command_line.h"

namespace CLI {
class App;
}

namespace relievo::firmware {

// `args` is filled and copied into `chosen` when the command is met; both must outlive the parsing.
void add_staff(CLI::App& app, CommandArgs& chosen, StaffArgs& args);

}  // namespace relievo::firmware
