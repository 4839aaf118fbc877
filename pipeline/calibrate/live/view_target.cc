// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/live/view_target.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace relievo::pipeline {
namespace {

constexpr double kTilt = 0.6;  // sine of the tilts of the opening
constexpr double kAny = 1e9;   // tolerance of an axis that does not matter

// More, less of each axis.
constexpr LiveAdvice kWords[kBoardAxes][2] = {
    {LiveAdvice::Right, LiveAdvice::Left},
    {LiveAdvice::Down, LiveAdvice::Up},
    {LiveAdvice::Closer, LiveAdvice::Farther},
    {LiveAdvice::TiltLeft, LiveAdvice::TiltRight},
    {LiveAdvice::TiltForward, LiveAdvice::TiltBack},
    {LiveAdvice::TurnClockwise, LiveAdvice::TurnCounterclockwise},
};

// Anywhere near the middle, neither tiny nor cut off.
ViewTarget tilted(double across, double down, double other_tolerance) {
  constexpr double kNear = 0.13;
  ViewTarget target;
  target.at = {0.5, 0.5, std::log(0.45), across, down, 0};
  target.tolerance = {
      0.2, 0.2, 0.5, across != 0 ? kNear : other_tolerance, down != 0 ? kNear : other_tolerance, kAny};
  return target;
}

bool fulfils(const BoardParameters& view, const ViewTarget& target) {
  const auto at = axes_of(view);
  for (std::size_t i = 0; i < kBoardAxes; ++i)
    if (std::abs(at[i] - target.at[i]) > target.tolerance[i]) return false;
  return true;
}

// How a board becomes narrower with its tilt (axes as sines), at most to a third.
double narrowed(double from, double to) {
  const auto cosine = [](double sine) { return std::sqrt(1 - std::min(sine * sine, 0.9)); };
  return cosine(to) / cosine(from);
}

// Would both cameras still see the board after this one axis went all its way? In the picture, roughly.
bool stays_whole(const Room& room, std::size_t axis, double from, double to) {
  double shift[2] = {0, 0};
  double scale[2] = {1, 1};
  switch (static_cast<BoardAxis>(axis)) {
    case BoardAxis::Across: shift[0] = (to - from) * room.width_px; break;
    case BoardAxis::Down: shift[1] = (to - from) * room.height_px; break;
    case BoardAxis::Size: scale[0] = scale[1] = std::exp(to - from); break;
    case BoardAxis::TiltAcross: scale[0] = narrowed(from, to); break;
    case BoardAxis::TiltDown: scale[1] = narrowed(from, to); break;
    case BoardAxis::Turn: return true;
  }
  for (const BoardOutline& board : room.board) {
    Vec2d middle;
    for (const Vec2d& at : board) middle = {middle.x + 0.25 * at.x, middle.y + 0.25 * at.y};
    for (const Vec2d& at : board) {
      const double x = middle.x + shift[0] + scale[0] * (at.x - middle.x);
      const double y = middle.y + shift[1] + scale[1] * (at.y - middle.y);
      if (x < 0 || y < 0 || x > room.width_px || y > room.height_px) return false;
    }
  }
  return true;
}

}  // namespace

std::array<double, kBoardAxes> axes_of(const BoardParameters& p) {
  return {p.across, p.down, std::log(std::max(p.size, 1e-6)), p.tilt_across, p.tilt_down, p.turn_rad};
}

PlannedView opening_view(const std::vector<BoardParameters>& taken, std::span<const std::size_t> excluded) {
  const ViewTarget opening[] = {
      tilted(0, 0, 0.12),        tilted(kTilt, 0, 0.3),    tilted(-kTilt, 0, 0.3),
      tilted(0, kTilt, 0.3),     tilted(0, -kTilt, 0.3),   tilted(kTilt, kTilt, 0),
      tilted(-kTilt, -kTilt, 0), tilted(kTilt, -kTilt, 0), tilted(-kTilt, kTilt, 0)};
  PlannedView last;
  for (const ViewTarget& target : opening) {
    last = {target, kOpeningNumber + std::size_t(&target - opening)};
    const bool known =
        std::ranges::any_of(taken, [&](const BoardParameters& view) { return fulfils(view, target); });
    if (!known && std::ranges::find(excluded, last.number) == excluded.end()) break;
  }
  return last;
}

std::vector<LiveAdvice> words_towards(const ViewTarget& target, const BoardParameters& now) {
  const auto at = axes_of(now);
  std::vector<std::pair<double, LiveAdvice>> off;
  for (std::size_t i = 0; i < kBoardAxes; ++i) {
    const double steps = (target.at[i] - at[i]) / target.tolerance[i];
    if (std::abs(steps) > 1) off.emplace_back(std::abs(steps), kWords[i][steps > 0 ? 0 : 1]);
  }
  std::ranges::stable_sort(off, [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<LiveAdvice> words;
  words.reserve(off.size());
  for (const auto& [steps, word] : off) words.push_back(word);
  return words;
}

std::optional<WayToGo> Guide::towards(const ViewTarget& target, const BoardParameters& now,
                                      const Room& room) {
  const auto at = axes_of(now);
  const auto off = [&](std::size_t i) { return (target.at[i] - at[i]) / target.tolerance[i]; };
  if (axis_ && std::abs(off(*axis_)) <= 1) axis_.reset();
  if (axis_ && !stays_whole(room, *axis_, at[*axis_], target.at[*axis_])) axis_.reset();
  const auto largest = [&](bool safely) {
    double most = 1;
    std::optional<std::size_t> axis;
    for (std::size_t i = 0; i < kBoardAxes; ++i)
      if (std::abs(off(i)) > most && (!safely || stays_whole(room, i, at[i], target.at[i])))
        most = std::abs(off(i)), axis = i;
    return axis;
  };
  if (!axis_) axis_ = largest(true);
  if (!axis_) axis_ = largest(false);
  if (!axis_) return std::nullopt;
  return WayToGo{kWords[*axis_][off(*axis_) > 0 ? 0 : 1], std::abs(off(*axis_))};
}

}  // namespace relievo::pipeline
