// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Words that several commands share. What they fill must outlive the parsing. Thread: main.
#pragma once

#include "firmware/arguments/command_line.h"

namespace CLI {
class App;
}

namespace relievo::firmware {

// What --board may be.
inline constexpr const char* kBoards =
    "sim; folder:DIR with recorded pairs; linux, or linux:FILE that says what is wired where (default /etc/relievo/board.toml)";

void add_store(CLI::App& command, Path& store);

}  // namespace relievo::firmware
