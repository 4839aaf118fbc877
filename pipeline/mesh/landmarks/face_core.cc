// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/landmarks/face_core.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Cholesky>

#include "pipeline/base/solving.h"
#include "pipeline/mesh/landmarks/face_relief.h"

namespace relievo::pipeline {
namespace {

using Eigen::Vector3d;

// The core of a face: what cameras see of it however it turns. Beside the nose and below the eyes; the tip.
constexpr double kCoreHalf = 50, kCoreFrom = -30, kCoreTo = 78;
constexpr double kCoreCell = 1.25;
constexpr double kTipReach = 11;     // mm around the tip: both wings' flanks belong to it
constexpr double kRidgeShare = 0.2;  // of the vote of the nose's sides: highlights lie on the ridge
constexpr double kTipScale = 1.0;    // mm: what lies further off the paraboloid counts little

// A window beside or above the nose: its height and lean at its middle, by a quadratic through what was
// seen of it, so that a part that is missing shifts nothing.
struct Window {
  double from_x, to_x, from_y, to_y;
};
// Of a head held upright (nasion above pogonion, as in the Frankfurt plane): 10 +- 3 degrees.
constexpr double kBrowBeforeCheeks = 10 * std::numbers::pi / 180;
constexpr Window kCheek{18, 46, -22, 16}, kBrow{0, 30, 50, 76};

bool height_at_middle(const FaceRelief& core, const Window& w, double& z_mm) {
  using Vector5d = Eigen::Matrix<double, 5, 1>;
  Eigen::Matrix<double, 5, 5> a = Eigen::Matrix<double, 5, 5>::Identity() * 1e-6;
  Vector5d b = Vector5d::Zero();
  const double middle_x = 0.5 * (w.from_x + w.to_x), middle_y = 0.5 * (w.from_y + w.to_y);
  int count = 0;
  for (int r = 0; r < core.rows(); ++r)
    for (int c = 0; c < core.columns(); ++c) {
      const double x = core.x_mm(c), y = core.y_mm(r), z = static_cast<double>(core.z(c, r));
      if (std::isnan(z) || x < w.from_x || x > w.to_x || y < w.from_y || y > w.to_y || z < -70) continue;
      Vector5d row;
      const double u = (x - middle_x) / 20, v = (y - middle_y) / 20;
      row << 1, u, v, u * u, v * v;
      a += row * row.transpose();
      b += row * z;
      ++count;
    }
  z_mm = solved<5>(a, b)[0];
  return count > 200;
}

double nod_of(const FaceRelief& core) {
  double cheek = 0, brow = 0;
  if (!height_at_middle(core, kCheek, cheek) || !height_at_middle(core, kBrow, brow)) return 0;
  return std::atan2(brow - cheek, 0.5 * (kBrow.from_y + kBrow.to_y - kCheek.from_y - kCheek.to_y)) -
         kBrowBeforeCheeks;
}

// Foremost point of a paraboloid, upright in x, through the surface around the foremost place near the
// origin. Robust (Geman-McClure): a highlight or the nose's limb may have pulled a part of it away.
Vector3d tip_of(const FaceRelief& core) {
  Vector3d top(0, 0, -1e9);
  for (int r = 0; r < core.rows(); ++r)
    for (int c = 0; c < core.columns(); ++c)
      if (std::abs(core.x_mm(c)) < 4 && std::abs(core.y_mm(r)) < 16 &&
          static_cast<double>(core.z(c, r)) > top.z())
        top = {0, core.y_mm(r), static_cast<double>(core.z(c, r))};
  if (top.z() < -1e8) return Vector3d::Zero();
  Eigen::Vector4d k = Eigen::Vector4d::Zero();
  for (int turn = 0; turn < 12; ++turn) {
    Eigen::Matrix4d a = Eigen::Matrix4d::Identity() * 1e-6;
    Eigen::Vector4d b = Eigen::Vector4d::Zero();
    for (int r = 0; r < core.rows(); ++r)
      for (int c = 0; c < core.columns(); ++c) {
        const double x = core.x_mm(c), y = core.y_mm(r) - top.y(),
                     z = static_cast<double>(core.z(c, r)) - top.z();
        const double q = (x * x + y * y) / (kTipReach * kTipReach);
        if (!(q < 1) || !(std::abs(z) < 12)) continue;
        const Eigen::Vector4d row(1, y, y * y, x * x);
        const double e = turn < 2 ? 0 : (z - row.dot(k)) / kTipScale;
        const double beside = kRidgeShare + (1 - kRidgeShare) * std::min(1.0, x * x / 25);
        const double w = beside * (1 - q) * (1 - q) / ((1 + e * e) * (1 + e * e));
        a += w * row * row.transpose();
        b += w * row * z;
      }
    k = a.ldlt().solve(b);
    if (!(k[2] < -1e-4)) break;
    const double y = std::clamp(-k[1] / (2 * k[2]), -3.0, 3.0);
    top += Vector3d(0, y, k[0] + y * (k[1] + y * k[2]));
    k = {0, 0, k[2], k[3]};
    if (turn > 3 && std::abs(y) < 1e-3) break;
  }
  return top;
}

}  // namespace

FaceCore face_core(const FaceMesh& mesh, const RigidTransform& head_from_camera, StageContext& context) {
  const Arena::Mark mark(context.scratch);
  const ReliefBox box{-kCoreHalf, kCoreHalf, kCoreFrom - 5, kCoreTo + 5, kCoreCell};
  FaceRelief core(box, &context.scratch),
      nose(box, &context.scratch);  // below the tip nothing may be certain
  FaceRelief::add_both(mesh, head_from_camera, core, nose, context);
  const Vector3d tip = tip_of(nose);
  core.symmetrise();
  return {nod_of(core), tip};
}

}  // namespace relievo::pipeline
