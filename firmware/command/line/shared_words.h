// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Words that several commands share. What they fill must outlive the parsing. Thread: main.
#pragma once

#include "firmware/command/line/command_line.h"

namespace CLI {
class App;
}

namespace relievo::firmware {

void add_store(CLI::App& command, Path& store);

}  // namespace relievo::firmware
