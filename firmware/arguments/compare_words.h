// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The words of `relievo compare`. Inside line/ only.
#pragma once

#include "firmware/arguments/command_line.h"

namespace CLI {
class App;
}

namespace relievo::firmware {

CLI::App* add_compare(CLI::App& app, CommandArgs& chosen, CompareArgs& args);

}  // namespace relievo::firmware
