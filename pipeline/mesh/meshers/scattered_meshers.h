// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshers that take any cloud. Frame: the left camera's, millimetres. Memory: the mesh in `output`, the rest
// in `scratch`; where CGAL is named its own structures come from the heap. Errors: those of Mesher. Thread:
// any; the pool evaluates. They keep no state.
#pragma once

#include <array>
#include <memory_resource>
#include <vector>

#include "pipeline/base/kinds.h"
#include "pipeline/base/options.h"
#include "pipeline/mesh/meshers/base_sheet.h"

namespace relievo::pipeline {

// AdvancingFrontMesher (`advancing-front`): a surface grown over the 3-D Delaunay triangulation of the
// points, always by the most plausible triangle (Cohen-Steiner, Da 2004; CGAL, about 700 bytes a point). Its
// vertices are the measured points.
struct AdvancingFrontMesher {
  int max_points = 160'000;   // more are thinned evenly
  double max_edge_mm = 5;     // longest edge
  double max_edge_ratio = 6;  // longest edge, in usual distances between neighbours
  FinishOptions finish;

  void describe(auto&& field) {
    field("max_points", max_points, OptionRange{1000, 1'000'000}, "more points are thinned evenly");
    field("max_edge_mm", max_edge_mm, OptionRange{0.1, 100}, "longest edge, mm");
    field("max_edge_ratio", max_edge_ratio, OptionRange{1.5, 100},
          "longest edge, in usual distances between neighbours");
    finish.describe(field);
  }
  Result<FaceMesh> mesh(const PointCloud& cloud, StageContext& context) const;
};

// RbfMesher (`rbf`): the depth of the face as one polyharmonic function (thin plate, r^2 log r, with an
// affine part), fitted to the measured points with centres chosen greedily: it begins with few, and adds them
// where the function is furthest from the points, a few cells apart, until `accuracy_mm` or `max_centres` is
// reached (Carr et al. 2001, section 4). Each centre may leave its point by what its sigma allows (their
// approximating spline, section 5; weights 1 / sigma^2). Memory: max_centres^2 doubles at most.
struct RbfMesher {
  int max_points = 160'000;  // more are thinned evenly
  int max_centres = 1400;
  double accuracy_mm = 0.05;  // no centre is added where the function is as close as this
  double smoothing = 0.02;    // 0 goes through every centre
  SheetOptions sheet;

  void describe(auto&& field) {
    field("max_points", max_points, OptionRange{1000, 1'000'000}, "more points are thinned evenly");
    field("max_centres", max_centres, OptionRange{20, 4000}, "how many centres the function may have");
    field("accuracy_mm", accuracy_mm, OptionRange{0.001, 10},
          "no centre is added where the function is as close to the points as this, mm");
    field("smoothing", smoothing, OptionRange{0, 1000},
          "how much a point's sigma lets the function leave it");
    sheet.describe(field);
  }
  Result<FaceMesh> mesh(const PointCloud& cloud, StageContext& context) const;
};

// PoissonMesher (`poisson`): the surface whose inside's gradient follows the points' normals (Kazhdan et al.
// 2006), solved by CGAL (about 3 kB a point) on a refined Delaunay triangulation, its zero surface taken by
// marching cubes in a band around the points (band_volume.h). Smooths over what the points leave open, within
// max_gap_mm.
struct PoissonMesher {
  int max_points = 30'000;  // more are thinned evenly: time and memory go with them
  double voxel_mm = 1;
  double band_voxels = 2.5;  // how far from a point its surface is looked for
  FinishOptions finish;

  void describe(auto&& field) {
    field("max_points", max_points, OptionRange{1000, 1'000'000},
          "more points are thinned evenly: time and memory go with them");
    field("voxel_mm", voxel_mm, OptionRange{0.3, 10}, "side of a voxel, mm");
    field("band_voxels", band_voxels, OptionRange{1.8, 5},
          "how far from a point its surface is looked for, in voxels");
    finish.describe(field);
  }
  Result<FaceMesh> mesh(const PointCloud& cloud, StageContext& context) const;
};

// MarchingCubesMesher (`marching-cubes`): a truncated signed distance field around the points, and its zero
// surface by marching cubes with decided ambiguities (band_volume.h). The field is that of Kolluri (2008,
// implicit moving least squares): at each voxel of the band the mean of the distances to the planes of the
// points around, weighted by a Gaussian of a voxel and by 1 / sigma^2; truncated at `band_voxels`. Memory: 8
// bytes a voxel of the box.
struct MarchingCubesMesher {
  int max_points = 160'000;  // more are thinned evenly
  double voxel_mm = 0.8;
  double band_voxels = 2.5;  // how far from a point the field reaches
  FinishOptions finish;

  void describe(auto&& field) {
    field("max_points", max_points, OptionRange{1000, 1'000'000}, "more points are thinned evenly");
    field("voxel_mm", voxel_mm, OptionRange{0.3, 10}, "side of a voxel, mm");
    field("band_voxels", band_voxels, OptionRange{1.8, 5},
          "how far from a point the field reaches, in voxels");
    finish.describe(field);
  }
  Result<FaceMesh> mesh(const PointCloud& cloud, StageContext& context) const;
};

// DelaunayMesher (`delaunay`): the dissertation's surface, a 2.5-D Delaunay triangulation over where
// the left rectified view saw the points (CGAL, about 150 bytes a point; the dissertation used Bourke's).
// Long, steep and stray triangles are cut; the same promises as the grid mesher hold: one component,
// manifold, counter-clockwise seen from the cameras, no fringe. Holes narrower than the longest edge are
// bridged by the triangulation itself, between measured points.
struct DelaunayMesher {
  int max_triangles = 320'000;    // more points are thinned evenly
  double max_edge_mm = 25;        // longest edge
  double max_edge_ratio = 12;     // longest edge, in distances of points spread evenly over as much surface
  double max_incidence_deg = 80;  // steepest triangle, between its normal and the line of sight
  int ear_passes = 3;             // how often triangles that hang on by one edge are trimmed; 0 to 16
  int normal_passes = 1;          // how often normals are averaged over the neighbours; 0 to 16
  double min_area_mm2 = 2500;     // less surface than this is no face

  void describe(auto&& field) {
    field("max_triangles", max_triangles, OptionRange{1000, 10'000'000}, "more points are thinned evenly");
    field("max_edge_mm", max_edge_mm, OptionRange{0.1, 100}, "longest edge, mm");
    field("max_edge_ratio", max_edge_ratio, OptionRange{1.5, 100},
          "longest edge, in distances of points spread evenly over as much surface");
    field("max_incidence_deg", max_incidence_deg, OptionRange{30, 89},
          "steepest triangle, between its normal and the line of sight, degrees");
    field("ear_passes", ear_passes, OptionRange{0, 16},
          "how often triangles that hang on by one edge are trimmed");
    field("normal_passes", normal_passes, OptionRange{0, 16},
          "how often normals are averaged over the neighbours");
    field("min_area_mm2", min_area_mm2, OptionRange{0, 1e6}, "less surface than this is no face, square mm");
  }
  Result<FaceMesh> mesh(const PointCloud& cloud, StageContext& context) const;
};

// BezierNet: bicubic Bezier patches side by side, over a rectangle of the picture plane. Neighbours share
// their border's control values, and their tangents across it. Millimetres. Thread: any, once fitted.
class BezierNet {
 public:
  using Patch = std::array<std::array<double, 4>, 4>;  // control values: [row][column]

  // Fitted to the samples, in `scratch`; not to the end where it was stopped. Throws std::bad_alloc.
  BezierNet(const DepthSamples& samples, double patch_mm, double bending, StageContext& context);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  const Patch& patch(int column, int row) const { return patches_[std::size_t(row * columns_ + column)]; }
  double depth(double u, double v) const;  // a DepthFunction

 private:
  double left_, top_, side_, middle_;
  int columns_, rows_;
  std::pmr::vector<Patch> patches_;
};

// BezierMesher (`bezier`): the depth of the face as a net of bicubic Bezier patches that join with common
// tangents (C1; here even C2). Tensor-product cubic B-splines on a uniform net are fitted to the measured
// points by weighted least squares (1 / sigma^2) with a bending term that carries them over gaps, and
// turned into Bezier patches by knot insertion (Farin 2002, ch. 8 and 16; Dierckx 1993 for the fit).
// Takes any cloud. Otherwise as the others.
struct BezierMesher {
  int max_points = 160'000;  // more are thinned evenly
  double patch_mm = 1.5;     // side of a patch, where the face's usual depth is
  double bending = 0.003;    // weight of the bending term against the points'
  SheetOptions sheet;

  void describe(auto&& field) {
    field("max_points", max_points, OptionRange{1000, 1'000'000}, "more points are thinned evenly");
    field("patch_mm", patch_mm, OptionRange{0.5, 50}, "side of a patch, mm");
    field("bending", bending, OptionRange{1e-6, 1000}, "weight of the bending term against the points'");
    sheet.describe(field);
  }
  Result<FaceMesh> mesh(const PointCloud& cloud, StageContext& context) const;
};

}  // namespace relievo::pipeline
