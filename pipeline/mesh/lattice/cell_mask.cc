// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/lattice/cell_mask.h"

#include <algorithm>
#include <cmath>

namespace relievo::pipeline {
namespace {

constexpr float kFar = 1e9F;
constexpr std::uint32_t kWhole = 1U << 20;  // the share 1, in whole numbers: sums that run along stay exact

// Three boxes of 2 reach + 1 cells have the variance of this Gaussian.
std::size_t box_reach(float sigma_cells) {
  return std::size_t(std::lround((std::sqrt(4 * sigma_cells * sigma_cells + 1) - 1) / 2));
}

// Means over windows of 2 reach + 1 along a line of `count` values, `stride` apart; `line` is room for it.
void average_line(std::uint32_t* values, std::size_t count, std::size_t stride, std::size_t reach,
                  std::uint32_t* line) {
  for (std::size_t i = 0; i < count; ++i) line[i] = values[i * stride];
  std::uint32_t sum = 0;
  for (std::size_t i = 0; i < std::min(reach, count); ++i) sum += line[i];
  for (std::size_t i = 0; i < count; ++i) {
    if (i + reach < count) sum += line[i + reach];
    values[i * stride] = sum / std::uint32_t(2 * reach + 1);
    if (i >= reach) sum -= line[i - reach];
  }
}

}  // namespace

void MaskShaper::dilate(CellMask& mask, float radius_mm) { mark_within(mask, 1, radius_mm); }

void MaskShaper::erode(CellMask& mask, float radius_mm) {
  mark_within(mask, 0, radius_mm);
  for (std::uint8_t& cell : mask) cell ^= 1;
}

void MaskShaper::close(CellMask& mask, float radius_mm, float back_mm) {
  std::ranges::copy(mask, before_.begin());
  dilate(mask, radius_mm);
  erode(mask, back_mm);
  for (std::size_t k = 0; k < mask.size(); ++k) mask[k] |= before_[k];
}

void MaskShaper::open(CellMask& mask, float radius_mm) {
  erode(mask, radius_mm);
  dilate(mask, radius_mm);
}

void MaskShaper::straighten(CellMask& mask, float sigma_mm, float least) {
  const std::size_t w = std::size_t(columns_);
  const std::size_t h = std::size_t(rows_);
  const std::size_t along = box_reach(sigma_mm / cell_width_mm_);
  const std::size_t down = box_reach(sigma_mm / cell_height_mm_);
  std::pmr::vector<std::uint32_t> share(mask.size(), 0U, piece_.get_allocator());
  piece_.assign(std::max(w, h), 0U);
  for (std::size_t k = 0; k < mask.size(); ++k) share[k] = mask[k] * kWhole;
  const std::uint32_t level = std::uint32_t(least * float(kWhole));
  for (int pass = 0; pass < 3; ++pass) {
    for (std::size_t r = 0; r < h; ++r) average_line(&share[r * w], w, 1, along, piece_.data());
    for (std::size_t c = 0; c < w; ++c) average_line(&share[c], h, w, down, piece_.data());
  }
  for (std::size_t k = 0; k < mask.size(); ++k) mask[k] = share[k] >= level;
}

void MaskShaper::measure_rows(const CellMask& mask, std::uint8_t wanted) {
  const float before_first = wanted == 0 ? 0 : kFar;  // beyond the border nothing is in
  for (int r = 0; r < rows_; ++r) {
    const std::size_t row = std::size_t(r) * std::size_t(columns_);
    float steps = before_first;
    for (std::size_t c = 0; c < std::size_t(columns_); ++c) {
      steps = mask[row + c] == wanted ? 0 : steps + 1;
      along_row_[row + c] = steps;
    }
    steps = before_first;
    for (std::size_t c = std::size_t(columns_); c-- > 0;) {
      steps = mask[row + c] == wanted ? 0 : steps + 1;
      const float mm = std::min(along_row_[row + c], steps) * cell_width_mm_;
      along_row_[row + c] = mm * mm;
    }
  }
}

// The squared distance separates into a row's and a column's part; within a bounded radius the column's
// minimum is quickest found by looking (whole rows at a time, so that it vectorises).
void MaskShaper::mark_within(CellMask& mask, std::uint8_t wanted, float radius_mm) {
  measure_rows(mask, wanted);
  const int reach = std::min(int(radius_mm / cell_height_mm_), rows_);
  const float limit = radius_mm * radius_mm;
  const std::size_t w = std::size_t(columns_);
  for (int r = 0; r < rows_; ++r) {
    std::copy_n(&along_row_[std::size_t(r) * w], w, nearest_.begin());
    for (int dr = -reach; dr <= reach; ++dr) {
      const float mm = float(dr) * cell_height_mm_;
      if (r + dr < 0 || r + dr >= rows_) {
        if (wanted == 0) std::ranges::fill(nearest_, 0.0F);  // within reach by the loop's bounds
        continue;
      }
      const float* other = &along_row_[std::size_t(r + dr) * w];
      float* nearest = nearest_.data();
      for (std::size_t c = 0; c < w; ++c) nearest[c] = std::min(nearest[c], other[c] + mm * mm);
    }
    std::uint8_t* mark = &mask[std::size_t(r) * w];
    for (std::size_t c = 0; c < w; ++c) mark[c] = nearest_[c] <= limit;
  }
}

// Turns the piece of `from` around `seed` into `to`; its cells are in piece_ afterwards.
template <bool Corners>
void MaskShaper::flood(CellMask& mask, std::uint32_t seed, std::uint8_t from, std::uint8_t to) {
  piece_.clear();
  const auto join = [&](std::size_t k) {
    if (mask[k] != from) return;
    mask[k] = to;
    piece_.push_back(std::uint32_t(k));
  };
  join(seed);
  for (std::size_t next = 0; next < piece_.size(); ++next) {
    const std::uint32_t k = piece_[next];
    if constexpr (Corners) for_each_around(int(k) % columns_, int(k) / columns_, columns_, rows_, join);
    else for_each_beside(k, std::size_t(columns_), mask.size(), join);
  }
}

void MaskShaper::fill_holes(CellMask& mask) {
  constexpr std::uint8_t kOutside = 2;
  const auto flood_from = [&](int c, int r) {
    const std::uint32_t k = std::uint32_t(r * columns_ + c);
    if (mask[k] == 0) flood<true>(mask, k, 0, kOutside);
  };
  for (int c = 0; c < columns_; ++c) {
    flood_from(c, 0);
    flood_from(c, rows_ - 1);
  }
  for (int r = 0; r < rows_; ++r) {
    flood_from(0, r);
    flood_from(columns_ - 1, r);
  }
  for (std::uint8_t& cell : mask) cell = cell != kOutside;
}

void MaskShaper::drop_pieces_below(CellMask& mask, std::size_t least) {
  constexpr std::uint8_t kKept = 2;
  for (std::uint32_t k = 0; k < mask.size(); ++k) {
    if (mask[k] != 1) continue;
    flood<false>(mask, k, 1, kKept);
    if (piece_.size() >= least) continue;
    for (const std::uint32_t cell : piece_) mask[cell] = 0;
  }
  for (std::uint8_t& cell : mask) cell = cell == kKept;
}

void MaskShaper::keep_largest_piece(CellMask& mask) {
  constexpr std::uint8_t kSeen = 2, kKept = 3;
  std::size_t most = 0;
  std::uint32_t seed = 0;
  for (std::uint32_t k = 0; k < mask.size(); ++k) {
    if (mask[k] != 1) continue;
    flood<false>(mask, k, 1, kSeen);
    if (piece_.size() <= most) continue;
    most = piece_.size();
    seed = k;
  }
  if (most > 0) flood<false>(mask, seed, kSeen, kKept);
  for (std::uint8_t& cell : mask) cell = cell == kKept;
}

}  // namespace relievo::pipeline
