// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/linux/wire/last_will.h"

#include <array>
#include <cerrno>
#include <csignal>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace relievo::hal {

Result<LastWill> LastWill::make(const std::function<void()>& will) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0)
    return Error{Errc::IoFailed, "no pipe to notice the end of this process", errno};
  const pid_t child = ::fork();
  if (child < 0) {
    ::close(ends[0]);
    ::close(ends[1]);
    return Error{Errc::IoFailed, "no process to notice the end of this one", errno};
  }
  if (child == 0) {
    ::close(ends[1]);
    // What stops the parent from the keyboard or by its service must not stop this one first.
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) (void)::signal(signal, SIG_IGN);
    char byte = 0;
    while (::read(ends[0], &byte, 1) < 0 && errno == EINTR) {
    }
    will();
    ::_exit(0);
  }
  ::close(ends[0]);
  return LastWill(child, ends[1]);
}

LastWill::~LastWill() {
  if (child_ <= 0) return;
  ::close(alive_);
  ::waitpid(child_, nullptr, 0);
}

}  // namespace relievo::hal
