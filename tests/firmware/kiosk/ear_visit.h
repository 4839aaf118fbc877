// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Somebody who sees nothing stands before the cameras in a wrong pose and moves by what is heard alone, until
// the picture is taken by itself. Real are the gate on simulated pictures, the page, what is said of it, the
// tone; simulated are the person and the time.
//
//   pose -> pictures -> gate -> page -> words and tones -> BlindVisitor -> pose
//
// Thread: one caller. Errors: end the program with one line.
#pragma once

#include <random>
#include <string>

#include "hal/clock.h"
#include "tests/support/gate_fixture.h"

namespace relievo::test {

// Millimetres and degrees, + to the picture's right, down, away; turned to its right, looking down, the crown
// leaning to its right. About the neck, as people turn.
struct Stance {
  double right = 0, down = 0, away = 0, yaw = 0, pitch = 0, roll = 0;
  bool operator==(const Stance&) const = default;
};

// Knows nothing but what was said and how high the tones were: no function here is told where anything is.
// Each has an own time to react, own steps, and sways and breathes.
class BlindVisitor {
 public:
  explicit BlindVisitor(std::uint32_t seed);
  void hear(const std::string& words, double at_s);
  void hear_tone(double pitch, double at_s);
  // What was heard by then is done; the stance at the end.
  Stance move(double until_s, const Stance& from);

 private:
  double between(double a, double b) { return std::uniform_real_distribution<>(a, b)(random_); }
  double either() { return random_() % 2 == 0 ? 1 : -1; }
  void obey();
  void step(double Stance::*axis, double way);
  void follow_tone(double at_s);

  std::mt19937 random_;
  double reaction_s_, stride_, haste_;
  std::string told_;
  double acts_s_ = 1e9;  // when what was told last is begun
  double Stance::*axis_ = nullptr;
  double way_ = 0, left_ = 0, speed_ = 0;  // of the step under way: direction, how much is left, a second
  double tone_s_ = -9, pitch_ = 0, pitch_before_ = 0, again_s_ = 1e9;
  double now_s_ = 0;
  Stance sway_;
};

struct EarVisit {
  bool captured = false;
  double seconds = 0;
  Stance first, last;
  std::string heard;  // what was said, and when
};

inline constexpr double kEarVisitS = 60;  // after that it has failed

// The seed is the visitor's ways, where they stand at first, and which of five people they are.
EarVisit visit_by_ear(std::uint32_t seed, Album& album, GateFixture& gate);

std::string print(const Stance& stance);

}  // namespace relievo::test
