// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/demo/hand_pairs.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <utility>

namespace relievo::firmware {
namespace {

constexpr double kSmallestShare = 0.15;  // of a step, when it was told to go back again and again
constexpr double kCaution = 0.3;         // of its usual step where it is told that little is missing
constexpr double kHomeShare = 0.2;       // of the way back to the middle, from pair to pair
constexpr double kMostTiltDeg = 55;      // no wrist turns a board farther
constexpr double kNearestMm = 200;
constexpr double kFarthestMm = 1200;
constexpr std::chrono::milliseconds kPeriod{100};  // of the pairs
constexpr double kOpenShare = 0.04;                // of the period the shutter is open
constexpr int kMostHandPairs = 6000;

constexpr std::size_t kLengths = 3;  // of the axes; behind them come the angles
constexpr std::array kAxes{&HeldPose::right_mm, &HeldPose::down_mm,   &HeldPose::distance_mm,
                           &HeldPose::yaw_deg,  &HeldPose::pitch_deg, &HeldPose::roll_deg};

class HandBeforeRig final : public LivePairs {
 public:
  HandBeforeRig(HeldBoard board, std::uint32_t seed) : board_(std::move(board)), hand_({}, seed) {}

  Result<std::optional<LivePair>> next(const pipeline::LiveState& state) override {
    if (count_ == kMostHandPairs) return std::optional<LivePair>();
    const HeldPose before = hand_.pose();
    const HeldPose now = hand_.follow(state.advice, state.how_far);
    held_ = board_(now, onward(before, now), std::uint64_t(++count_));
    return std::optional<LivePair>({held_.left.view(), held_.right.view(), count_ * kPeriod});
  }

 private:
  // Where the hand is when the shutter closes, if it goes on as it came.
  static HeldPose onward(const HeldPose& before, const HeldPose& now) {
    HeldPose pose = now;
    for (const auto axis : kAxes) pose.*axis += kOpenShare * (now.*axis - before.*axis);
    return pose;
  }

  HeldBoard board_;
  AdvisedHand hand_;
  HeldPair held_;
  int count_ = 0;
};

}  // namespace

// Box and Muller's, since the library's differs between machines.
double AdvisedHand::normal(double sigma) {
  const double u = (double(random_()) + 1) / 4294967297.0;
  const double v = double(random_()) / 4294967296.0;
  return sigma * std::sqrt(-2 * std::log(u)) * std::cos(6.283185307179586 * v);
}

// Told to go back the way it came, it takes smaller steps.
void AdvisedHand::step(double HeldPose::*axis, double by) {
  if (axis == axis_ && by * last_step_ < 0)
    by = std::copysign(std::max(std::abs(last_step_) / 2, kSmallestShare * std::abs(by)), by);
  else if (axis == axis_) by = std::copysign(std::min(std::abs(by), 1.3 * std::abs(last_step_)), by);
  axis_ = axis;
  last_step_ = by;
  held_.*axis += by * (1 + normal(0.15));
}

void AdvisedHand::go_home() {
  const HeldPose home;
  for (const auto axis : kAxes) held_.*axis += kHomeShare * (home.*axis - held_.*axis);
  axis_ = nullptr;
}

void AdvisedHand::tremble() {
  pose_ = held_;
  for (std::size_t i = 0; i < kAxes.size(); ++i)
    pose_.*kAxes[i] += normal(i < kLengths ? options_.tremor_mm : options_.tremor_deg);
}

void AdvisedHand::obey(pipeline::LiveAdvice told, double mm, double deg) {
  using enum pipeline::LiveAdvice;
  if (told == ShowBoard || told == LeftCameraMissesIt || told == RightCameraMissesIt) return go_home();
  const struct {
    pipeline::LiveAdvice advice;
    double HeldPose::*axis;
    double by;
  } moves[] = {
      {Left, &HeldPose::right_mm, -mm},
      {Right, &HeldPose::right_mm, mm},
      {Up, &HeldPose::down_mm, -mm},
      {Down, &HeldPose::down_mm, mm},
      {Closer, &HeldPose::distance_mm, -mm},
      {Farther, &HeldPose::distance_mm, mm},
      {TiltLeft, &HeldPose::yaw_deg, deg},
      {TiltRight, &HeldPose::yaw_deg, -deg},
      {TiltForward, &HeldPose::pitch_deg, deg},
      {TiltBack, &HeldPose::pitch_deg, -deg},
      {TurnClockwise, &HeldPose::roll_deg, deg},
      {TurnCounterclockwise, &HeldPose::roll_deg, -deg},
  };
  // What is not among them needs no move: the hand holds still.
  for (const auto& move : moves)
    if (move.advice == told) step(move.axis, move.by);
}

HeldPose AdvisedHand::follow(pipeline::LiveAdvice advice, double how_far) {
  const bool dreams = double(random_()) / 4294967296.0 < options_.dreams;
  const auto told = std::exchange(heard_, advice);
  const double share = std::min(1.0, kCaution * std::exchange(heard_far_, how_far));
  if (!dreams) obey(told, share * options_.step_mm, share * options_.step_deg);
  held_.distance_mm = std::clamp(held_.distance_mm, kNearestMm, kFarthestMm);
  held_.yaw_deg = std::clamp(held_.yaw_deg, -kMostTiltDeg, kMostTiltDeg);
  held_.pitch_deg = std::clamp(held_.pitch_deg, -kMostTiltDeg, kMostTiltDeg);
  tremble();
  return pose_;
}

std::unique_ptr<LivePairs> make_hand_pairs(HeldBoard board, std::uint32_t seed) {
  return std::make_unique<HandBeforeRig>(std::move(board), seed);
}

}  // namespace relievo::firmware
