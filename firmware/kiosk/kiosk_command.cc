// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// `relievo` without a command: the kiosk, in a window or on the whole screen.
#include <chrono>
#include <thread>

#include "firmware/command/commands.h"
#include "firmware/command/interrupt.h"
#include "firmware/kiosk/kiosk.h"
#include "firmware/kiosk/screenshots.h"
#include "ui/render/renderer.h"

namespace relievo::firmware {
namespace {

constexpr std::chrono::milliseconds kFrame{16};  // where the screen does not set the pace itself

Result<void> run_on(ui::Display& display, Kiosk& kiosk) {
  RELIEVO_TRY_ASSIGN(const auto renderer, ui::Renderer::make());
  const std::atomic<bool>& stop = interrupted();
  while (!stop.load()) {
    const auto begin = std::chrono::steady_clock::now();
    while (const auto input = display.poll()) {
      if (input->kind == ui::Input::Kind::Quit) return {};
      kiosk.feed(*input);
    }
    kiosk.ui().resize(display.width_px(), display.height_px());
    kiosk.turn();
    if (kiosk.take_forgotten()) renderer->forget();
    renderer->draw(kiosk.ui().draw_list(), kiosk.ui().text().atlas(), display.width_px(), display.height_px());
    display.show();
    std::this_thread::sleep_until(begin + kFrame);
  }
  return {};
}

}  // namespace

Result<void> run_kiosk(const KioskArgs& args, Services& services) {
  RELIEVO_TRY(ui::prepare_languages());
  RELIEVO_TRY_ASSIGN(const auto kiosk, Kiosk::open(args, services));
  const bool pictures = !args.screenshots.empty();
  RELIEVO_TRY_ASSIGN(const auto display, services.open_display({pictures ? 1280 : args.width_px, pictures ? 800 : args.height_px}));
  return pictures ? take_screenshots(args, *kiosk, services.console) : run_on(*display, *kiosk);
}

}  // namespace relievo::firmware
