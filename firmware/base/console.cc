// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/base/console.h"

#include <algorithm>
#include <cstdio>
#include <cstring>

#include <unistd.h>

namespace relievo::firmware {

Console::Console() : terminal_(isatty(STDERR_FILENO) == 1) {}

void Console::say(std::string_view line) {
  clear_progress();
  std::printf("%.*s\n", static_cast<int>(line.size()), line.data());
  std::fflush(stdout);
}

void Console::progress(std::string_view what, float done) {
  if (!terminal_) return;
  constexpr int kWidth = 30;
  const int filled = static_cast<int>(std::clamp(done, 0.0F, 1.0F) * kWidth);
  std::string bar(static_cast<std::size_t>(filled), '#');
  bar.resize(kWidth, '.');
  std::fprintf(stderr, "\r\033[K%-12.*s [%s]", static_cast<int>(what.size()), what.data(), bar.c_str());
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
  std::fprintf(stderr, "%s\n", one_line(error).c_str());
}

std::string one_line(const Error& error) {
  std::string line = "relievo: ";
  if (!error.where().empty()) line.append(error.where()).append(": ");
  line.append(error.what.view());
  if (error.sys_errno != 0) line.append(" (").append(std::strerror(error.sys_errno)).append(")");
  std::replace_if(
      line.begin(), line.end(), [](unsigned char c) { return c < ' ' || c == 127; }, '?');
  return line;
}

}  // namespace relievo::firmware
