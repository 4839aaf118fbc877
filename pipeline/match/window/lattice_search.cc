// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/window/lattice_search.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hal/base/simd.h"

namespace relievo::pipeline {
namespace {

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

  void run(const DisparityRange& range, StageContext& context) {
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
        facts_.left_mean[c].row(row)[centre] = static_cast<float>(left);
        facts_.right_mean[c].row(row)[centre] = static_cast<float>(right / pixels);
        scale[centre] += static_cast<float>(squares - right * right / pixels);
      }
    }
    for (int x = 0; x < width_; ++x)
      scale[x] =
          whole[x] != 0 && scale[x] > 1e-3F * static_cast<float>(pixels) ? 1 / std::sqrt(scale[x]) : 0.0F;
  }

  // Of the window's rows about y: left, right and squared right, a column each.
  void sum_columns(std::size_t c, int y, double* columns) const {
    std::fill(columns, columns + 3 * width_, 0.0);
    for (int j = -planes_.radius; j <= planes_.radius; ++j) {
      const float* l = planes_.left[c].row(y + j);
      const float* r = planes_.right[c].row(y + j);
      for (int x = 0; x < width_; ++x) {
        const auto value = static_cast<double>(r[x]);
        columns[3 * x] += static_cast<double>(l[x]);
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

}  // namespace

void search_lattice(const ChannelPlanes& planes, WindowScore score, const DisparityRange& range,
                    const LatticeRows& rows, StageContext& context, Plane<int>& best) {
  std::fill(best.values.begin(), best.values.end(), kNoCandidate);
  Arena::Mark mark(context.scratch);
  Search(planes, score, rows, context, best).run(range, context);
}

}  // namespace relievo::pipeline
