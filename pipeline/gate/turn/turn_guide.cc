// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/gate/turn/turn_guide.h"

#include <cmath>

namespace relievo::pipeline {
namespace {

constexpr int kSlowPictures = 2;
// A tracked head at rest wanders by tenths of a millimetre from picture to picture: of two that follow at
// once nothing can be told.
constexpr double kShortestS = 0.04, kWanderMm = 0.35;
constexpr double kHeardAfterS = 0.6,
                 kCalmDegS = 12;  // until a person does what they were told; slow enough to stop
constexpr double kClearlyDeg = 6;

// The one that is least far to turn to. The one that was asked for stays until another is clearly nearer:
// between two as far the advice would change with every picture.
std::size_t next_side(double yaw_deg, const TurnHistory& history) {
  const auto far = [&](std::size_t i) { return std::abs(kSidesDeg[i] - yaw_deg); };
  std::size_t nearest = kSides;
  for (std::size_t i = 0; i < kSides; ++i)
    if (!history.taken[i] && (nearest == kSides || far(i) < far(nearest))) nearest = i;
  const std::size_t asked = history.asked.value_or(nearest);
  return history.taken[asked] || far(nearest) + kClearlyDeg < far(asked) ? nearest : asked;
}

}  // namespace

TurnAnswer guide_turn(const FrontFace& front, const HeadTurn& now, std::chrono::nanoseconds at,
                      double slow_mm_s, const TurnLimits& limits, TurnHistory& history) {
  if (history.taken.all()) return {TurnAdvice::Done, {}};
  const HeadTurn before = history.last;
  const double seconds = std::chrono::duration<double>(at - history.last_at).count();
  if (!now.known || !before.known || seconds >= kShortestS) history.last = now, history.last_at = at;
  if (!now.known) {
    history.slow = 0;
    return {};
  }
  history.asked = next_side(now.yaw_deg, history);
  const double off = kSidesDeg[*history.asked] - now.yaw_deg;
  const bool there = std::abs(off) <= limits.reach_deg;
  const bool level =
      std::abs(now.pitch_deg) <= limits.level_deg && std::abs(now.roll_deg) <= limits.level_deg;
  if (before.known && seconds < kShortestS) return {there ? TurnAdvice::Hold : TurnAdvice::Lost, {}};
  const bool slow = before.known && moved_mm(front, before, now) - kWanderMm <= slow_mm_s * seconds;
  history.slow = there && level && slow ? history.slow + 1 : 0;
  if (!level) return {TurnAdvice::Level, {}};
  if (!there) {
    // Who is told only when they are there is past it before they have heard.
    const double coming_deg_s =
        before.known ? (now.yaw_deg - before.yaw_deg) / seconds * (off > 0 ? 1 : -1) : 0;
    const bool past_soon =
        coming_deg_s * kHeardAfterS > std::abs(off) - limits.reach_deg && coming_deg_s > kCalmDegS;
    return {past_soon ? TurnAdvice::Slower : off > 0 ? TurnAdvice::ToRight : TurnAdvice::ToLeft, {}};
  }
  if (history.slow >= kSlowPictures) return {TurnAdvice::Hold, history.asked};
  return {slow || !before.known ? TurnAdvice::Hold : TurnAdvice::Slower, {}};
}

}  // namespace relievo::pipeline
