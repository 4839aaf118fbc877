// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Console: how a command speaks. Results on standard output; progress on standard error, rewritten
// in place, and only where a terminal is; an error is one line on standard error. And how it is told to stop.
// Thread: main.
#pragma once

#include <atomic>
#include <string_view>

#include "hal/base/result.h"

namespace relievo::firmware {

// To be called before any file is opened. A standard stream that was closed from the beginning becomes
// /dev/null: else the first file would get its number, and lines be written into it. IoFailed: it cannot.
Result<void> open_closed_streams();

// Ctrl-C, SIGTERM and SIGHUP set this flag, which every job asks; the command then ends cleanly, with nothing
// half-written. A second Ctrl-C ends the process at once. Under nohup SIGHUP does nothing. The handlers are
// installed on first use; one flag per process.
const std::atomic<bool>& interrupted();

class Console {
 public:
  Console();
  ~Console() { clear_progress(); }
  Console& operator=(Console&&) = delete;

  void say(std::string_view line);  // results: standard output
  // Asked when the command is done. MediaFull, IoFailed: not every line reached it.
  Result<void> all_said() const;
  void progress(std::string_view what, float done);  // 0 to 1
  void clear_progress();
  void fail(const Error& error);  // "relievo: where: what"

 private:
  bool terminal_ = false;
  bool shown_ = false;
  int failed_ = 0;  // errno of the first line that was lost
};

}  // namespace relievo::firmware
