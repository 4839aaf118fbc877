// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// NearestVertex: which of many points in front of the camera lies nearest. Exact within the reach asked for.
// Millimetres. Thread: any, once made.
#pragma once

#include <cstdint>
#include <functional>
#include <memory_resource>
#include <span>
#include <vector>

#include "pipeline/base/kinds.h"
#include "pipeline/base/options.h"
#include "pipeline/mesh/surface_cleaner.h"
#include "pipeline/mesh/view_cells.h"
#include "pipeline/model/geometry.h"

namespace relievo::pipeline {

class NearestVertex {
 public:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;
  struct Hit {
    std::uint32_t vertex = kNone;
    float squared_mm = 0;
  };

  // Looks at `points` for as long as it lives. Throws std::bad_alloc when `memory` is used up.
  NearestVertex(std::span<const Vec3f> points_mm, std::pmr::memory_resource* memory);
  Hit find(const Vec3f& at_mm, float within_mm) const;

 private:
  std::span<const Vec3f> points_;
  ViewCells cells_;
};

// What the meshers of the catalogue begin and end with.
//
// base_sheet(): the measured points that belong to the largest surface, with normals, as the Delaunay mesher
// joins them: outliers, and whatever lies behind a step in depth, are gone before a smooth function is
// fitted. finish_surface(): any triangles near those points become a FaceMesh that keeps every mesher's
// promises; sigma and `measured` are carried over from the nearest measured point. Frame: the left camera's,
// millimetres. Both throw std::bad_alloc where an arena is used up.

// In `scratch`; sigma_mm perpendicular to the surface. At most `most_points`, spread evenly over the cloud.
// Errors: PoorGeometry, Cancelled.
Result<FaceMesh> base_sheet(const PointCloud& cloud, int most_points, StageContext& context);

// Half of all edges are shorter.
float usual_edge_mm(std::span<const Vec3f> vertices_mm, std::span<const Triangle> triangles,
                    std::pmr::memory_resource* memory);

// Points on the base's triangles where it has none within the spacing: vertices, normals and sigmas alone.
FaceMesh densify(const FaceMesh& base, float spacing_mm, std::pmr::memory_resource* memory);

struct FinishOptions {
  int max_triangles = 320'000;
  double max_gap_mm = 3;          // surface further than this from every measured point is cut off
  double max_incidence_deg = 80;  // steepest triangle, between its normal and the line of sight
  double min_area_mm2 = 2500;     // less surface than this is no face

  void describe(auto&& field) {
    field("max_triangles", max_triangles, OptionRange{1000, 10'000'000},
          "more triangles are simplified to so many");
    field("max_gap_mm", max_gap_mm, OptionRange{0.1, 50},
          "surface further than this from every measured point is cut off, mm");
    field("max_incidence_deg", max_incidence_deg, OptionRange{30, 89},
          "steepest triangle, between its normal and the line of sight, degrees");
    field("min_area_mm2", min_area_mm2, OptionRange{0, 1e6}, "less surface than this is no face, square mm");
  }
};

// `triangles` may be any heap in which no directed edge is used twice. Errors: PoorGeometry, InvalidInput (it
// cannot be simplified to `max_triangles`), Cancelled.
Result<FaceMesh> finish_surface(const FaceMesh& base, std::span<const Vec3f> vertices_mm,
                                std::pmr::vector<Triangle>& triangles, const FinishOptions& options,
                                StageContext& context);

// A depth function over the picture plane, laid on a lattice and meshed: what `rbf` and `bezier` have in
// common. The plane is x/z and y/z of the left camera, scaled to millimetres at the face's usual depth; the
// function gives depths z, millimetres, of that sheet's points. Nodes are where a measured point is near and
// the function agrees with it; the grid mesher joins them, closes gaps and shapes the outline.

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

// Called from the pool.
using DepthFunction = std::function<double(double u, double v)>;

// Errors: PoorGeometry, Cancelled. Throws std::bad_alloc where an arena is used up.
Result<FaceMesh> mesh_sheet(const FaceMesh& base, const DepthSamples& samples, const DepthFunction& function,
                            const SheetOptions& options, StageContext& context);

}  // namespace relievo::pipeline
