// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From triangles to texels, in bands of rows that threads can share, and what each view sees in front.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "hal/base/groups.h"
#include "pipeline/base/stage.h"
#include "pipeline/mesh/triangle_raster.h"
#include "pipeline/texture/chart/chart.h"

namespace relievo::pipeline {

// The triangles that lie whole within the chart, by the bands of rows they touch, in the mesh's order.
class RowBands {
 public:
  RowBands(const FaceMesh& mesh, const Chart& chart, int bands, std::pmr::memory_resource* memory);
  int count() const { return bands_; }
  RowRange rows(int band) const { return {height_ * band / bands_, height_ * (band + 1) / bands_}; }
  std::span<const std::uint32_t> triangles(int band) const { return triangles_[std::size_t(band)]; }

 private:
  int band_of(float y) const;
  int bands_, height_;
  Groups triangles_;
};

inline constexpr float kNothingThere = -1e30F;
inline constexpr std::uint32_t kNoTriangle = ~std::uint32_t{0};

// What stands in front in one view: the largest disparity on each of its texels.
struct FrontMap : PixelGrid {
  FrontMap(const Chart& chart, float side, std::pmr::memory_resource* memory);
  float side;                             // 0 the middle view, kLeftSide, kRightSide
  float scale;                            // texels a pixel
  float shift = 0;                        // of its columns against the chart's
  std::pmr::vector<float> nearest;        // kNothingThere where nothing is
  std::pmr::vector<std::uint32_t> owner;  // the triangle it belongs to; kept for the middle view alone

  float column(float texel_x, float disparity) const { return texel_x + side * disparity * scale - shift; }
  // Whether a point of the chart is hidden by something nearer by more than `tolerance_px` of disparity.
  bool sees(const Vec2f& texel, float disparity, float tolerance_px) const;
};

// Fills the maps band by band; every band writes its own rows. Stops early when the stage is stopped.
void fill_front_maps(const FaceMesh& mesh, const Chart& chart, const RowBands& bands,
                     std::span<FrontMap> maps, StageContext& context);

// Sums over a square window that slides over a plane: each texel enters and leaves once.
struct BoxSum {
  int first = 0, second = 0;
};

// emit(x, y, sum) for every texel of `rows`; the window reaches `radius` texels each way and is cut at
// the plane's borders. value(x, y) gives what is summed. `columns`: one a column, for this call alone.
template <typename Value, typename Emit>
void slide_box(int width, int height, int radius, RowRange rows, std::span<BoxSum> columns, Value&& value,
               Emit&& emit) {
  std::ranges::fill(columns, BoxSum{});
  const auto add_row = [&](int y, int sign) {
    if (y < 0 || y >= height) return;
    for (int x = 0; x < width; ++x) {
      const BoxSum v = value(x, y);
      columns[std::size_t(x)].first += sign * v.first;
      columns[std::size_t(x)].second += sign * v.second;
    }
  };
  for (int y = rows.begin - radius; y < rows.begin + radius; ++y) add_row(y, 1);
  for (int y = rows.begin; y < rows.end; ++y) {
    add_row(y + radius, 1);
    BoxSum sum;
    const auto add_column = [&](int x, int sign) {
      if (x < 0 || x >= width) return;
      sum.first += sign * columns[std::size_t(x)].first;
      sum.second += sign * columns[std::size_t(x)].second;
    };
    for (int x = 0; x < radius; ++x) add_column(x, 1);
    for (int x = 0; x < width; ++x) {
      add_column(x + radius, 1);
      emit(x, y, sum);
      add_column(x - radius, -1);
    }
    add_row(y - radius, -1);
  }
}

}  // namespace relievo::pipeline
