// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The words before any command: they are the kiosk's. Thread: main.
#pragma once

#include "firmware/arguments/command_line.h"

namespace CLI {
class App;
}

namespace relievo::firmware {

// `args` is filled while `app` parses, and must outlive that.
void add_kiosk(CLI::App& app, KioskArgs& args);

}  // namespace relievo::firmware
