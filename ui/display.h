// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Display: a window or a whole screen, with its fingers and keys, and the GL context the Renderer needs.
// Which one it is, firmware/main.cc says. Thread: main.
#pragma once

#include <optional>

#include "hal/base/result.h"
#include "ui/view/input.h"

namespace relievo::ui {

class Display {
 public:
  virtual ~Display() = default;
  virtual int width_px() const = 0;
  virtual int height_px() const = 0;
  virtual std::optional<Input> poll() = 0;
  // A synthetic finger: it comes back through poll(), as a person's does.
  virtual void push(const Input& finger) = 0;
  // A GL context in place of one the driver has lost; what was in that is gone. Errors: LibraryFailed.
  virtual Result<void> renew() = 0;
  virtual void show() = 0;  // what was drawn; waits for the screen where it can
};

struct DisplayOptions {
  int width_px = 0, height_px = 0;  // 0: the whole screen
};

}  // namespace relievo::ui
