// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/bending/bending_system.h"

#include <algorithm>
#include <cstddef>

#include "hal/base/simd.h"

namespace relievo::pipeline {
namespace {

constexpr int kBands = 8;
constexpr int kSmallest = 6;  // nodes across the coarsest lattice, its border included
constexpr int kMostLevels = 6;
constexpr int kMargin = 4;  // of zeros before and after a line, for coarse nodes that reach past its ends
// A node of a coarse lattice lies between nodes 2 J - 2 and 2 J - 1 of the finer one (one node of border goes
// before), and reaches one further.
constexpr float kNear = 0.75F, kFar = 0.25F;

int coarse_size(int fine) { return (fine + 1) / 2 + 2; }

// The finer lattice's four rows under a coarse one, weighed.
RELIEVO_SIMD void weigh_rows(const float* a, const float* b, const float* c, const float* d, int width,
                             float* line) {
  for (int x = 0; x < width; ++x) line[x] = kNear * (b[x] + c[x]) + kFar * (a[x] + d[x]);
}

// `line` has kMargin zeros before its first number and after its last.
RELIEVO_SIMD void weigh_columns(const float* line, int coarse_width, float* out) {
  for (int j = 0; j < coarse_width; ++j) {
    const float* at = line + 2 * j;
    out[j] = kNear * (at[-2] + at[-1]) + kFar * (at[-3] + at[0]);
  }
}

RELIEVO_SIMD void scale_row(const float* r, const float* inverse_diagonal, ColumnSpan span, float* z) {
  for (int x = span.begin; x < span.end; ++x) z[x] = r[x] * inverse_diagonal[x];
}

RELIEVO_SIMD void mix_rows(const float* near_row, const float* far_row, int coarse_width, float* line) {
  for (int j = 0; j < coarse_width; ++j) line[j] = kNear * near_row[j] + kFar * far_row[j];
}

// Node x of the finer lattice is nearest to coarse node x / 2 + 1, and next to the one on the other side.
RELIEVO_SIMD void add_columns(const float* line, int begin, int end, const float* mask, float* z) {
  for (int half = begin / 2; half < (end + 1) / 2; ++half) {
    const int x = 2 * half;
    const float even = kNear * line[half + 1] + kFar * line[half];
    const float odd = kNear * line[half + 1] + kFar * line[half + 2];
    if (x >= begin) z[x] += mask[x] > 0 ? even : 0.0F;
    if (x + 1 < end) z[x + 1] += mask[x + 1] > 0 ? odd : 0.0F;
  }
}

// Prolongs row y of the finer lattice.
void prolong_row(const Plane<float>& coarse, int y, ColumnSpan span, const float* mask, float* line,
                 float* z) {
  const int near = y / 2 + 1;
  const int far = y % 2 == 0 ? near - 1 : near + 1;
  mix_rows(coarse.row(near), coarse.row(far), coarse.width, line);
  add_columns(line, span.begin, span.end, mask, z);
}

}  // namespace

MultilevelPreconditioner::MultilevelPreconditioner(const BendingSystem& system, ThreadPool& pool,
                                                   std::pmr::memory_resource* memory)
    : pool_(pool),
      inverse_diagonal_(memory, system.width(), system.height()),
      levels_(memory),
      lines_(memory, system.width() + 2 * kMargin, kBands),
      zeros_(memory, system.width(), 1) {
  levels_.reserve(kMostLevels);
  add_levels(system, memory);
}

void MultilevelPreconditioner::add_levels(const BendingSystem& s, std::pmr::memory_resource* memory) {
  Plane<float> bend(memory, s.width(), s.height());
  Plane<float> data(memory, s.width(), s.height());
  for (int y = 1; y < s.height() - 1; ++y)
    for (int x = 1; x < s.width() - 1; ++x) {
      const float* xx = s.bend_xx.row(y) + x;
      const float d = xx[-1] + 4 * xx[0] + xx[1] + s.bend_yy.row(y - 1)[x] + 4 * s.bend_yy.row(y)[x] +
                      s.bend_yy.row(y + 1)[x] + s.bend_xy.row(y)[x] + s.bend_xy.row(y)[x - 1] +
                      s.bend_xy.row(y - 1)[x] + s.bend_xy.row(y - 1)[x - 1];
      bend.row(y)[x] = d;
      data.row(y)[x] = s.data.row(y)[x];
      if (d + data.row(y)[x] > 0) inverse_diagonal_.row(y)[x] = 1 / (d + data.row(y)[x]);
    }
  // What a coarse node stands for: all the data under it, and second differences over twice the distance: a
  // quarter of the finer ones', squared, over as many nodes as it covers.
  constexpr float kCoarserBend = 1.0F / 16;
  while (int(levels_.size()) < kMostLevels &&
         std::min(coarse_size(bend.width), coarse_size(bend.height)) >= kSmallest) {
    const int w = coarse_size(bend.width);
    const int h = coarse_size(bend.height);
    Plane<float> coarse_bend(memory, w, h);
    Plane<float> coarse_data(memory, w, h);
    restrict_to(bend, coarse_bend);
    restrict_to(data, coarse_data);
    for (float& b : coarse_bend.values) b *= kCoarserBend;
    Level& level = levels_.emplace_back(memory, w, h);
    for (std::size_t k = 0; k < coarse_bend.values.size(); ++k) {
      const float d = coarse_bend.values[k] + coarse_data.values[k];
      level.inverse_diagonal.values[k] = d > 0 ? 1 / d : 0.0F;
    }
    bend = std::move(coarse_bend);
    data = std::move(coarse_data);
  }
}

void MultilevelPreconditioner::restrict_to(const Plane<float>& fine, Plane<float>& coarse) {
  pool_.for_each_band(coarse.height, kBands, [&](int begin, int end, int band) {
    float* const whole = lines_.row(band);
    float* const line = whole + kMargin;
    std::fill(whole, whole + lines_.width, 0.0F);
    for (int j = begin; j < end; ++j) {
      const auto row = [&](int y) { return y >= 0 && y < fine.height ? fine.row(y) : zeros_.row(0); };
      weigh_rows(row(2 * j - 3), row(2 * j - 2), row(2 * j - 1), row(2 * j), fine.width, line);
      weigh_columns(line, coarse.width, coarse.row(j));
    }
  });
}

void MultilevelPreconditioner::apply(const Plane<float>& r, const std::pmr::vector<ColumnSpan>& spans,
                                     Plane<float>& z) {
  for (std::size_t l = 0; l < levels_.size(); ++l)
    restrict_to(l == 0 ? r : levels_[l - 1].value, levels_[l].value);
  // What each lattice and all coarser ones make of the residual.
  for (std::size_t l = levels_.size(); l-- > 0;) {
    Level& here = levels_[l];
    const ColumnSpan all{0, here.value.width};
    pool_.for_each(here.value.height, kBands, [&](int y, int band) {
      scale_row(here.value.row(y), here.inverse_diagonal.row(y), all, here.value.row(y));
      if (l + 1 < levels_.size())
        prolong_row(levels_[l + 1].value, y, all, here.inverse_diagonal.row(y), lines_.row(band),
                    here.value.row(y));
    });
  }
  pool_.for_each(z.height, kBands, [&](int y, int band) {
    const ColumnSpan span = spans[std::size_t(y)];
    scale_row(r.row(y), inverse_diagonal_.row(y), span, z.row(y));
    if (!levels_.empty())
      prolong_row(levels_[0].value, y, span, inverse_diagonal_.row(y), lines_.row(band), z.row(y));
  });
}

}  // namespace relievo::pipeline
