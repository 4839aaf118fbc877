// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/recognition/rigid_face.h"

#include <cmath>

#include "pipeline/mesh/landmarks/face_relief.h"

namespace relievo::pipeline {
namespace {

constexpr double kSide = 63, kBottom = -9, kTop = 81;  // mm, of the lattice
constexpr double kSmoothMm = 1.5;
constexpr double kBehind = -90;  // mm: what lies further back is no face
constexpr double kEyeX = 32, kEyeY = 33, kEyeHalfWidth = 20, kEyeHalfHeight = 11;
constexpr double kNoseHalf = 20, kCheekboneFrom = 8;  // lower cheeks move with the mouth

// A height and the slopes to its neighbours; false where one of them is missing.
bool slopes(const FaceRelief& relief, int column, int row, double& dx, double& dy) {
  const auto z = [&](int dc, int dr) {
    return relief.inside(column + dc, row + dr) ? static_cast<double>(relief.z(column + dc, row + dr))
                                                : std::nan("");
  };
  dx = (z(1, 0) - z(-1, 0)) / (2 * kRigidFaceCellMm);
  dy = (z(0, 1) - z(0, -1)) / (2 * kRigidFaceCellMm);
  return !std::isnan(dx) && !std::isnan(dy);
}

bool inner(const FaceRelief& relief, int column, int row) {
  for (int dr = -1; dr <= 1; ++dr)
    for (int dc = -1; dc <= 1; ++dc) {
      const int c = column + dc, r = row + dr;
      if (!relief.inside(c, r) || std::isnan(relief.z(c, r)) ||
          !in_rigid_region(relief.x_mm(c), relief.y_mm(r)))
        return false;
    }
  return true;
}

}  // namespace

bool in_rigid_region(double x_mm, double y_mm) {
  const double x = std::abs(x_mm);
  if (x > kSide - kRigidFaceCellMm || y_mm < kBottom + kRigidFaceCellMm || y_mm > kTop - kRigidFaceCellMm)
    return false;
  if (x > kNoseHalf && y_mm < kCheekboneFrom) return false;
  const double u = (x - kEyeX) / kEyeHalfWidth, v = (y_mm - kEyeY) / kEyeHalfHeight;
  return u * u + v * v > 1;
}

RigidFace rigid_face_of(const FaceMesh& mesh, const RigidTransform& head_from_camera,
                        std::pmr::memory_resource* output, std::pmr::memory_resource* scratch) {
  FaceRelief relief({-kSide, kSide, kBottom, kTop, kRigidFaceCellMm}, scratch);
  relief.add(mesh, head_from_camera);
  relief.smooth(kSmoothMm, scratch);
  const auto kept = [&](int c, int r, double& dx, double& dy) {
    return in_rigid_region(relief.x_mm(c), relief.y_mm(r)) && static_cast<double>(relief.z(c, r)) > kBehind &&
           slopes(relief, c, r, dx, dy);
  };
  std::size_t count = 0;
  double dx = 0, dy = 0;
  for (int r = 0; r < relief.rows(); ++r)
    for (int c = 0; c < relief.columns(); ++c) count += kept(c, r, dx, dy) ? 1 : 0;
  RigidFace face(output);
  face.points_mm.reserve(count);
  face.normals.reserve(count);
  face.rim.reserve(count);
  for (int r = 0; r < relief.rows(); ++r)
    for (int c = 0; c < relief.columns(); ++c) {
      if (!kept(c, r, dx, dy)) continue;
      const double length = std::sqrt(1 + dx * dx + dy * dy);
      face.points_mm.push_back(
          {static_cast<float>(relief.x_mm(c)), static_cast<float>(relief.y_mm(r)), relief.z(c, r)});
      face.normals.push_back({static_cast<float>(-dx / length), static_cast<float>(-dy / length),
                              static_cast<float>(1 / length)});
      face.rim.push_back(inner(relief, c, r) ? 0 : 1);
    }
  return face;
}

}  // namespace relievo::pipeline
