// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// BezierMesher (`bezier`): the depth of the face as a net of bicubic Bezier patches that join with common
// tangents (C1; here even C2). Tensor-product cubic B-splines on a uniform net are fitted to the measured
// points by weighted least squares (1 / sigma^2) with a bending term that carries them over gaps, and
// turned into Bezier patches by knot insertion (Farin 2002, ch. 8 and 16; Dierckx 1993 for the fit).
// Takes any cloud. Otherwise as the others (scattered_meshers.h).
#pragma once

#include <array>
#include <memory_resource>
#include <vector>

#include "pipeline/mesh/meshers/base_sheet.h"

namespace relievo::pipeline {

// BezierNet: bicubic Bezier patches side by side, over a rectangle of the picture plane. Neighbours share
// their border's control values, and their tangents across it. Millimetres. Thread: any, once fitted.
class BezierNet {
 public:
  using Patch = std::array<std::array<double, 4>, 4>;  // control values: [row][column]

  // Fitted to the samples. Throws std::bad_alloc when `memory` is used up.
  BezierNet(const DepthSamples& samples, double patch_mm, double bending, std::pmr::memory_resource* memory);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  const Patch& patch(int column, int row) const { return patches_[std::size_t(row * columns_ + column)]; }
  void depths(std::span<const double> us, double v, std::span<double> depths) const;  // a DepthFunction

 private:
  double left_, top_, side_, middle_;
  int columns_, rows_;
  std::pmr::vector<Patch> patches_;
};

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
