// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Glass: the kiosk's pages on a display. It draws what is not on the screen yet: a page that stands still
// leaves the processor to the pipeline. A GL context that the driver loses is made anew and drawn into again:
// no visit ends for it. Thread: main.
#pragma once

#include <chrono>
#include <memory>

#include "firmware/kiosk/kiosk.h"
#include "ui/display.h"
#include "ui/render/renderer.h"

namespace relievo::firmware {

class Glass {
 public:
  // The display outlives it. Errors: the renderer's.
  static Result<Glass> on(ui::Display& display);

  // True: there is a new frame, to be shown. Errors: LibraryFailed (the driver gives no context any more).
  Result<bool> draw(Kiosk& kiosk, std::chrono::steady_clock::time_point now, bool wanted);
  ui::Renderer& renderer() { return *renderer_; }

 private:
  Glass(ui::Display& display, std::unique_ptr<ui::Renderer> renderer)
      : display_(&display), renderer_(std::move(renderer)) {}
  static constexpr std::chrono::milliseconds kAtLeastEvery{500};  // a window may have been covered
  ui::Display* display_;
  std::unique_ptr<ui::Renderer> renderer_;
  ui::DrawList drawn_;
  int width_ = 0, height_ = 0;
  std::chrono::steady_clock::time_point drawn_at_{};
};

}  // namespace relievo::firmware
