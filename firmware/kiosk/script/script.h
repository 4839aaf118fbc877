// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Script: what synthetic fingers are to do, read from a file (README.md has its words).
// Thread: main. Errors: NotFound, IoFailed, InvalidInput (with file and line).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "hal/base/result.h"

namespace relievo::firmware {

struct ScriptAction {
  enum class Kind : std::uint8_t { Wait, Tap, Hold, Drag, Type, Pause, Screenshot, Plug, Unplug };
  Kind kind = Kind::Wait;
  std::string word;    // a state, an id, a text, a name, a folder
  double seconds = 0;  // Wait: at most; Hold, Pause: so long
  float dx_px = 0, dy_px = 0;
  std::string where;  // file and line, for errors
};

Result<std::vector<ScriptAction>> read_script(const std::filesystem::path& file);
// One line; nothing in it is no action.
Result<std::vector<ScriptAction>> read_script_line(const std::string& line, const std::string& where);

}  // namespace relievo::firmware
