// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/window/window_matchers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "hal/base/simd.h"
#include "pipeline/match/window/window_correlation.h"

namespace relievo::pipeline {
namespace {

// The search: the best whole disparity of every node of a lattice over the whole volume. The windows'
// sums run down the columns and are joined across (McDonnell 1981; Faugeras et al. 1993, INRIA RR-2013),
// one disparity after the other, so that the cost does not depend on the window and the memory does not
// depend on the range: a few rows a band, one score and one disparity a pixel of a lattice row.
// Sums are single precision, started afresh every band: a search, not the last word (window_correlation.h).
// Parallel in bands of lattice rows; results do not depend on the number of threads.
struct LatticeRows {
  int first_px, step_px, count;
};

constexpr int kNoCandidate = -1'000'000;

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

class Search {
 public:
  Search(const ChannelPlanes& planes, WindowScore score, const LatticeRows& rows, StageContext& context,
         Plane<int>& best)
      : planes_(planes), score_(score), rows_(rows), context_(context), best_(best) {
    if (score != WindowScore::ZeroMeanCorrelation) return;
    for (auto* means : {&left_mean_, &right_mean_}) {
      means->reserve(planes.left.size());
      for (std::size_t c = 0; c < planes.left.size(); ++c)
        means->emplace_back(&context.scratch, width_, rows.count);
    }
  }

  void run(const CandidateRange& range) {
    context_.pool.for_each_band(rows_.count, bands_, [&](int begin, int end, int band) {
      for (int row = begin; row < end; ++row) {
        if (context_.stop()) return;
        learn_row(row, moments_.row(band));
      }
      for (int d = range.first; d <= range.last; ++d) {
        if (context_.stop()) return;
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
    float* scale = right_scale_.row(row);
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
        left_mean_[c].row(row)[centre] = float(left);
        right_mean_[c].row(row)[centre] = float(right / pixels);
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
        keep_least(sum, right_scale_.row(row) + x - d, n, d, least_.row(row) + x, best_.row(row) + x);
        continue;
      }
      for (std::size_t c = 0; c < planes_.left.size(); ++c)
        take_means(left_mean_[c].row(row) + x, right_mean_[c].row(row) + x - d, n, sum);
      keep_most_alike(sum, right_scale_.row(row) + x - d, n, d, least_.row(row) + x, best_.row(row) + x);
    }
  }

  const ChannelPlanes& planes_;
  WindowScore score_;
  LatticeRows rows_;
  StageContext& context_;
  Plane<int>& best_;
  int side_ = 2 * planes_.radius + 1, width_ = best_.width;
  int bands_ = (rows_.count + kRowsPerBand - 1) / kRowsPerBand;
  Plane<float> least_{&context_.scratch, width_, rows_.count, start()};
  // What is known of every window of a lattice row before any disparity is tried.
  // The left times the window's pixels; a channel each.
  std::pmr::vector<Plane<float>> left_mean_{&context_.scratch}, right_mean_{&context_.scratch};
  // 1 / root of the variation; of squared differences kUnfit or 0.
  Plane<float> right_scale_{&context_.scratch, width_, rows_.count};
  Plane<float> work_{&context_.scratch, 4 * width_, bands_};
  Plane<double> moments_{&context_.scratch, 3 * width_, bands_};
};

constexpr int kBands = 32;

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

struct WindowRule {
  WindowScore score;
  int window_px, channels;
  bool equiangular;    // the fit between pixels: two lines of equal slope, not a parabola
  double most_unlike;  // S a pixel and channel (squared differences), or S
  float sigma_limit_px;
};

// Its sigma_px is 0 where there is no minimum, or none that the rule believes.
Match fit_minimum(Vec2f at, const PatchScores::Score& before, const PatchScores::Score& here,
                  const PatchScores::Score& after, int disparity, double bias, const WindowRule& rule) {
  const double bend = before.unlike - 2 * here.unlike + after.unlike;
  if (!std::isfinite(bend) || !(bend > 0) || here.unlike > before.unlike || here.unlike > after.unlike)
    return {};
  const double tilt = before.unlike - after.unlike;
  const double steep = std::max(before.unlike, after.unlike) - here.unlike;
  const double offset = rule.equiangular ? tilt / (2 * steep) : tilt / (2 * bend);
  const double samples = rule.window_px * rule.window_px;
  // The parabola's minimum, but never less than rounding to eight bits leaves.
  const double least = std::max(here.unlike - tilt * tilt / (8 * bend), 1e-6 * bend);
  const auto sigma = float(std::sqrt(2 * least / (samples * bend) + bias * bias));
  const double summed = rule.score == WindowScore::SquaredDifferences ? samples * rule.channels : 1;
  if (!(sigma <= rule.sigma_limit_px && here.unlike <= rule.most_unlike * summed)) return {};
  return {at, float(disparity + offset), float(here.cost), sigma, 0};
}

class WindowMatching {
 public:
  WindowMatching(const RectifiedPair& pair, const Keypoints& keypoints, const WindowRule& rule,
                 StageContext& context)
      : pair_(pair), keypoints_(keypoints), rule_(rule), context_(context) {
    scores_.reserve(kBands);
    for (int band = 0; band < kBands; ++band)
      scores_.emplace_back(planes_, rule.score, rows_ ? 3 : range_.count(), &context.scratch);
  }

  void run() {
    if (rows_) {
      Arena::Mark mark(context_.scratch);
      Search(planes_, rule_.score, *rows_, context_, best_).run(range_);
    }
    context_.progress.done.store(0.8F, std::memory_order_relaxed);
    const int count = int(keypoints_.points.size());
    context_.pool.for_each<std::size_t>(count, kBands, [&](std::size_t k, int band) {
      if (context_.stop()) return;
      PatchScores& scores = scores_[std::size_t(band)];
      const Vec2f at = keypoints_.points[k].at_px;
      found_[k] = rows_ ? match_at_node(at, scores) : match_anywhere(at, scores);
    });
  }

  std::span<const Match> found() const { return found_; }

 private:
  Match match_at_node(Vec2f at, PatchScores& scores) {
    const int x = int(at.x);
    if (x < 0 || x >= best_.width) return {};
    const int d = best_.row((int(at.y) - rows_->first_px) / rows_->step_px)[x];
    if (d <= range_.first || d >= range_.last || !scores.load(at, d - 1, 3)) return {};
    return fit_minimum(at, scores.score(0), scores.score(1), scores.score(2), d, bias_px_, rule_);
  }

  Match match_anywhere(Vec2f at, PatchScores& scores) {
    if (!scores.load(at, range_.first, range_.count())) return {};
    int best = 0;
    PatchScores::Score least{std::numeric_limits<double>::infinity(), 1};
    for (int k = 0; k < range_.count(); ++k)
      if (const PatchScores::Score here = scores.score(k); here.unlike < least.unlike) {
        least = here;
        best = k;
      }
    if (best == 0 || best == range_.count() - 1) return {};
    return fit_minimum(at, scores.score(best - 1), least, scores.score(best + 1), range_.first + best,
                       bias_px_, rule_);
  }

  const RectifiedPair& pair_;
  const Keypoints& keypoints_;
  const WindowRule& rule_;
  StageContext& context_;
  double bias_px_ = method_bias_px(pair_, rule_.window_px);
  CandidateRange range_ = disparity_range(pair_);
  std::optional<LatticeRows> rows_ = rows_of(keypoints_, pair_.height_px);
  ChannelPlanes planes_ = make_channel_planes(pair_, rule_.channels, rule_.window_px / 2, context_);
  // best_.row(j)[x]: of pixel (x, rows_->first_px + j * rows_->step_px), kNoCandidate where no window fits
  // (or no correlation is positive).
  Plane<int> best_{&context_.scratch, pair_.width_px, rows_ ? rows_->count : 0, kNoCandidate};
  std::pmr::vector<Match> found_{keypoints_.points.size(), Match{}, &context_.scratch};
  std::pmr::vector<PatchScores> scores_{&context_.scratch};
};

// Keypoints whose window leaves the picture, whose best candidate is the volume's end, or that the rule
// does not believe, are left out.
Result<MatchSet> match_windows(const RectifiedPair& pair, const Keypoints& keypoints, const WindowRule& rule,
                               StageContext& context) {
  RELIEVO_TRY(check_pixels(pair));
  WindowMatching matching(pair, keypoints, rule, context);
  matching.run();
  if (context.stop()) return stopped();
  return matches_of(matching.found(), keypoints, context);
}

}  // namespace

Result<MatchSet> SsdMatcher::match(const RectifiedPair& pair, const Keypoints& keypoints,
                                   StageContext& context) const {
  const double most_unlike = double(max_difference) * double(max_difference);
  return match_windows(
      pair, keypoints,
      {WindowScore::SquaredDifferences, window_px, channels, false, most_unlike, sigma_limit_px}, context);
}

Result<MatchSet> ZmnccMatcher::match(const RectifiedPair& pair, const Keypoints& keypoints,
                                     StageContext& context) const {
  return match_windows(pair, keypoints,
                       {WindowScore::ZeroMeanCorrelation, window_px, channels, equiangular != 0,
                        1 - double(min_score), sigma_limit_px},
                       context);
}

}  // namespace relievo::pipeline
