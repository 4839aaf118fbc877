// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The view that is wanted next, as the left camera shall see it, and the way there in words.
// Thread: one at a time.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "pipeline/calibrate/live/watch/board_parameters.h"
#include "pipeline/model/live_advice.h"

namespace relievo::pipeline {

// What a person can change, one after the other.
enum class BoardAxis : std::uint8_t { Across, Down, Size, TiltAcross, TiltDown, Turn };
inline constexpr std::size_t kBoardAxes = 6;

struct ViewTarget {
  std::array<double, kBoardAxes> at{};         // of BoardParameters; Size: its logarithm
  std::array<double, kBoardAxes> tolerance{};  // nearer is near enough
  // Where the outer corners would be, left, right; none before the cameras are known.
  std::optional<std::array<BoardOutline, 2>> outlines;
};

std::array<double, kBoardAxes> axes_of(const BoardParameters& parameters);

struct PlannedView {
  ViewTarget target;
  std::size_t number = 0;  // of the candidate; those of the opening count from kOpeningNumber
};

// The first views, before the cameras are known: one that faces them, one for each way to tilt, then
// diagonal tilts. The first of them that no view taken fulfils and that is not excluded; else the last.
inline constexpr std::size_t kOpeningNumber = 1000;
PlannedView opening_view(const std::vector<BoardParameters>& taken, std::span<const std::size_t> excluded);

// A word for the largest step that is still to be made, and how large it is: 1 is near enough.
struct WayToGo {
  LiveAdvice word = LiveAdvice::HoldStill;
  double how_far = 0;
};

// Words for all that is not yet near enough, the farthest first.
std::vector<LiveAdvice> words_towards(const ViewTarget& target, const BoardParameters& now);

// What must stay in the two pictures on the way.
struct Room {
  double width_px = 0;
  double height_px = 0;
  std::array<BoardOutline, 2> board;  // with_border()
};

// It stays with an axis until that is near enough: advice that alternates helps nobody. It begins with a
// step after which both cameras still see the board: away before aside, aside before closer.
class Guide {
 public:
  void forget() { axis_.reset(); }
  // No value: it is there.
  std::optional<WayToGo> towards(const ViewTarget& target, const BoardParameters& now, const Room& room);

 private:
  std::optional<std::size_t> axis_;
};

}  // namespace relievo::pipeline
