// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/live/live_advice.h"

#include <algorithm>

namespace relievo::pipeline {

const char* name_of(LiveAdvice advice) {
  switch (advice) {
    case LiveAdvice::ShowBoard:
      return "show the board";
    case LiveAdvice::LeftCameraMissesIt:
      return "the left camera does not see it whole";
    case LiveAdvice::RightCameraMissesIt:
      return "the right camera does not see it whole";
    case LiveAdvice::HoldStill:
      return "hold still";
    case LiveAdvice::TooBlurred:
      return "too blurred";
    case LiveAdvice::Closer:
      return "closer";
    case LiveAdvice::Farther:
      return "farther";
    case LiveAdvice::Left:
      return "left";
    case LiveAdvice::Right:
      return "right";
    case LiveAdvice::Up:
      return "up";
    case LiveAdvice::Down:
      return "down";
    case LiveAdvice::TiltLeft:
      return "tilt left";
    case LiveAdvice::TiltRight:
      return "tilt right";
    case LiveAdvice::TiltForward:
      return "tilt forward";
    case LiveAdvice::TiltBack:
      return "tilt back";
    case LiveAdvice::TurnClockwise:
      return "turn clockwise";
    case LiveAdvice::TurnCounterclockwise:
      return "turn counterclockwise";
    case LiveAdvice::AlreadyHave:
      return "already have this view";
    case LiveAdvice::SwappedCameras:
      return "exchange the cameras";
    case LiveAdvice::Done:
      return "done";
  }
  return "";
}

std::string words_of(std::span<const LiveAdvice> way) {
  const auto holds = [&](LiveAdvice one) { return std::find(way.begin(), way.end(), one) != way.end(); };
  const bool upper = holds(LiveAdvice::Up);
  const bool left = holds(LiveAdvice::Left);
  const bool corner = (upper || holds(LiveAdvice::Down)) && (left || holds(LiveAdvice::Right));
  bool corner_said = false;
  std::string words;
  for (const LiveAdvice one : way) {
    const bool aside = one == LiveAdvice::Left || one == LiveAdvice::Right || one == LiveAdvice::Up ||
                       one == LiveAdvice::Down;
    if (aside && corner && corner_said) continue;
    if (!words.empty()) words += ", ";
    if (aside && corner) words += std::string(upper ? "upper " : "lower ") + (left ? "left" : "right");
    else words += name_of(one);
    corner_said = corner_said || aside;
  }
  return words;
}

const char* name_of(PairVerdict verdict) {
  switch (verdict) {
    case PairVerdict::Taken:
      return "taken";
    case PairVerdict::NoBoard:
      return "no board";
    case PairVerdict::LeftMissesIt:
      return "not whole in left";
    case PairVerdict::RightMissesIt:
      return "not whole in right";
    case PairVerdict::Moving:
      return "moving";
    case PairVerdict::Blurred:
      return "blurred";
    case PairVerdict::AlreadyHave:
      return "already have";
    case PairVerdict::Swapped:
      return "cameras swapped";
    case PairVerdict::Finished:
      return "finished";
  }
  return "";
}

const char* name_of(LiveEnd end) {
  switch (end) {
    case LiveEnd::NotYet:
      return "not yet";
    case LiveEnd::GoalReached:
      return "goal reached";
    case LiveEnd::Plateau:
      return "more views would not help";
    case LiveEnd::Full:
      return "as many views as allowed";
  }
  return "";
}

}  // namespace relievo::pipeline
