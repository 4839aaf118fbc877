// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What heads usually look like: radii about the upright axis (unrolled_head.h) as a mean and kHeadModes ways
// in which people differ from it, each scaled to one standard deviation (principal components; Blanz and
// Vetter, A morphable model for the synthesis of 3D faces, 1999, without their correspondences: a radius is
// where it is). Learned from kHeadPeople heads of hal/sim, whose measures follow Farkas, each laid into the
// frame that find_head_frame() found on it; generic_head_data.cc is written by `make_generic_head` in
// tests/bench. Millimetres. Thread: any.
#pragma once

#include <array>
#include <cstdint>

namespace relievo::pipeline {

inline constexpr int kHeadColumns = 51;  // arcs from -kHalfArc to kHalfArc
inline constexpr int kHeadRows = 39;     // heights from -kBelow to kAbove
inline constexpr int kHeadModes = 24;
inline constexpr int kHeadPeople = 300;
inline constexpr double kHeadMeanUnit = 0.01;  // mm a count
inline constexpr double kHeadModeUnit = 0.001;

extern const std::array<std::int16_t, kHeadColumns * kHeadRows> kHeadMean;
extern const std::array<std::array<std::int16_t, kHeadColumns * kHeadRows>, kHeadModes> kHeadMode;
extern const std::array<std::int16_t, kHeadColumns * kHeadRows>
    kHeadLeft;  // rms of what no mode shows, of heads kept apart; kHeadMeanUnit

// The mean and every mode at one place, smooth between the cells.
struct HeadPlace {
  double mean_mm = 0;
  double left_mm = 0;
  std::array<double, kHeadModes> mode_mm{};
};
HeadPlace head_place(double arc_mm, double y_mm);

}  // namespace relievo::pipeline
