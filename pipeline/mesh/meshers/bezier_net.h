// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// BezierNet: bicubic Bezier patches side by side, over a rectangle of the picture plane. Neighbours share
// their border's control values, and their tangents across it. Millimetres. Thread: any, once fitted.
#pragma once

#include <array>
#include <memory_resource>
#include <vector>

#include "pipeline/mesh/meshers/depth_sheet.h"

namespace relievo::pipeline {

class BezierNet {
 public:
  using Patch = std::array<std::array<double, 4>, 4>;  // control values: [row][column]

  // Fitted to the samples. Throws std::bad_alloc when `memory` is used up.
  BezierNet(const DepthSamples& samples, double patch_mm, double bending, std::pmr::memory_resource* memory);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  const Patch& patch(int column, int row) const {
    return patches_[static_cast<std::size_t>(row * columns_ + column)];
  }
  void depths(std::span<const double> us, double v, std::span<double> depths) const;  // a DepthFunction

 private:
  double left_, top_, side_, middle_;
  int columns_, rows_;
  std::pmr::vector<Patch> patches_;
};

}  // namespace relievo::pipeline
