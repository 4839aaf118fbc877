// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// LastWill: a process of its own that does one thing when this one ends, however it ends: by itself, by
// a crash, killed. It waits at a pipe whose writing end only this process has.
// Errors: IoFailed (no pipe, no process). Thread: main, before others are made, since it forks.
#pragma once

#include <functional>
#include <utility>

#include <sys/types.h>

#include "hal/base/result.h"

namespace relievo::hal {

class LastWill {
 public:
  // `will` runs in the child, which shares what is open now: system calls only, nothing that locks.
  static Result<LastWill> make(const std::function<void()>& will);
  // Has it done, and waits until it is.
  ~LastWill();
  LastWill(LastWill&& other) noexcept
      : child_(std::exchange(other.child_, 0)), alive_(std::exchange(other.alive_, -1)) {}
  LastWill& operator=(LastWill&&) = delete;

 private:
  LastWill(pid_t child, int alive) : child_(child), alive_(alive) {}
  pid_t child_;
  int alive_;
};

}  // namespace relievo::hal
