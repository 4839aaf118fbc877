// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/kiosk/kiosk.h"

namespace relievo::firmware {

Result<Glass> Glass::on(ui::Display& display) {
  RELIEVO_TRY_ASSIGN(auto renderer, ui::Renderer::make());
  return Glass(display, std::move(renderer));
}

Result<bool> Glass::draw(Kiosk& kiosk, std::chrono::steady_clock::time_point now, bool wanted) {
  const bool forgets = kiosk.take_forgotten();
  const int width = display_->width_px(), height = display_->height_px();
  const ui::DrawList& list = kiosk.ui().draw_list();
  if (!wanted && !forgets && width == width_ && height == height_ && now - drawn_at_ < kAtLeastEvery &&
      list == drawn_)
    return false;
  if (forgets) renderer_->forget();
  renderer_->draw(list, kiosk.ui().text().atlas(), width, height);
  if (renderer_->lost()) {
    renderer_.reset();  // its names mean something else in another context
    RELIEVO_TRY(display_->renew());
    RELIEVO_TRY_ASSIGN(renderer_, ui::Renderer::make());
    renderer_->draw(list, kiosk.ui().text().atlas(), width, height);
    if (renderer_->lost())
      return Error{Errc::LibraryFailed, "the graphics driver draws no more: restart the device"};
  }
  drawn_ = list;
  width_ = width;
  height_ = height;
  drawn_at_ = now;
  return true;
}

}  // namespace relievo::firmware
