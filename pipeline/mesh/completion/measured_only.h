// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Nothing is added. Thread: any.
#pragma once

#include "pipeline/mesh/completion/completion.h"

namespace relievo::pipeline {

struct MeasuredOnly {
  Result<FaceMesh> complete(FaceMesh mesh, const Vec3d&, StageContext& context) const {
    if (context.stop()) return Error{Errc::Cancelled, "completion was stopped"};
    return mesh;
  }
};

}  // namespace relievo::pipeline
