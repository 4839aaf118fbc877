// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/live/view_target.h"

#include <algorithm>
#include <cmath>
#include <functional>

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

struct Step {
  std::size_t axis;
  double off;  // tolerances
};

LiveAdvice word_of(const Step& step) { return kWords[step.axis][step.off > 0 ? 0 : 1]; }

// Of all axes that are not near enough, the farthest first.
std::vector<Step> steps_towards(const ViewTarget& target, const BoardParameters& now) {
  const auto at = axes_of(now);
  std::vector<Step> steps;
  for (std::size_t i = 0; i < kBoardAxes; ++i)
    if (const double off = (target.at[i] - at[i]) / target.tolerance[i]; std::abs(off) > 1)
      steps.push_back({i, off});
  std::ranges::stable_sort(steps, std::greater{}, [](const Step& step) { return std::abs(step.off); });
  return steps;
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
  std::vector<LiveAdvice> words;
  for (const Step& step : steps_towards(target, now)) words.push_back(word_of(step));
  return words;
}

std::optional<WayToGo> Guide::towards(const ViewTarget& target, const BoardParameters& now,
                                      const Room& room) {
  const auto at = axes_of(now);
  const std::vector<Step> steps = steps_towards(target, now);
  const auto safe = [&](const Step& step) {
    return stays_whole(room, step.axis, at[step.axis], target.at[step.axis]);
  };
  auto next = std::ranges::find_if(steps, [&](const Step& step) { return step.axis == axis_ && safe(step); });
  if (next == steps.end()) next = std::ranges::find_if(steps, safe);
  axis_.reset();
  if (steps.empty()) return std::nullopt;
  if (next == steps.end()) next = steps.begin();
  axis_ = next->axis;
  return WayToGo{word_of(*next), std::abs(next->off)};
}

}  // namespace relievo::pipeline
