// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/base/console.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <string>

#include <fcntl.h>
#include <unistd.h>

#include "hal/base/words.h"

namespace relievo::firmware {
namespace {

// A signal handler has no other way to reach us: the one global of the firmware.
std::atomic<bool> flag{false};
static_assert(std::atomic<bool>::is_always_lock_free);

extern "C" void on_signal(int number) {
  flag.store(true, std::memory_order_relaxed);
  std::signal(number, SIG_DFL);
}

}  // namespace

const std::atomic<bool>& interrupted() {
  static const bool installed = [] {
    std::signal(SIGINT, on_signal);
    std::signal(SIGTERM, on_signal);
    // The terminal has gone: not for what was started to outlive it (nohup).
    if (std::signal(SIGHUP, on_signal) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
    return true;
  }();
  (void)installed;
  return flag;
}

Result<void> open_closed_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) >= 0 || errno != EBADF) continue;
    // Gets the lowest number that is free: this one.
    if (::open("/dev/null", O_RDWR) < 0)
      return Error{Errc::IoFailed, "is wanted in place of a standard stream that is closed", errno}.at(
          "/dev/null");
  }
  return {};
}

Console::Console() : terminal_(isatty(STDERR_FILENO) == 1) {}

void Console::say(std::string_view line) {
  clear_progress();
  const bool written = std::printf("%.*s\n", int(line.size()), line.data()) >= 0 && std::fflush(stdout) == 0;
  if (!written && failed_ == 0) failed_ = errno;
}

Result<void> Console::all_said() const {
  if (failed_ == 0) return {};
  return Error{
      failed_ == ENOSPC || failed_ == EDQUOT ? Errc::MediaFull : Errc::IoFailed,
      "what was asked for has been done, but not all that there is to say could be written there: make "
      "room, or send it elsewhere",
      failed_}
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
