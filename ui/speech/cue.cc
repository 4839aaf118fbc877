// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/speech/cue.h"

#include <algorithm>
#include <cmath>

#include "ui/technician/technician_view.h"

namespace relievo::ui {

Cues cues_of(const ViewState& view, const Visit& visit) {
  Cues now{.screen = view.screen, .step = visit.step, .trouble = view.trouble};
  if (visit.step == Step::Position) now.number = visit.countdown_number(view.live);
  if (view.live.turn) now.sides = view.live.turn->taken.count();
  if (view.service != nullptr && view.service->technician != nullptr)
    now.views = view.service->technician->calibration.views;
  return now;
}

Cue cue(const Cues& before, const Cues& now) {
  const bool other_screen = before.screen != now.screen, other_step = before.step != now.step;
  if (other_step && now.step == Step::Thanks) return Cue::Done;
  const bool begun = before.step != Step::Starting && before.step != Step::Attract;
  if (other_step && now.step == Step::Trouble && begun) return Cue::Refused;
  if (before.trouble != now.trouble && now.trouble == Trouble::Storage) return Cue::Refused;
  if (other_screen && now.screen == Screen::Position && now.trouble == Trouble::Refused) return Cue::Refused;
  // Only what is over was taken.
  if (before.screen == Screen::Capture && (now.screen == Screen::Turn || now.screen == Screen::Match))
    return Cue::Shutter;
  if (now.screen == Screen::Turn && now.sides > before.sides) return Cue::Shutter;
  if (now.views > before.views) return Cue::Taken;
  return now.number != 0 && now.number != before.number ? Cue::Tick : Cue::None;
}

namespace {

// How far from its place, where 1 is far, by what is to be mended first; negative where no tone can tell.
float away_of(const LiveView& live) {
  using pipeline::Advice;
  constexpr float kFarDeg = 45;
  if (live.advice == Advice::TooClose || live.advice == Advice::TooFar)
    return live.nearness > 0 ? 2 * std::abs(live.nearness - 1) : -1;
  if (live.advice == Advice::OffCentre) return std::hypot(live.face_x, live.face_y);
  if (live.advice == Advice::TurnedAside) return std::abs(live.yaw_deg) / kFarDeg;
  if (live.advice == Advice::LooksUpOrDown) return std::abs(live.pitch_deg) / kFarDeg;
  if (live.advice == Advice::Tilted) return std::abs(live.roll_deg) / kFarDeg;
  return -1;
}

}  // namespace

std::optional<float> guide_pitch(const ViewState& view, const Visit& visit) {
  if (visit.step != Step::Position || visit.overlay != Overlay::None) return std::nullopt;
  const float away = away_of(view.live);
  if (away < 0) return std::nullopt;
  return std::exp2(1 - 2 * std::min(1.0F, away));
}

}  // namespace relievo::ui
