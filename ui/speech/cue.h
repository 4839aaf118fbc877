// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cue: the sign that everybody hears when something has happened, from what was and what is: pure functions.
// And for who listens, how near the face is to its place. Thread: any. Errors: none.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "ui/view/visit.h"

namespace relievo::ui {

enum class Cue : std::uint8_t {
  None,
  Tick,     // a number of the countdown
  Shutter,  // a picture was taken, of the front or a side
  Taken,    // a view was taken in calibration
  Done,     // the portrait is stored
  Refused   // once more, or not at all
};

// What of a moment makes a difference.
struct Cues {
  Screen screen = Screen::SelfTest;
  Step step = Step::Starting;
  Trouble trouble = Trouble::None;
  int number = 0;  // of the countdown; 0: there is none
  std::size_t sides = 0;
  int views = 0;
};
Cues cues_of(const ViewState& view, const Visit& visit);
Cue cue(const Cues& before, const Cues& now);

// While place, distance or the head's pose is to be mended: 0.5 far from where it should be, 2 there, an
// octave each half of the way. Nothing where the cameras see no face, or something else is amiss.
std::optional<float> guide_pitch(const ViewState& view, const Visit& visit);

}  // namespace relievo::ui
