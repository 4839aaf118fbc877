// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Windows of both views compared: one with one, anywhere between pixels, and one with many along its row.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "pipeline/base/stage.h"
#include "pipeline/match/image/plane.h"
#include "pipeline/model/match_set.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::pipeline {

// One place of the left view looked for on its row of the right one, for a few places, where the matchers'
// tables would cost more than they save. Candidates are whole disparities, both ends included, a parabola
// goes through the best; sigma_px as in window_matchers.h, cost one minus the correlation. None where no
// window correlates, or the best lies at an end: what is looked for may be beyond. Pixels. Thread: any.
std::optional<Match> match_on_row(const RectifiedPair& pair, Vec2f left_px, double least_px, double most_px,
                                  int radius);

// Zero-mean correlation of one window of the left view with one of the right, both anywhere between pixels
// (bilinear): how alike a match is, for matchers whose own score is none, and for constraints.
// -1 .. 1; 0 where a window is plain, leaves its picture or touches pixels that are not valid.
double window_correlation(const RectifiedPair& pair, Vec2f left_px, Vec2f right_px, int radius);

// One minus the correlation at a match, 0 .. 1.
float window_cost(const RectifiedPair& pair, Vec2f left_px, float disparity_px, int radius);

// Those of `found`, a match or none (sigma_px 0) a keypoint, that are matches. Error: nothing_matches().
Result<MatchSet> matches_of(std::span<const Match> found, const Keypoints& keypoints, StageContext& context);
Error nothing_matches();  // TooFewMatches

// Keypoints matched by a dense field of disparities, for matchers that make one of the whole picture.
struct DisparityField {
  Plane<float> values;  // pixels of the field; kNoDisparity where it is unknown
  Vec2f corner_px{};    // of the field in the left view
  float scale = 1;      // of its pixels to the view's
};

// sigma_px is the fit's between pixels and the field's own scatter. Errors: Cancelled; TooFewMatches.
Result<MatchSet> matches_in_field(const DisparityField& field, const RectifiedPair& pair,
                                  const Keypoints& keypoints, StageContext& context);

// ChannelPlanes: the grey values or the three colours of both views as planes of numbers, centred on
// middle grey (sums of products then lose fewer digits), and where a window is wholly inside its picture.
struct ChannelPlanes {
  ChannelPlanes(std::pmr::memory_resource* memory, int width, int height)
      : left(memory), right(memory), whole_left(memory, width, height), whole_right(memory, width, height) {}
  std::pmr::vector<Plane<float>> left;  // 1 or 3; grey levels minus 128
  std::pmr::vector<Plane<float>> right;
  Plane<std::uint8_t> whole_left;  // 1 where every pixel of the window about this one is valid
  Plane<std::uint8_t> whole_right;
  int radius = 0;
};

// Inclusive; whole pixels. One candidate beyond the volume on both sides, so that its ends have neighbours.
struct CandidateRange {
  int first = 0;
  int last = 0;
  int count() const { return last - first + 1; }
};
CandidateRange disparity_range(const RectifiedPair& pair);

// 1 where the square of 2 radius + 1 pixels about a pixel lies inside the picture and is valid throughout.
Plane<std::uint8_t> whole_windows(const RectifiedPair& pair, const RectifiedView& view, int radius,
                                  StageContext& context);

// `channels` is 1 (grey) or 3 (colours). On context.scratch.
ChannelPlanes make_channel_planes(const RectifiedPair& pair, int channels, int radius, StageContext& context);

enum class WindowScore : std::uint8_t { SquaredDifferences, ZeroMeanCorrelation };

// The scores of one keypoint's window against windows of the right view, in double precision: what the
// sub-pixel fit, the cost and the sigma are read from, and the whole search for scattered keypoints.
//
//   squared differences     S = sum (L - R)^2 over pixels and channels; grey levels squared
//   zero-mean correlation   S = 1 - rho, rho = sum (L - mean L)(R - mean R) / (|L - mean L| |R - mean R|);
//                           every channel has a mean of its own, the sums run over all channels
//
// A keypoint between pixels: both views are sampled bilinearly on the same fraction of a pixel, so the
// candidates stay whole pixels apart and neither view is smoothed more than the other.
class PatchScores {
 public:
  PatchScores(const ChannelPlanes& planes, WindowScore score, int most_candidates,
              std::pmr::memory_resource* memory);

  // Reads the window about `at` and the strip of the right row for disparities first .. first + count - 1.
  // False where the left window leaves its picture.
  bool load(Vec2f at, int first, int count);

  struct Score {
    double unlike;  // S; infinity where the right window leaves its picture
    double cost;    // 0 .. 1: 1 - rho; of squared differences S over the two windows' own variation
  };
  Score score(int candidate) const;

 private:
  const float* left_window(std::size_t channel) const {
    return left_.data() + channel * std::size_t(side_ * side_);
  }
  const float* right_window(std::size_t channel, int candidate) const {
    return strip_.data() + channel * std::size_t(side_ * strip_width_) + (strip_width_ - side_ - candidate);
  }
  bool whole(const Plane<std::uint8_t>& mask, int x) const;
  void sample(const Plane<float>& from, int x0, int width, float* to) const;

  const ChannelPlanes& planes_;
  WindowScore score_;
  int side_;
  int strip_width_ = 0;
  int x_ = 0, y_ = 0, first_ = 0;
  float tx_ = 0, ty_ = 0;
  double left_variation_ = 0;
  std::pmr::vector<float> left_, strip_;
};

// The least sigma of a window this wide on a face before this rig, the method's own `bias`
// (window_matchers.h), pixels.
double method_bias_px(const RectifiedPair& pair, int window_px);

}  // namespace relievo::pipeline
