// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A hand that follows the advice of a live calibration: it holds a board before the simulated rig, does
// what it is told a moment later and not quite exactly, sometimes does nothing, and trembles. It goes by
// the words alone, as a person does who hears them. Same seed, same hand.
// Thread: main.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <random>

#include "firmware/calibrate/calibrate_command.h"
#include "hal/picture_file.h"
#include "pipeline/model/live_advice.h"

namespace relievo::firmware {

// The middle of the board in the left camera's frame (mm). Turned by roll about the line of sight
// (clockwise in the picture), then by pitch (upper edge nearer), then by yaw (left edge nearer).
struct HeldPose {
  double right_mm = 0, down_mm = 0, distance_mm = 560;
  double yaw_deg = 0, pitch_deg = 0, roll_deg = 0;
};

struct HandOptions {
  double tremor_mm = 0.1;  // one standard deviation, of each coordinate from pair to pair
  double tremor_deg = 0.02;
  double step_mm = 25;  // from pair to pair, while it is told one direction
  double step_deg = 6;
  double dreams = 0.1;  // share of the pairs in which it does nothing
};

class AdvisedHand {
 public:
  AdvisedHand(const HandOptions& options, std::uint32_t seed) : options_(options), random_(seed) {}

  // The pose at the next pair, after hearing `advice` and how far it is (LiveState::how_far).
  HeldPose follow(pipeline::LiveAdvice advice, double how_far);
  const HeldPose& pose() const { return pose_; }

 private:
  void obey(pipeline::LiveAdvice told, double mm, double deg);
  void step(double HeldPose::*axis, double by);
  void go_home();
  void tremble();
  double normal(double sigma);

  HandOptions options_;
  std::mt19937 random_;
  HeldPose held_;  // without the tremor
  HeldPose pose_;
  pipeline::LiveAdvice heard_ = pipeline::LiveAdvice::HoldStill;  // the pair before
  double heard_far_ = 0;
  double HeldPose::*axis_ = nullptr;  // that it moves along
  double last_step_ = 0;
};

// Photographs a board where a hand holds it: moving from `opened` to `closed` while the shutter is open.
struct HeldPair {
  hal::Picture left;
  hal::Picture right;
};
using HeldBoard =
    std::function<HeldPair(const HeldPose& opened, const HeldPose& closed, std::uint64_t number)>;

// Ten pairs a second, 4 ms of light each; gives up after ten minutes of them.
std::unique_ptr<LivePairs> make_hand_pairs(HeldBoard board, std::uint32_t seed);

}  // namespace relievo::firmware
