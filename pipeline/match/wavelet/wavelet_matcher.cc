// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/wavelet/wavelet_matcher.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "pipeline/match/window/window_correlation.h"

namespace relievo::pipeline {
namespace {

constexpr int kBands = 16;

void differ(const Plane<float>& from, int hole, ThreadPool& pool, Plane<Vec2f>& to) {
  const int w = from.width;
  const int h = from.height;
  pool.for_each(h, kBands, [&](int y) {
    const float* row = from.row(y);
    const float* above = from.row(std::max(0, y - hole));
    const float* below = from.row(std::min(h - 1, y + hole));
    Vec2f* out = to.row(y);
    for (int x = 0; x < w; ++x)
      out[x] = {0.5F * (row[std::min(w - 1, x + hole)] - row[std::max(0, x - hole)]),
                0.5F * (below[x] - above[x])};
  });
}

void smooth(const Plane<float>& from, int hole, ThreadPool& pool, Plane<float>& across, Plane<float>& to) {
  const int w = from.width;
  const int h = from.height;
  constexpr float kWeight[5] = {1.0F / 16, 4.0F / 16, 6.0F / 16, 4.0F / 16, 1.0F / 16};
  pool.for_each(h, kBands, [&](int y) {
    const float* row = from.row(y);
    float* out = across.row(y);
    for (int x = 0; x < w; ++x) {
      float sum = 0;
      for (int k = -2; k <= 2; ++k) sum += kWeight[k + 2] * row[std::clamp(x + k * hole, 0, w - 1)];
      out[x] = sum;
    }
  });
  pool.for_each(h, kBands, [&](int y) {
    float* out = to.row(y);
    std::fill(out, out + w, 0.0F);
    for (int k = -2; k <= 2; ++k) {
      const float* row = across.row(std::clamp(y + k * hole, 0, h - 1));
      for (int x = 0; x < w; ++x) out[x] += kWeight[k + 2] * row[x];
    }
  });
}

constexpr int kPlaceBands = 32;
using Most = WaveletMatcher;
constexpr int kMostSamples = (2 * Most::kMostRadius + 1) * (2 * Most::kMostRadius + 1);
constexpr int kStacked = 2;  // scales that make the last comparison

using Scales = std::pmr::vector<Plane<Vec2f>>;

struct Agreement {
  double together = 0;  // sum of W_L . W_R
  double left = 0;      // energies
  double right = 0;
  double correlation() const {
    const double scale = std::sqrt(left * right);
    return scale > 1e-6 ? together / scale : 0;
  }
};

// One keypoint's description at every scale, and what it has in common with the right view.
class Place {
 public:
  Place(const Scales& left, const Scales& right, int radius) : left_(left), right_(right), radius_(radius) {}

  void look_at(Vec2f at) {
    x_ = int(std::floor(at.x));
    y_ = int(std::floor(at.y));
    tx_ = at.x - float(x_);
    ty_ = at.y - float(y_);
    for (std::size_t s = 0; s < left_.size(); ++s) {
      std::size_t k = 0;
      energy_[s] = 0;
      for (int j = -radius_; j <= radius_; ++j)
        for (int i = -radius_; i <= radius_; ++i, ++k) {
          const Vec2f c = sample(left_[s], x_ + (i << s), y_ + (j << s));
          patch_[s][k] = c;
          energy_[s] += double(c.x * c.x + c.y * c.y);
        }
    }
  }

  // At scale index s (0: the finest) and a whole disparity.
  Agreement compare(std::size_t s, int disparity) const {
    Agreement all;
    all.left = energy_[s];
    std::size_t k = 0;
    const Plane<Vec2f>& from = right_[s];
    const int reach = radius_ << s;
    const int x = x_ - disparity;
    const bool plain = tx_ == 0 && ty_ == 0 && x >= reach && x + reach < from.width && y_ >= reach &&
                       y_ + reach < from.height;
    for (int j = -radius_; j <= radius_; ++j) {
      float together = 0;
      float right = 0;
      const Vec2f* row = plain ? from.row(y_ + (j << s)) + x - reach : nullptr;
      for (int i = 0; i <= 2 * radius_; ++i, ++k) {
        const Vec2f c = plain ? row[i << s] : sample(from, x - reach + (i << s), y_ + (j << s));
        together += c.x * patch_[s][k].x + c.y * patch_[s][k].y;
        right += c.x * c.x + c.y * c.y;
      }
      all.together += double(together);
      all.right += double(right);
    }
    return all;
  }

  double stacked(int disparity) const {
    Agreement all;
    for (std::size_t s = 0; s < kStacked; ++s) {
      const Agreement one = compare(s, disparity);
      all.together += one.together;
      all.left += one.left;
      all.right += one.right;
    }
    return all.correlation();
  }

 private:
  Vec2f sample(const Plane<Vec2f>& from, int x, int y) const {
    const int x0 = std::clamp(x, 0, from.width - 1);
    const Vec2f* upper = from.row(std::clamp(y, 0, from.height - 1));
    if (tx_ == 0 && ty_ == 0) return upper[x0];
    const int x1 = std::clamp(x + 1, 0, from.width - 1);
    const Vec2f* lower = from.row(std::clamp(y + 1, 0, from.height - 1));
    const auto mix = [&](float a, float b, float c, float d) {
      const float top = a + tx_ * (b - a);
      return top + ty_ * (c + tx_ * (d - c) - top);
    };
    return {mix(upper[x0].x, upper[x1].x, lower[x0].x, lower[x1].x),
            mix(upper[x0].y, upper[x1].y, lower[x0].y, lower[x1].y)};
  }

  const Scales& left_;
  const Scales& right_;
  int radius_;
  int x_ = 0, y_ = 0;
  float tx_ = 0, ty_ = 0;
  std::array<double, Most::kMostScales> energy_{};
  std::array<std::array<Vec2f, kMostSamples>, Most::kMostScales> patch_{};
};

struct Candidate {
  int disparity = 0;
  double latest = 0;  // correlation at the last scale
  double sum = 0;     // over the scales so far
};

struct Candidates {
  std::array<Candidate, Most::kMostCandidates> best{};
  int count = 0;
  // In falling order; the worst falls out.
  void offer(const Candidate& one, int most) {
    int at = count < most ? count++ : most;
    if (at == most && !(one.latest > best[std::size_t(most - 1)].latest)) return;
    at = std::min(at, most - 1);
    for (; at > 0 && best[std::size_t(at - 1)].latest < one.latest; --at)
      best[std::size_t(at)] = best[std::size_t(at - 1)];
    best[std::size_t(at)] = one;
  }
};

Candidates search_coarsest(const Place& place, const CandidateRange& range, std::size_t scale, int most) {
  Candidates found;
  const int step = std::max(1, 1 << scale >> 1);
  double before = -2;
  double here = place.compare(scale, range.first).correlation();
  for (int d = range.first; d <= range.last; d += step) {
    const double after = d + step <= range.last ? place.compare(scale, d + step).correlation() : -2;
    if (here >= before && here > after) found.offer({d, here, here}, most);
    before = here;
    here = after;
  }
  return found;
}

void refine(const Place& place, const CandidateRange& range, std::size_t scale, Candidate& candidate) {
  const int step = std::max(1, 1 << scale >> 1);
  const int middle = candidate.disparity;
  candidate.latest = -2;
  for (int k = -2; k <= 2; ++k) {
    const int d = std::clamp(middle + k * step, range.first, range.last);
    const double rho = place.compare(scale, d).correlation();
    if (rho > candidate.latest) {
      candidate.latest = rho;
      candidate.disparity = d;
    }
  }
  candidate.sum += candidate.latest;
}

// Its sigma_px is 0 where there is no match.
Match fit(const Place& place, Vec2f at, const CandidateRange& range, int d, double samples, double bias) {
  double here = place.stacked(d);
  double before = place.stacked(d - 1);
  double after = place.stacked(d + 1);
  for (int step = 0; step < 3 && (before > here || after > here); ++step) {
    const int way = before > after ? -1 : 1;
    d += way;
    const double next = way < 0 ? before : after;
    (way < 0 ? after : before) = here;
    here = next;
    (way < 0 ? before : after) = place.stacked(d + way);
  }
  const double bend = 2 * here - before - after;
  if (!(bend > 0) || before > here || after > here || d <= range.first || d >= range.last) return {};
  const double tilt = after - before;
  const double least = std::max(1 - here - tilt * tilt / (8 * bend), 1e-6 * bend);
  return {at, float(d + tilt / (2 * bend)), float(std::clamp(1 - here, 0.0, 1.0)),
          float(std::sqrt(2 * least / (samples * bend) + bias * bias)), 0};
}

Match match_place(Place& place, Vec2f at, const CandidateRange& range, const WaveletMatcher& options,
                  double bias) {
  place.look_at(at);
  const auto coarsest = std::size_t(options.scales - 1);
  Candidates candidates = search_coarsest(place, range, coarsest, options.candidates);
  const Candidate* winner = nullptr;
  for (int c = 0; c < candidates.count; ++c) {
    Candidate& candidate = candidates.best[std::size_t(c)];
    for (std::size_t s = coarsest; s-- > 0;) refine(place, range, s, candidate);
    if (winner == nullptr || candidate.sum > winner->sum) winner = &candidate;
  }
  if (winner == nullptr || winner->sum < double(options.min_score) * options.scales) return {};
  const double side = 2 * options.radius + 1;
  return fit(place, at, range, winner->disparity, side * side, bias);
}

}  // namespace

std::pmr::vector<Plane<Vec2f>> transform_dyadic(const std::pmr::vector<float>& grey, int width, int height,
                                                int scales, StageContext& context) {
  std::pmr::vector<Plane<Vec2f>> all(&context.scratch);
  all.reserve(std::size_t(scales));
  for (int j = 0; j < scales; ++j) all.emplace_back(&context.scratch, width, height);
  Arena::Mark mark(context.scratch);
  Plane<float> now(&context.scratch, width, height);
  std::ranges::copy(grey, now.values.begin());
  Plane<float> across(&context.scratch, width, height);
  Plane<float> next(&context.scratch, width, height);
  for (int j = 0; j < scales && !context.stop(); ++j) {
    const int hole = 1 << j;
    differ(now, hole, context.pool, all[std::size_t(j)]);
    if (j + 1 == scales) break;
    smooth(now, hole, context.pool, across, next);
    std::swap(now.values, next.values);
  }
  return all;
}

Result<MatchSet> WaveletMatcher::match(const RectifiedPair& pair, const Keypoints& keypoints,
                                       StageContext& context) const {
  RELIEVO_TRY(check_pixels(pair));
  const Scales left = transform_dyadic(pair.left.grey, pair.width_px, pair.height_px, scales, context);
  const Scales right = transform_dyadic(pair.right.grey, pair.width_px, pair.height_px, scales, context);
  // The finest samples and their filters lie inside both pictures; coarser ones may reach over the edge.
  const int reach = radius + 1;
  const Plane<std::uint8_t> whole_left = whole_windows(pair, pair.left, reach, context);
  const Plane<std::uint8_t> whole_right = whole_windows(pair, pair.right, reach, context);
  const CandidateRange range = disparity_range(pair);
  const double bias = method_bias_px(pair, 2 * (2 * radius + 1));
  std::pmr::vector<Match> found(keypoints.points.size(), Match{}, &context.scratch);
  context.progress.done.store(0.1F, std::memory_order_relaxed);
  const auto inside = [](const Plane<std::uint8_t>& whole, float x, float y) {
    const auto i = int(std::lround(x));
    const auto j = int(std::lround(y));
    return i >= 0 && j >= 0 && i < whole.width && j < whole.height && whole.row(j)[i] != 0;
  };
  context.pool.for_each_band(int(found.size()), kPlaceBands, [&](int begin, int end, int) {
    Place place(left, right, radius);
    for (int k = begin; k < end && !context.stop(); ++k) {
      const Vec2f at = keypoints.points[std::size_t(k)].at_px;
      if (!inside(whole_left, at.x, at.y)) continue;
      const Match match = match_place(place, at, range, *this, bias);
      if (match.sigma_px <= sigma_limit_px && inside(whole_right, at.x - match.disparity_px, at.y))
        found[std::size_t(k)] = match;
    }
  });
  if (context.stop()) return stopped();
  return matches_of(found, keypoints, context);
}

}  // namespace relievo::pipeline
