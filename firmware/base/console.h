// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Console: how a command speaks. Results on standard output; progress on standard error, rewritten
// in place, and only where a terminal is; an error is one line on standard error.
// Thread: main.
#pragma once

#include <string>
#include <string_view>

#include "hal/base/result.h"

namespace relievo::firmware {

class Console {
 public:
  Console();
  ~Console() { clear_progress(); }
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  void say(std::string_view line);                   // results: standard output
  void progress(std::string_view what, float done);  // 0 to 1
  void clear_progress();
  void fail(const Error& error);  // "relievo: where: what"

 private:
  bool terminal_ = false;
  bool shown_ = false;
};

// One line, whatever a file name holds: control characters become '?'.
std::string one_line(const Error& error);

}  // namespace relievo::firmware
