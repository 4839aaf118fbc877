// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Completion: gives a measured surface what the cameras did not see. Completed vertices carry measured = 0
// and a sigma_mm of their own; what was measured stays bit for bit where it is. One connected manifold
// surface comes out. A surface in which no head is found, or to which nothing can be added, comes back as it
// is. Errors: OutOfMemory, Cancelled.
#pragma once

#include <string_view>

#include "pipeline/base/stage.h"
#include "pipeline/model/face_mesh.h"

namespace relievo::pipeline {

class Completion {
 public:
  virtual ~Completion() = default;
  virtual std::string_view name() const = 0;
  // `across`: which way runs across the person, as find_head_frame() wants it.
  virtual Result<FaceMesh> complete(FaceMesh mesh, const Vec3d& across, StageContext& context) const = 0;
};

}  // namespace relievo::pipeline
