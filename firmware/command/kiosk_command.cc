// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// `relievo` without a command: the kiosk, in a window or on the whole screen.
#include <chrono>
#include <thread>

#include "firmware/base/budget.h"
#include "firmware/base/process_memory.h"
#include "firmware/base/sentinel.h"
#include "firmware/command/commands.h"
#include "firmware/kiosk/kiosk.h"
#include "firmware/kiosk/script/script_player.h"
#include "hal/picture_file.h"

namespace relievo::firmware {
namespace {

constexpr std::chrono::milliseconds kFrame{16};  // where the screen does not set the pace itself

// What a loop without a script has not: fingers of its own, and figures of every frame.
struct Scripted {
  ScriptPlayer player;
  VisitFigures figures;
  Path pictures;
};

Result<void> keep_picture(ui::Renderer& renderer, const ui::Display& display, const Path& file) {
  hal::Picture picture;
  picture.width_px = display.width_px();
  picture.height_px = display.height_px();
  picture.bytes.resize(std::size_t{3} * std::size_t(picture.width_px) * std::size_t(picture.height_px));
  renderer.read_back({reinterpret_cast<std::uint8_t*>(picture.bytes.data()), picture.bytes.size()},
                     picture.width_px, picture.height_px);
  return hal::write_picture(file, picture.view());
}

// What may change the page: the next finger is for the page it leads to, however long a frame takes.
bool is_a_deed(const ui::Input& input) {
  using Kind = ui::Input::Kind;
  return input.kind == Kind::Up || input.kind == Kind::Activate || input.kind == Kind::Back;
}

Result<void> run_on(ui::Display& display, Kiosk& kiosk, Sentinel& sentinel, Scripted* scripted) {
  RELIEVO_TRY_ASSIGN(auto glass, Glass::on(display));
  const std::atomic<bool>& stop = interrupted();
  while (!stop.load()) {
    const auto begin = std::chrono::steady_clock::now();
    sentinel.kick();
    std::optional<std::string> picture;
    if (scripted != nullptr) {
      RELIEVO_TRY_ASSIGN(const bool goes_on, scripted->player.turn(kiosk, begin));
      if (!goes_on) return {};
      picture = scripted->player.take_screenshot();
      scripted->figures.begin();
    }
    while (const auto input = display.poll()) {
      if (input->kind == ui::Input::Kind::Quit) return {};
      kiosk.feed(*input);
      if (is_a_deed(*input)) break;
    }
    kiosk.ui().resize(display.width_px(), display.height_px());
    kiosk.turn();
    sentinel.kick();  // a first frame may take long to draw
    if (scripted != nullptr) scripted->figures.made();
    RELIEVO_TRY_ASSIGN(const bool drawn, glass.draw(kiosk, begin, picture.has_value()));
    if (picture)
      RELIEVO_TRY(keep_picture(glass.renderer(), display, scripted->pictures / (*picture + ".png")));
    if (drawn) display.show();
    if (scripted != nullptr) scripted->figures.shown(kiosk, drawn);
    std::this_thread::sleep_until(begin + kFrame);
  }
  return {};
}

Result<void> run_script(ui::Display& display, Kiosk& kiosk, Sentinel& sentinel,
                        std::vector<ScriptAction> script, const Path& pictures, Services& services) {
  ScriptPlayer::Hands hands{[&display](const ui::Input& finger) { display.push(finger); }, {}};
  if (services.plug_stick)
    hands.plug = [&kiosk, &services](const std::string& folder) {
      return services.plug_stick(kiosk.device(), folder);
    };
  Scripted scripted{ScriptPlayer(std::move(script), std::move(hands)), VisitFigures(services.allocations),
                    pictures};
  RELIEVO_TRY(run_on(display, kiosk, sentinel, &scripted));
  for (const std::string& line : scripted.figures.lines()) services.console.say(line);
  return {};
}

}  // namespace

Result<void> run(const KioskArgs& args, Services& services) {
  RELIEVO_TRY(take_heap(budget::kHeapBytes));
  RELIEVO_TRY(ui::prepare_languages());
  std::vector<ScriptAction> script;
  const bool scripted = !args.script.empty(), pictures = !scripted && !args.screenshots.empty();
  if (scripted) {
    RELIEVO_TRY_ASSIGN(script, read_script(args.script));
  }
  std::error_code error;
  if (!args.screenshots.empty() && (std::filesystem::create_directories(args.screenshots, error), error))
    return Error{Errc::IoFailed, "no folder can be made there: choose another"}.at(args.screenshots.string());
  Sentinel sentinel(services.clock);  // also while the kiosk closes
  RELIEVO_TRY_ASSIGN(const auto kiosk, Kiosk::open(args, services));
  RELIEVO_TRY_ASSIGN(const auto display, services.open_display({pictures ? 1280 : args.width_px,
                                                                pictures ? 800 : args.height_px}));
  kiosk->leave_mark(true);  // whatever ends this from here on, also what is thrown
  // What a simulated rig or a recording holds is none of the appliance's.
  if (kiosk->device().is_live()) RELIEVO_TRY(bound_memory(budget::kDriverBytes + budget::kSolidBytes));
  const Result<void> done =
      scripted   ? run_script(*display, *kiosk, sentinel, std::move(script), args.screenshots, services)
      : pictures ? services.take_screenshots(args, *kiosk, services.console)
                 : run_on(*display, *kiosk, sentinel, nullptr);
  kiosk->leave_mark(!done);
  return done;
}

}  // namespace relievo::firmware
