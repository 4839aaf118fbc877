// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Chart: the face laid flat, as a view half way between the cameras would see it. What both cameras
// saw is one piece there and turns away from neither. Rows are the rectified rows; a point stands at
// the mean of its two columns, so each photograph is half a disparity away, and on a plane triangle
// disparity is affine: no perspective is needed.
//
// Texels: (0, 0) is the centre of the upper left texel. Thread: any. Throw std::bad_alloc.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "pipeline/model/face_mesh.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::pipeline {

struct ChartOptions {
  int max_px;     // widest and highest
  int margin_px;  // texels left free around the face
  double finer;   // texels a pixel and side of the better photograph
};

struct Chart : PixelGrid {
  explicit Chart(std::pmr::memory_resource* memory) : texel(memory), disparity_px(memory), placed(memory) {}
  double texels_per_px = 1;               // of the photographs
  Vec2d origin_px;                        // where texel (0, 0) lies in the middle view
  std::pmr::vector<Vec2f> texel;          // one a vertex
  std::pmr::vector<float> disparity_px;   // one a vertex
  std::pmr::vector<std::uint8_t> placed;  // one a vertex: 1 where it lies within the chart

  // Of a photograph, where the surface has this disparity. side: kLeftSide or kRightSide.
  float view_x(float texel_x, float disparity, float side) const {
    return float(origin_px.x) + texel_x / float(texels_per_px) + side * disparity;
  }
  float view_y(float texel_y) const { return float(origin_px.y) + texel_y / float(texels_per_px); }
};

inline constexpr float kLeftSide = 0.5F;  // of a disparity, from the middle view's column
inline constexpr float kRightSide = -0.5F;

// `finer` times as fine as the better photograph on 95 % of the measured surface; coarser where `max_px` asks
// for it. Its frame: the vertices both windows can see, measured or turned to the cameras.
Chart lay_out(const FaceMesh& mesh, const RectifiedPair& pair, const ChartOptions& options,
              std::pmr::memory_resource* memory);

// Negative where the triangle faces the cameras, in square texels (twice the area).
inline float signed_area(const Chart& chart, const Triangle& t) {
  const Vec2f& a = chart.texel[t[0]];
  const Vec2f& b = chart.texel[t[1]];
  const Vec2f& c = chart.texel[t[2]];
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// SideCharts: what the middle view cannot lay flat (it turns away, or lies behind or beside the face:
// completed parts of the head above all) in charts of its own, beside the main one. Neighbouring
// triangles that face one way within 60 degrees share a chart, laid flat along that way (after the
// chart growing of Levy et al.: Least squares conformal maps, SIGGRAPH 2002); charts are packed in
// columns. What was not photographed is smooth: a texel a millimetre.
struct SideCharts {
  explicit SideCharts(std::pmr::memory_resource* memory) : triangles(memory), corner(memory) {}
  std::pmr::vector<std::uint32_t> triangles;  // of the mesh
  std::pmr::vector<Vec2f> corner;             // 3 a triangle, in texels of the whole atlas
  int width_px = 0;                           // of the columns beside the main chart
};

// `kept`: 1 for triangles of the main chart. `photographed`: 1 a vertex that a camera saw.
// The atlas stays within `max_px`, if need be with coarser side charts.
SideCharts lay_out_sides(const FaceMesh& mesh, const Chart& main, std::span<const std::uint8_t> kept,
                         std::span<const std::uint8_t> photographed, double photograph_px_per_mm, int max_px,
                         std::pmr::memory_resource* memory);

}  // namespace relievo::pipeline
