// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The words of `relievo simulate photograph` that no other scene has. Inside line/ only.
#pragma once

#include "firmware/arguments/command_line.h"

namespace CLI {
class App;
}

namespace relievo::firmware {

void add_held_picture(CLI::App& command, HeldPictureArgs& args);

}  // namespace relievo::firmware
