// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Offscreen: a picture to draw into instead of the window, of any size, 8 bits a channel.
// Thread: main, with a current context. Errors of make(): LibraryFailed (larger than the driver can).
#pragma once

#include <memory>

#include "hal/base/result.h"

namespace relievo::ui {

class Offscreen {
 public:
  static Result<std::unique_ptr<Offscreen>> make(int width_px, int height_px);
  virtual ~Offscreen() = default;
  virtual void begin() = 0;  // what a Renderer draws and reads back is in here
  virtual void end() = 0;
};

}  // namespace relievo::ui
