// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/window/window_correlation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hal/base/simd.h"

namespace relievo::pipeline {
namespace {

constexpr int kPlaneBands = 16;
constexpr float kMiddleGrey = 128;
constexpr double kFitBiasPx = 0.03;     // rms of a parabola's pull to whole pixels, textures of 5 to 20
constexpr double kFaceBend = 1.0 / 40;  // 1/mm: between a cheek and the tip of a nose

void fill_plane(const RectifiedView& view, int channel, int channels, ThreadPool& pool, Plane<float>& to) {
  pool.for_each<std::size_t>(int(to.values.size()), kPlaneBands, [&](std::size_t k) {
    to.values[k] =
        (channels == 1 ? view.grey[k] : float(view.rgb[3 * k + std::size_t(channel)])) - kMiddleGrey;
  });
}

struct RightMoments {
  double sum = 0, squares = 0, cross = 0;
};

// One sum for every column first: independent lanes, added in a fixed order.
RELIEVO_SIMD RightMoments sum_moments(const float* left, const float* right, int side, int stride) {
  double sum[64] = {};
  double squares[64] = {};
  double cross[64] = {};
  for (int j = 0; j < side; ++j, left += side, right += stride)
    for (int i = 0; i < side; ++i) {
      const auto r = double(right[i]);
      sum[i] += r;
      squares[i] += r * r;
      cross[i] += r * double(left[i]);
    }
  RightMoments all;
  for (int i = 0; i < side; ++i) {
    all.sum += sum[i];
    all.squares += squares[i];
    all.cross += cross[i];
  }
  return all;
}

RELIEVO_SIMD double sum_differences(const float* left, const float* right, int side, int stride) {
  double sum[64] = {};
  for (int j = 0; j < side; ++j, left += side, right += stride)
    for (int i = 0; i < side; ++i) {
      const double difference = double(left[i]) - double(right[i]);
      sum[i] += difference * difference;
    }
  double all = 0;
  for (int i = 0; i < side; ++i) all += sum[i];
  return all;
}

}  // namespace

CandidateRange disparity_range(const RectifiedPair& pair) {
  return {int(std::floor(pair.disparity_px(pair.far_mm))) - 1,
          int(std::ceil(pair.disparity_px(pair.near_mm))) + 1};
}

Plane<std::uint8_t> whole_windows(const RectifiedPair& pair, const RectifiedView& view, int radius,
                                  StageContext& context) {
  const int w = pair.width_px;
  const int h = pair.height_px;
  Plane<std::uint8_t> whole(&context.scratch, w, h);
  Arena::Mark mark(context.scratch);
  Plane<int> run(&context.scratch, w, 1);  // valid pixels above and on this row, without a gap
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) run.row(0)[x] = view.valid[pair.index(x, y)] != 0 ? run.row(0)[x] + 1 : 0;
    const int centre = y - radius;
    if (centre < radius) continue;
    int across = 0;
    for (int x = 0; x < w; ++x) {
      across = run.row(0)[x] >= 2 * radius + 1 ? across + 1 : 0;
      if (across >= 2 * radius + 1) whole.row(centre)[x - radius] = 1;
    }
  }
  return whole;
}

ChannelPlanes make_channel_planes(const RectifiedPair& pair, int channels, int radius,
                                  StageContext& context) {
  ChannelPlanes planes(&context.scratch, pair.width_px, pair.height_px);
  planes.radius = radius;
  planes.left.reserve(std::size_t(channels));
  planes.right.reserve(std::size_t(channels));
  for (int c = 0; c < channels; ++c) {
    planes.left.emplace_back(&context.scratch, pair.width_px, pair.height_px);
    fill_plane(pair.left, c, channels, context.pool, planes.left.back());
    planes.right.emplace_back(&context.scratch, pair.width_px, pair.height_px);
    fill_plane(pair.right, c, channels, context.pool, planes.right.back());
  }
  planes.whole_left = whole_windows(pair, pair.left, radius, context);
  planes.whole_right = whole_windows(pair, pair.right, radius, context);
  return planes;
}

PatchScores::PatchScores(const ChannelPlanes& planes, WindowScore score, int most_candidates,
                         std::pmr::memory_resource* memory)
    : planes_(planes),
      score_(score),
      side_(2 * planes.radius + 1),
      left_(planes.left.size() * std::size_t(side_ * side_), 0.0F, memory),
      strip_(planes.left.size() * std::size_t(side_ * (side_ + most_candidates - 1)), 0.0F, memory) {}

bool PatchScores::whole(const Plane<std::uint8_t>& mask, int x) const {
  const int right = x + (tx_ > 0 ? 1 : 0);
  const int below = y_ + (ty_ > 0 ? 1 : 0);
  if (x < 0 || right >= mask.width || y_ < 0 || below >= mask.height) return false;
  return (mask.row(y_)[x] & mask.row(y_)[right] & mask.row(below)[x] & mask.row(below)[right]) != 0;
}

// Rows of the window from column x0 on, at the keypoint's fraction of a pixel. Columns outside the
// picture are repeated; no whole window touches them.
void PatchScores::sample(const Plane<float>& from, int x0, int width, float* to) const {
  for (int j = 0; j < side_; ++j, to += width) {
    const float* upper = from.row(y_ - planes_.radius + j);
    const float* lower = ty_ > 0 ? from.row(y_ - planes_.radius + j + 1) : upper;
    if (tx_ == 0 && ty_ == 0 && x0 >= 0 && x0 + width <= from.width) {
      std::copy(upper + x0, upper + x0 + width, to);
      continue;
    }
    for (int i = 0; i < width; ++i) {
      const int x = std::clamp(x0 + i, 0, from.width - 1);
      if (tx_ == 0 && ty_ == 0) {
        to[i] = upper[x];
        continue;
      }
      const int next = std::min(x + 1, from.width - 1);
      const float top = upper[x] + tx_ * (upper[next] - upper[x]);
      const float low = lower[x] + tx_ * (lower[next] - lower[x]);
      to[i] = top + ty_ * (low - top);
    }
  }
}

bool PatchScores::load(Vec2f at, int first, int count) {
  x_ = int(std::floor(at.x));
  y_ = int(std::floor(at.y));
  tx_ = at.x - float(x_);
  ty_ = at.y - float(y_);
  first_ = first;
  if (!whole(planes_.whole_left, x_)) return false;
  strip_width_ = count - 1 + side_;
  left_variation_ = 0;
  const std::size_t cells = std::size_t(side_ * side_);
  for (std::size_t c = 0; c < planes_.left.size(); ++c) {
    float* patch = left_.data() + c * cells;
    sample(planes_.left[c], x_ - planes_.radius, side_, patch);
    double mean = 0;
    for (std::size_t k = 0; k < cells; ++k) mean += double(patch[k]);
    mean /= double(cells);
    for (std::size_t k = 0; k < cells; ++k)
      left_variation_ += (double(patch[k]) - mean) * (double(patch[k]) - mean);
    if (score_ == WindowScore::ZeroMeanCorrelation)
      for (std::size_t k = 0; k < cells; ++k) patch[k] -= float(mean);
    sample(planes_.right[c], x_ - (first + count - 1) - planes_.radius, strip_width_,
           strip_.data() + c * std::size_t(side_ * strip_width_));
  }
  return true;
}

PatchScores::Score PatchScores::score(int candidate) const {
  if (!whole(planes_.whole_right, x_ - (first_ + candidate)))
    return {std::numeric_limits<double>::infinity(), 1};
  double differences = 0;
  double covariation = 0;
  double right_variation = 0;
  for (std::size_t c = 0; c < planes_.left.size(); ++c) {
    const float *left = left_window(c), *right = right_window(c, candidate);
    const RightMoments m = sum_moments(left, right, side_, strip_width_);
    right_variation += std::max(0.0, m.squares - m.sum * m.sum / (side_ * side_));
    covariation += m.cross;  // the left window has no mean
    if (score_ == WindowScore::SquaredDifferences)
      differences += sum_differences(left, right, side_, strip_width_);
  }
  if (score_ == WindowScore::SquaredDifferences) {
    const double own = left_variation_ + right_variation;
    return {differences, own > 0 ? std::min(1.0, differences / own) : 1};
  }
  const double scale = std::sqrt(left_variation_ * right_variation);
  // Two plain windows are not alike, they say nothing. The least variation is what rounding leaves.
  const double unlike = scale > 1e-3 * side_ * side_ ? 1 - covariation / scale : 1;
  return {unlike, std::clamp(unlike, 0.0, 1.0)};
}

// What a window takes off a surface bent both ways: (w^2 - 1) / 24 times its second derivatives, each of
// which is bend * baseline / focal length.
double method_bias_px(const RectifiedPair& pair, int window_px) {
  const double flattened =
      (window_px * window_px - 1) / 24.0 * 2 * kFaceBend * pair.baseline_mm / pair.focal_px;
  return std::hypot(kFitBiasPx, flattened);
}

}  // namespace relievo::pipeline
