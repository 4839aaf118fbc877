// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/base/console.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <string>

#include <unistd.h>

#include "hal/base/words.h"

namespace relievo::firmware {

Console::Console() : terminal_(isatty(STDERR_FILENO) == 1) {}

void Console::say(std::string_view line) {
  clear_progress();
  const bool written = std::printf("%.*s\n", int(line.size()), line.data()) >= 0 && std::fflush(stdout) == 0;
  if (!written && failed_ == 0 && errno != EBADF) failed_ = errno;
}

Result<void> Console::all_said() const {
  if (failed_ == 0) return {};
  return Error{failed_ == ENOSPC || failed_ == EDQUOT ? Errc::MediaFull : Errc::IoFailed,
               "not all of it could be written there: make room, or send it elsewhere", failed_}
      .at("standard output");
}

void Console::progress(std::string_view what, float done) {
  if (!terminal_) return;
  constexpr int kWidth = 30;
  const int filled = int(std::clamp(done, 0.0F, 1.0F) * kWidth);
  std::string bar(std::size_t(filled), '#');
  bar.resize(kWidth, '.');
  std::fprintf(stderr, "\r\033[K%-12.*s [%s]", int(what.size()), what.data(), bar.c_str());
  std::fflush(stderr);
  shown_ = true;
}

void Console::clear_progress() {
  if (!shown_) return;
  std::fprintf(stderr, "\r\033[K");
  std::fflush(stderr);
  shown_ = false;
}

void Console::fail(const Error& error) {
  clear_progress();
  std::fprintf(stderr, "relievo: %s\n", detail_of(error).c_str());
}

}  // namespace relievo::firmware
