// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How much each photograph has to say about each vertex.
#pragma once

#include <memory_resource>
#include <span>
#include <vector>

#include "pipeline/model/face_mesh.h"
#include "pipeline/model/rectified_pair.h"
#include "pipeline/texture/chart.h"

namespace relievo::pipeline {

struct ViewWeightOptions {
  float angle_power = 4;      // exponent of the cosine of incidence
  float occlusion_px = 1.5F;  // disparity of an occluder in front
  int feather_passes = 6;     // mesh edges over which one view fades into the other
};

// Share of the right view a vertex, 0 (left only) to 1 (right only); falls to the seeing view before
// the other one's occlusion begins. `front` is the chart's front disparity. Throws std::bad_alloc.
std::pmr::vector<float> right_share(const FaceMesh& mesh, const RectifiedPair& pair, const Chart& chart,
                                    std::span<const float> front, const ViewWeightOptions& options,
                                    std::pmr::memory_resource* memory);

}  // namespace relievo::pipeline
