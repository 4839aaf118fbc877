// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A depth function over the picture plane, laid on a lattice and meshed: what `rbf` and `bezier` have in
// common. The plane is x/z and y/z of the left camera, scaled to millimetres at the face's usual depth; the
// function gives depths z, millimetres, of that sheet's points. Nodes are where a measured point is near and
// the function agrees with it; the grid mesher joins them, closes gaps and shapes the outline.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "pipeline/mesh/meshers/base_sheet.h"

namespace relievo::pipeline {

// The base sheet's points as samples of a function: at (u, v) the depth, and how sure, along the line of
// sight.
struct DepthSamples {
  explicit DepthSamples(std::pmr::memory_resource* memory)
      : u(memory), v(memory), depth(memory), sigma(memory) {}
  std::pmr::vector<double> u, v, depth, sigma;  // millimetres
  double usual_depth_mm = 0;                    // u = usual_depth_mm x / z
  double left = 0, right = 0, top = 0, bottom = 0;
};
DepthSamples sample_depths(const FaceMesh& base, std::pmr::memory_resource* memory);

struct SheetOptions {
  double step_mm = 0.7;  // from node to node, where the face's usual depth is
  int max_triangles = 320'000;
  double min_area_mm2 = 2500;  // less surface than this is no face

  void describe(auto&& field) {
    field("step_mm", step_mm, OptionRange{0.2, 10},
          "from node to node of the lattice the function is laid on, mm");
    field("max_triangles", max_triangles, OptionRange{1000, 10'000'000}, "never more triangles than this");
    field("min_area_mm2", min_area_mm2, OptionRange{0, 1e6}, "less surface than this is no face, square mm");
  }
};

// Asked for the depths of a row of places: `depths` gets one for each (us[i], v). Called from the pool.
using DepthFunction = std::function<void(std::span<const double> us, double v, std::span<double> depths)>;

// Errors: PoorGeometry, Cancelled. Throws std::bad_alloc where an arena is used up.
Result<FaceMesh> mesh_sheet(const FaceMesh& base, const DepthSamples& samples, const DepthFunction& function,
                            const SheetOptions& options, StageContext& context);

}  // namespace relievo::pipeline
