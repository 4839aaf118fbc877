// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// SideCharts: what the middle view cannot lay flat (it turns away, or lies behind or beside the face:
// completed parts of the head above all) in charts of its own, beside the main one. Neighbouring
// triangles that face one way within 60 degrees share a chart, laid flat along that way (after the
// chart growing of Levy et al.: Least squares conformal maps, SIGGRAPH 2002); charts are packed in
// columns. What was not photographed is smooth: a texel a millimetre. Thread: any. Throws std::bad_alloc.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "pipeline/model/face_mesh.h"
#include "pipeline/texture/chart/chart.h"

namespace relievo::pipeline {

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
