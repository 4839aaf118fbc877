// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// take_burst(): several pairs in a row, of which the sharpest, stillest one is kept.
//
//   pair --> into the slot that does not hold the best --> better? --> that slot now holds the best
//
// A pair's sharpness is the worse view's, since both are matched; its movement is how much the face has
// changed since the pair before. Sharpness decides, since a face that moves smears; of pairs within a tenth
// of the sharpest the stillest is better. A pair that cannot be had is passed over; without any the last
// error is told. With a lamp the burst waits for its rest, so that five flashes take 1.05 s at the least: a
// person's eyes count more than time. Allocates nothing of its own. Errors: Cancelled, Disconnected before
// the first pair, what StereoGrabber says. Thread: capture.
#pragma once

#include <array>
#include <atomic>
#include <optional>

#include "firmware/capture/face_light.h"
#include "firmware/capture/stereo_grabber.h"
#include "hal/trigger_line.h"
#include "pipeline/model/stereo_frame.h"

namespace relievo::firmware {

inline constexpr int kMostBurstPairs = 16;

struct BurstOptions {
  int pairs = budget::kBurstPairs;  // 1 to kMostBurstPairs
  hal::Light light = hal::Light::Off;
  std::optional<FaceBox> face;  // in both views; none: their middle
};

struct BurstPair {
  double sharpness = 0;  // of the worse view; see FaceLight
  double movement = 0;   // mean change of the face since the pair before, 0 to 1
};

struct BurstResult {
  pipeline::StereoFrame frame;  // its views lie in one of the two slots
  int best = 0;
  std::array<BurstPair, kMostBurstPairs> pairs{};
};

// The face, small: enough to see that it has moved.
struct Thumbnail {
  static constexpr int kWidth = 24;
  static constexpr int kHeight = 32;
  std::array<float, std::size_t{kWidth} * kHeight> level{};
};
// Means of the box's cells, 0 to 1. InvalidInput as face_light().
Result<Thumbnail> thumbnail(const ImageView& view, const FaceBox& box);
// The mean absolute difference.
double movement(const Thumbnail& a, const Thumbnail& b);

// InvalidInput: the number of pairs. The slots are two.
Result<BurstResult> take_burst(StereoGrabber& grabber, StereoSlot& first, StereoSlot& second,
                               const BurstOptions& options, const std::atomic<bool>& cancelled);

}  // namespace relievo::firmware
