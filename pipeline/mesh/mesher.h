// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Mesher: points to one connected, consistently oriented surface with normals.
// Errors: PoorGeometry (no surface of a face's size), OutOfMemory, Cancelled.
#pragma once

#include <string_view>

#include "pipeline/base/stage.h"
#include "pipeline/model/face_mesh.h"
#include "pipeline/model/point_cloud.h"

namespace relievo::pipeline {

// What is less certain along the line of sight (a chin that moved between the exposures, hair) is surface,
// but not measured: whichever mesher ran, a head's frame and its landmarks are found on the same.
inline constexpr double kMeasuredSigmaMm = 0.75;

class Mesher {
 public:
  virtual ~Mesher() = default;
  virtual std::string_view name() const = 0;
  // It joins neighbours of a lattice: PointCloud::lattice_step_px must be set.
  virtual bool needs_lattice() const { return false; }
  virtual Result<FaceMesh> mesh(const PointCloud& cloud, StageContext& context) const = 0;
};

}  // namespace relievo::pipeline
