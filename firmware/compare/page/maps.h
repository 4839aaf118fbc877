// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Maps as pictures for the page: small, PNG, every pixel one pixel of the map, never a mean of several, so
// that colours mean what the legend says. Colours are told apart without red and green.
// Errors: those of the encoder. Thread: any.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "firmware/measure/comparison.h"
#include "hal/base/result.h"

namespace relievo::firmware::compare {

using Rgb = std::array<std::uint8_t, 3>;
using Png = std::vector<std::byte>;

inline constexpr Rgb kHoleColour{226, 230, 234};     // no disparity
inline constexpr Rgb kUnknownColour{255, 255, 255};  // no truth
inline constexpr Rgb kMissedColour{120, 130, 140};   // a truth, and no disparity
inline constexpr Rgb kTooFarColour{16, 58, 120};     // off by more than the limit: a disparity too small
inline constexpr Rgb kTooNearColour{176, 66, 4};     // and too large

Rgb depth_colour(double share);  // 0 far to 1 near
Rgb error_colour(double error_px, double limit_px);
Rgb rule_colour(std::size_t rule);
std::string hex(Rgb colour);  // "#rrggbb"

struct Reach {
  double least_px = 0, most_px = 1;
};
// Where nearly all known disparities lie.
Reach reach_of(const DisparityMap& map);

// The part of a view that a picture shows.
struct Window {
  int left = 0, top = 0, width_px = 0, height_px = 0;
};
// All of it, or, where what is known lies in less than half of it (a face), that with a margin.
Window window_of(const PairFacts& pair, const std::vector<const Run*>& runs);

// All are as wide as `width_px`, or as the window where that is narrower.
Result<Png> grey_picture(const PairFacts& pair, const Window& window, int width_px);
Result<Png> disparity_picture(const DisparityMap& map, const Reach& reach, const Window& window,
                              int width_px);
Result<Png> error_picture(const DisparityMap& map, const DisparityTruth& truth, double limit_px,
                          const Window& window, int width_px);
Result<Png> rejected_picture(const PairFacts& pair, const Run& run, const Window& window, int width_px);
Result<Png> places_picture(const PairFacts& pair, const SelectorFigures& selector, const Window& window,
                           int width_px);

}  // namespace relievo::firmware::compare
