// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/window/window_matching.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "hal/base/simd.h"
#include "pipeline/match/window/patch_scores.h"

namespace relievo::pipeline {
namespace {

// LatticeSearch: the best whole disparity of every node of a lattice over the whole volume. The windows'
// sums run down the columns and are joined across (McDonnell 1981; Faugeras et al. 1993, INRIA RR-2013),
// one disparity after the other, so that the cost does not depend on the window and the memory does not
// depend on the range: a few rows a band, one score and one disparity a pixel of a lattice row.
// Sums are single precision, started afresh every band: a search, not the last word (patch_scores.h).
// Parallel in bands of lattice rows; results do not depend on the number of threads.
struct LatticeRows {
  int first_px = 0;
  int step_px = 1;
  int count = 0;
};

inline constexpr int kNoCandidate = -1'000'000;

constexpr int kRowsPerBand = 16;
constexpr float kUnfit = 1e30F;  // a window that leaves its picture
constexpr float kNothingYet = 1e29F;

RELIEVO_SIMD void add_products(const float* l, const float* r, int n, float sign, float* to) {
  for (int x = 0; x < n; ++x) to[x] += sign * l[x] * r[x];
}
RELIEVO_SIMD void add_squares(const float* l, const float* r, int n, float sign, float* to) {
  for (int x = 0; x < n; ++x) to[x] += sign * ((l[x] - r[x]) * (l[x] - r[x]));
}
RELIEVO_SIMD void add_shifted(const float* __restrict from, int n, float* __restrict to) {
  for (int x = 0; x < n; ++x) to[x] += from[x];
}
RELIEVO_SIMD void pair_up(const float* __restrict from, int gap, int n, float* __restrict to) {
  for (int x = 0; x < n; ++x) to[x] = from[x] + from[x + gap];
}
RELIEVO_SIMD void take_means(const float* __restrict left, const float* __restrict right, int n,
                             float* __restrict sum) {
  for (int x = 0; x < n; ++x) sum[x] -= left[x] * right[x];
}
RELIEVO_SIMD void keep_least(const float* __restrict sum, const float* __restrict unfit, int n, int d,
                             float* __restrict least, int* __restrict at) {
  for (int x = 0; x < n; ++x) {
    const float s = sum[x] + unfit[x];
    at[x] = s < least[x] ? d : at[x];
    least[x] = s < least[x] ? s : least[x];
  }
}
RELIEVO_SIMD void keep_most_alike(const float* __restrict sum, const float* __restrict inverse, int n, int d,
                                  float* __restrict least, int* __restrict at) {
  for (int x = 0; x < n; ++x) {
    const float s = -sum[x] * inverse[x];
    at[x] = s < least[x] ? d : at[x];
    least[x] = s < least[x] ? s : least[x];
  }
}

// to[x] = from[x] + ... + from[x + side - 1], by sums of 1, 2, 4, ... values: nothing runs along the row.
void join_across(float* from, float* spare, int side, int n, float* to) {
  std::fill(to, to + n, 0.0F);
  int offset = 0;
  for (int size = 1, known = n + side - 1; size <= side; size *= 2) {
    if ((side & size) != 0) {
      add_shifted(from + offset, n, to);
      offset += size;
    }
    if (2 * size > side) break;
    known -= size;
    pair_up(from, size, known, spare);
    std::swap(from, spare);
  }
}

// What is known of every window of a lattice row before any disparity is tried.
struct RowFacts {
  std::pmr::vector<Plane<float>> left_mean;  // times the window's pixels; a channel each
  std::pmr::vector<Plane<float>> right_mean;
  Plane<float> right_scale;  // 1 / root of the variation; of squared differences kUnfit or 0
};

class Search {
 public:
  Search(const ChannelPlanes& planes, WindowScore score, const LatticeRows& rows, StageContext& context,
         Plane<int>& best)
      : planes_(planes),
        score_(score),
        rows_(rows),
        side_(2 * planes.radius + 1),
        width_(best.width),
        bands_((rows.count + kRowsPerBand - 1) / kRowsPerBand),
        best_(best),
        least_(&context.scratch, width_, rows.count, start()),
        facts_{std::pmr::vector<Plane<float>>(&context.scratch),
               std::pmr::vector<Plane<float>>(&context.scratch),
               Plane<float>(&context.scratch, width_, rows.count)},
        work_(&context.scratch, 4 * width_, bands_),
        moments_(&context.scratch, 3 * width_, bands_) {
    if (score != WindowScore::ZeroMeanCorrelation) return;
    for (auto* means : {&facts_.left_mean, &facts_.right_mean}) {
      means->reserve(planes.left.size());
      for (std::size_t c = 0; c < planes.left.size(); ++c)
        means->emplace_back(&context.scratch, width_, rows.count);
    }
  }

  void run(const CandidateRange& range, StageContext& context) {
    context.pool.for_each_band(rows_.count, bands_, [&](int begin, int end, int band) {
      for (int row = begin; row < end; ++row) {
        if (context.stop()) return;
        learn_row(row, moments_.row(band));
      }
      for (int d = range.first; d <= range.last; ++d) {
        if (context.stop()) return;
        try_disparity(d, begin, end, work_.row(band));
      }
    });
  }

 private:
  float start() const { return score_ == WindowScore::ZeroMeanCorrelation ? 0.0F : kNothingYet; }
  int y_of(int row) const { return rows_.first_px + row * rows_.step_px; }

  // Only windows that lie inside are ever asked for; the others keep what excludes them.
  void learn_row(int row, double* columns) {
    const int y = y_of(row);
    float* scale = facts_.right_scale.row(row);
    const bool correlation = score_ == WindowScore::ZeroMeanCorrelation;
    const std::uint8_t* whole = planes_.whole_right.row(y);
    for (int x = 0; x < width_; ++x) scale[x] = correlation || whole[x] != 0 ? 0.0F : kUnfit;
    if (!correlation || y < planes_.radius || y + planes_.radius >= planes_.whole_left.height) return;
    const double pixels = side_ * side_;
    for (std::size_t c = 0; c < planes_.left.size(); ++c) {
      sum_columns(c, y, columns);
      double left = 0, right = 0, squares = 0;
      for (int x = 0; x < width_; ++x) {
        const double* in = columns + 3 * x;
        const double* out = in - 3 * side_;
        const bool full = x >= side_;
        left += in[0] - (full ? out[0] : 0);
        right += in[1] - (full ? out[1] : 0);
        squares += in[2] - (full ? out[2] : 0);
        if (x < side_ - 1) continue;
        const int centre = x - planes_.radius;
        facts_.left_mean[c].row(row)[centre] = float(left);
        facts_.right_mean[c].row(row)[centre] = float(right / pixels);
        scale[centre] += float(squares - right * right / pixels);
      }
    }
    for (int x = 0; x < width_; ++x)
      scale[x] = whole[x] != 0 && scale[x] > 1e-3F * float(pixels) ? 1 / std::sqrt(scale[x]) : 0.0F;
  }

  // Of the window's rows about y: left, right and squared right, a column each.
  void sum_columns(std::size_t c, int y, double* columns) const {
    std::fill(columns, columns + 3 * width_, 0.0);
    for (int j = -planes_.radius; j <= planes_.radius; ++j) {
      const float* l = planes_.left[c].row(y + j);
      const float* r = planes_.right[c].row(y + j);
      for (int x = 0; x < width_; ++x) {
        const auto value = double(r[x]);
        columns[3 * x] += double(l[x]);
        columns[3 * x + 1] += value;
        columns[3 * x + 2] += value * value;
      }
    }
  }

  void add_row(int y, int d, int begin, int end, float sign, float* columns) const {
    if (y < 0 || y >= planes_.whole_left.height) return;
    for (std::size_t c = 0; c < planes_.left.size(); ++c) {
      const float* l = planes_.left[c].row(y) + begin;
      const float* r = planes_.right[c].row(y) + begin - d;
      (score_ == WindowScore::ZeroMeanCorrelation ? add_products : add_squares)(l, r, end - begin, sign,
                                                                                columns + begin);
    }
  }

  void try_disparity(int d, int first_row, int end_row, float* work) {
    const int begin = std::max(0, d);  // columns both views have
    const int end = std::min(width_, width_ + d);
    const int n = end - begin - side_ + 1;  // windows that fit
    if (n <= 0) return;
    float* columns = work;
    float* sum = work + width_;
    float* spare = work + 2 * width_;
    float* other = work + 3 * width_;
    for (int row = first_row; row < end_row; ++row) {
      const int y = y_of(row);
      if (row == first_row || rows_.step_px >= side_) {
        std::fill(columns, columns + width_, 0.0F);
        for (int j = -planes_.radius; j <= planes_.radius; ++j) add_row(y + j, d, begin, end, 1, columns);
      } else {
        for (int k = 0; k < rows_.step_px; ++k) {
          add_row(y + planes_.radius - k, d, begin, end, 1, columns);
          add_row(y - planes_.radius - 1 - k, d, begin, end, -1, columns);
        }
      }
      std::copy(columns + begin, columns + end, spare);
      join_across(spare, other, side_, n, sum);
      const int x = begin + planes_.radius;
      if (score_ == WindowScore::SquaredDifferences) {
        keep_least(sum, facts_.right_scale.row(row) + x - d, n, d, least_.row(row) + x, best_.row(row) + x);
        continue;
      }
      for (std::size_t c = 0; c < planes_.left.size(); ++c)
        take_means(facts_.left_mean[c].row(row) + x, facts_.right_mean[c].row(row) + x - d, n, sum);
      keep_most_alike(sum, facts_.right_scale.row(row) + x - d, n, d, least_.row(row) + x,
                      best_.row(row) + x);
    }
  }

  const ChannelPlanes& planes_;
  WindowScore score_;
  LatticeRows rows_;
  int side_, width_, bands_;
  Plane<int>& best_;
  Plane<float> least_;
  RowFacts facts_;
  Plane<float> work_;
  Plane<double> moments_;
};

// best.row(j)[x]: the disparity of pixel (x, rows.first_px + j * rows.step_px), kNoCandidate where no
// window fits (or no correlation is positive). Stopped early where the context says so.
void search_lattice(const ChannelPlanes& planes, WindowScore score, const CandidateRange& range,
                    const LatticeRows& rows, StageContext& context, Plane<int>& best) {
  std::ranges::fill(best.values, kNoCandidate);
  Arena::Mark mark(context.scratch);
  Search(planes, score, rows, context, best).run(range, context);
}

constexpr int kBands = 32;
constexpr double kFitBiasPx = 0.03;     // rms of a parabola's pull to whole pixels, textures of 5 to 20
constexpr double kFaceBend = 1.0 / 40;  // 1/mm: between a cheek and the tip of a nose

// Rows of the keypoints, where they lie on pixels of a lattice as they say; else none.
std::optional<LatticeRows> rows_of(const Keypoints& keypoints, int height) {
  if (keypoints.lattice_step_px < 1 || keypoints.points.empty()) return std::nullopt;
  float least = keypoints.points.front().at_px.y;
  float most = least;
  for (const Keypoint& k : keypoints.points) {
    if (k.at_px.x != std::floor(k.at_px.x) || k.at_px.y != std::floor(k.at_px.y)) return std::nullopt;
    least = std::min(least, k.at_px.y);
    most = std::max(most, k.at_px.y);
  }
  if (least < 0 || most >= float(height)) return std::nullopt;
  const LatticeRows rows{int(least), keypoints.lattice_step_px,
                         (int(most) - int(least)) / keypoints.lattice_step_px + 1};
  for (const Keypoint& k : keypoints.points)
    if ((int(k.at_px.y) - rows.first_px) % rows.step_px != 0) return std::nullopt;
  return rows;
}

struct Fit {
  float disparity_px = 0;
  float cost = 1;
  float sigma_px = 0;  // 0: no minimum
  double unlike = 0;
};

Fit fit_minimum(const PatchScores::Score& before, const PatchScores::Score& here,
                const PatchScores::Score& after, int disparity, double bias, const WindowRule& rule) {
  Fit fit;
  const double bend = before.unlike - 2 * here.unlike + after.unlike;
  if (!std::isfinite(bend) || !(bend > 0) || here.unlike > before.unlike || here.unlike > after.unlike)
    return fit;
  const double tilt = before.unlike - after.unlike;
  const double steep = std::max(before.unlike, after.unlike) - here.unlike;
  const double offset = rule.equiangular ? tilt / (2 * steep) : tilt / (2 * bend);
  const double samples = rule.window_px * rule.window_px;
  // The parabola's minimum, but never less than rounding to eight bits leaves.
  const double least = std::max(here.unlike - tilt * tilt / (8 * bend), 1e-6 * bend);
  fit.disparity_px = float(disparity + offset);
  fit.cost = float(here.cost);
  fit.unlike = here.unlike;
  fit.sigma_px = float(std::sqrt(2 * least / (samples * bend) + bias * bias));
  return fit;
}

class WindowMatching {
 public:
  WindowMatching(const RectifiedPair& pair, const Keypoints& keypoints, const WindowRule& rule,
                 StageContext& context)
      : keypoints_(keypoints),
        rule_(rule),
        bias_px_(method_bias_px(pair, rule.window_px)),
        range_(disparity_range(pair)),
        rows_(rows_of(keypoints, pair.height_px)),
        planes_(make_channel_planes(pair, rule.channels, rule.window_px / 2, context)),
        best_(&context.scratch, pair.width_px, rows_ ? rows_->count : 0),
        fits_(keypoints.points.size(), Fit{}, &context.scratch),
        scores_(&context.scratch) {
    scores_.reserve(kBands);
    for (int band = 0; band < kBands; ++band)
      scores_.emplace_back(planes_, rule.score, rows_ ? 3 : range_.count(), &context.scratch);
  }

  void run(StageContext& context) {
    if (rows_) search_lattice(planes_, rule_.score, range_, *rows_, context, best_);
    context.progress.done.store(0.8F, std::memory_order_relaxed);
    const int count = int(keypoints_.points.size());
    context.pool.for_each_band(count, kBands, [&](int begin, int end, int band) {
      for (int k = begin; k < end; ++k) {
        if (k % 64 == 0 && context.stop()) return;
        PatchScores& scores = scores_[std::size_t(band)];
        fits_[std::size_t(k)] = rows_ ? fit_at_node(keypoints_.points[std::size_t(k)].at_px, scores)
                                      : fit_anywhere(keypoints_.points[std::size_t(k)].at_px, scores);
      }
    });
  }

  void hand_on(MatchSet& set) const {
    const double scale = rule_.score == WindowScore::SquaredDifferences
                             ? rule_.window_px * rule_.window_px * rule_.channels
                             : 1;
    for (std::size_t k = 0; k < fits_.size(); ++k) {
      const Fit& fit = fits_[k];
      if (fit.sigma_px > 0 && fit.sigma_px <= rule_.sigma_limit_px && fit.unlike <= rule_.most_unlike * scale)
        set.matches.push_back({keypoints_.points[k].at_px, fit.disparity_px, fit.cost, fit.sigma_px, 0});
    }
  }

 private:
  Fit fit_at_node(Vec2f at, PatchScores& scores) {
    const int x = int(at.x);
    if (x < 0 || x >= best_.width) return {};
    const int d = best_.row((int(at.y) - rows_->first_px) / rows_->step_px)[x];
    if (d <= range_.first || d >= range_.last || !scores.load(at, d - 1, 3)) return {};
    return fit_minimum(scores.score(0), scores.score(1), scores.score(2), d, bias_px_, rule_);
  }

  Fit fit_anywhere(Vec2f at, PatchScores& scores) {
    if (!scores.load(at, range_.first, range_.count())) return {};
    int best = 0;
    PatchScores::Score least{std::numeric_limits<double>::infinity(), 1};
    for (int k = 0; k < range_.count(); ++k)
      if (const PatchScores::Score here = scores.score(k); here.unlike < least.unlike) {
        least = here;
        best = k;
      }
    if (best == 0 || best == range_.count() - 1) return {};
    return fit_minimum(scores.score(best - 1), least, scores.score(best + 1), range_.first + best, bias_px_,
                       rule_);
  }

  const Keypoints& keypoints_;
  const WindowRule& rule_;
  double bias_px_;
  CandidateRange range_;
  std::optional<LatticeRows> rows_;
  ChannelPlanes planes_;
  Plane<int> best_;
  std::pmr::vector<Fit> fits_;
  std::pmr::vector<PatchScores> scores_;
};

}  // namespace

// What a window takes off a surface bent both ways: (w^2 - 1) / 24 times its second derivatives, each of
// which is bend * baseline / focal length.
double method_bias_px(const RectifiedPair& pair, int window_px) {
  const double flattened =
      (window_px * window_px - 1) / 24.0 * 2 * kFaceBend * pair.baseline_mm / pair.focal_px;
  return std::hypot(kFitBiasPx, flattened);
}

Result<MatchSet> match_windows(const RectifiedPair& pair, const Keypoints& keypoints, const WindowRule& rule,
                               StageContext& context) {
  RELIEVO_TRY(check_pixels(pair));
  MatchSet set(&context.output);
  set.lattice_step_px = keypoints.lattice_step_px;
  set.matches.reserve(keypoints.points.size());
  WindowMatching matching(pair, keypoints, rule, context);
  matching.run(context);
  if (context.stop()) return Error{Errc::Cancelled, "stopped while matching windows"};
  matching.hand_on(set);
  if (set.matches.empty())
    return Error{
        Errc::TooFewMatches,
        "no window of the left view is found again in the right one: is the face in both, in focus and lit?"};
  return set;
}

}  // namespace relievo::pipeline
