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

// The one that is least far to turn to; of two as far the first.
std::optional<std::size_t> next_side(double yaw_deg, const std::bitset<kSides>& taken) {
  std::optional<std::size_t> next;
  for (std::size_t i = 0; i < kSides; ++i) {
    if (taken[i]) continue;
    if (!next || std::abs(kSidesDeg[i] - yaw_deg) < std::abs(kSidesDeg[*next] - yaw_deg)) next = i;
  }
  return next;
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
  const auto side = next_side(now.yaw_deg, history.taken);
  const double off = kSidesDeg[*side] - now.yaw_deg;
  const bool there = std::abs(off) <= limits.reach_deg;
  const bool level =
      std::abs(now.pitch_deg) <= limits.level_deg && std::abs(now.roll_deg) <= limits.level_deg;
  if (before.known && seconds < kShortestS) return {there ? TurnAdvice::Hold : TurnAdvice::Lost, {}};
  const bool slow = before.known && moved_mm(front, before, now) - kWanderMm <= slow_mm_s * seconds;
  history.slow = there && level && slow ? history.slow + 1 : 0;
  if (!level) return {TurnAdvice::Level, {}};
  if (!there) return {off > 0 ? TurnAdvice::ToRight : TurnAdvice::ToLeft, {}};
  if (history.slow >= kSlowPictures) return {TurnAdvice::Hold, side};
  return {slow || !before.known ? TurnAdvice::Hold : TurnAdvice::Slower, {}};
}

}  // namespace relievo::pipeline
