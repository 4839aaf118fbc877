// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Who comes, and how they stand and are lit: every person once looking straight ahead (enrolment), then
// kProbes times turned by up to 30 degrees, under another light, with another noise and, where the
// generator has one, another expression. Everything follows from the numbers of person and visit.
// Yaw and pitch are those of a head before the rig: 0, 0 looks at the middle between the cameras; yaw + turns
// the face to the picture's right, pitch + looks down; degrees.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace relievo::bench {

constexpr int kProbes = 5;

// Our own head (hal/sim), or another program's: a proof may not rest on one generator.
enum class Maker : std::uint8_t { Own, Other };

struct Visit {
  std::string name;  // of its folder: PERSON_enrol, PERSON_p1 ..
  Maker maker = Maker::Own;
  std::uint32_t person_seed = 1, visit_seed = 1;
  double yaw_deg = 0, pitch_deg = 0, roll_deg = 0, distance_mm = 560;
  double noise = 1;              // of the sensor's own
  double right_gain = 0;         // of the right camera over the left one, share (other maker)
  double smile = 0, squint = 0;  // 0 .. 1 (own)
  double light_left = 1, light_right = 1, light_below = 1;  // of the kiosk's panels (own)
};

struct Person {
  std::string name;
  Maker maker = Maker::Own;
  Visit enrolment;
  std::vector<Visit> probes;  // kProbes; the first and last at -30 and +30 degrees of yaw
};

std::vector<Person> make_population(int own, int other);

}  // namespace relievo::bench
