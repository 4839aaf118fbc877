// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/lattice/face_outline.h"

#include <algorithm>
#include <cmath>

namespace relievo::pipeline {
namespace {

// Half axes of an ellipsoid around the tip of the nose, mm. It holds what 3D face recognition crops, 95 mm
// around the tip, and stands upright on the skin before the ears, so that a bump there moves the curve
// little.
constexpr double kAcross = 112, kUp = 101, kBack = 91;
constexpr double kJaw = 130;  // mm: from the chin the curve rises sideways as a parabola
constexpr double kBend = 12;  // mm over which the curve turns from the cheeks to below the chin

}  // namespace

float FaceOutline::depth_mm(const Vec3f& from_chart_centre_mm) const {
  const Vec3d p = chart.in_head(from_chart_centre_mm);
  const double share = std::max(std::hypot(p.x / kAcross, p.y / kUp, p.z / kBack), 1e-3);
  const double to_reach = std::hypot(p.x, p.y, p.z) * (1 / share - 1);
  const double to_chin = p.y + below_mm - p.x * p.x / kJaw;
  const double between =
      std::clamp(0.5 + 0.5 * (to_chin - to_reach) / kBend, 0.0, 1.0);  // the lesser of both, rounded off
  return static_cast<float>(to_chin + between * (to_reach - to_chin) - kBend * between * (1 - between) / 2);
}

}  // namespace relievo::pipeline
