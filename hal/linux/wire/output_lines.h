// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// OutputLines: the wires of a GPIO chip that this process drives: the trigger's, and perhaps the lamp's.
// Inactive from the request on, and inactive when the object ends. The seam under GpioTriggerLine.
// Thread: one at a time.
#pragma once

#include <sys/types.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "hal/base/result.h"

namespace relievo::hal {

// LastWill: a process of its own that does one thing when this one ends, however it ends: by itself, by
// a crash, killed. It waits at a pipe whose writing end only this process has.
// Errors: IoFailed (no pipe, no process). Thread: main, before others are made, since it forks.
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

enum class Wire : std::uint8_t { Trigger, Lamp };

class OutputLines {
 public:
  virtual ~OutputLines() = default;
  virtual Result<void> set(Wire wire, bool active) = 0;  // IoFailed, Disconnected
};

struct GpioOptions {
  std::string chip;              // /dev/gpiochip0
  unsigned trigger = 0;          // the line's offset on the chip
  std::optional<unsigned> lamp;  // none: no lamp, or one on the trigger's wire
  bool active_low = false;       // both
};

// Through libgpiod, 1.6 or 2 as the library at build time is. A process of its own waits beside: when
// this one dies, killed in the middle of a pulse even, it drives the lines inactive before the kernel
// gives them free.
// Errors: NotFound (no such chip or line), IoFailed (not allowed, in use, not an output).
Result<std::unique_ptr<OutputLines>> request_gpiod_lines(const GpioOptions& options);

}  // namespace relievo::hal
