// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/fuse/pose_residuals.h"

#include <algorithm>
#include <string>

#include "pipeline/model/small_motion.h"

namespace relievo::pipeline {
namespace {

constexpr double kSameFacing = 0.7;  // cosine between the normals of what is taken for the same skin
constexpr double kSurfaceSigmaMm = 0.03;
constexpr double kNeckMm = -60;  // above the tip of the nose
constexpr double kScaleOfUsual = 1.5;

double say_in_head(const Vec3d& p) {
  const double side = std::abs(p.x);
  if (p.y < kNeckMm) return 0;                // neck
  if (p.y > 105) return 0.1;                  // hair
  if (p.z < -62) return p.y < -30 ? 0.1 : 1;  // temples, ears; the jaw's corner
  if (p.y > 52) return 1;                     // forehead
  if (side < 9 && p.y > 12) return 1;         // bridge of the nose
  if (p.y > 20 && side < 60) return 0.05;     // lids and brows
  if (p.y > 0) return side > 30 ? 0.3 : 0.1;  // cheek bones
  return 0.02;                                // lips, chin, jaw
}

}  // namespace

PoseResiduals::PoseResiduals(std::span<const PoseSurface> poses, std::span<RegisteredPose> placed,
                             StageContext& context)
    : poses_(poses),
      placed_(placed),
      context_(context),
      skin_(poses.size(), &context.scratch),
      pivot_(apply(inverse(poses[0].head_from_camera), Vec3d{0, 20, -kHeadCentreMm})) {}

void PoseResiduals::move(std::size_t pose, const Vec3d& rotation, const Vec3d& translation_mm) {
  RigidTransform& placed = placed_[pose].first_from_pose;
  placed = product(small_motion(rotation, translation_mm, pivot_), placed);
}

double PoseResiduals::say_of(PoseResidual& res) const {
  const Vec3d in_head = apply(poses_[0].head_from_camera, res.at);
  res.patch = SkinPatches::at(in_head);
  if (skin_.watched()) return in_head.y < kNeckMm ? 0 : 1;
  return say_in_head(in_head);
}

bool PoseResiduals::meet(std::size_t a, std::size_t k, const Vec3d& normal, std::size_t b,
                         const RegistrationRound& round, PoseResidual& res) const {
  const RigidTransform& placed = placed_[b].first_from_pose;
  const auto hit = poses_[b].look(narrow(apply(inverse(placed), res.at)));
  if (!hit || hit->trust < kLeastTrust) return false;
  const Vec3d n = apply(placed.rotation, wide(hit->normal));
  if (dot(n, normal) < kSameFacing) return false;
  res.value = dot(n, minus(res.at, apply(placed, wide(hit->at_mm))));
  if (std::abs(res.value) > round.reach_mm) return false;
  const PoseSurface& from = poses_[a];
  const double sigma = double(from.sigma_mm[k]), other = double(hit->sigma_mm);
  const double scale = std::max(round.scale_mm, kScaleOfUsual * usual_mm_);
  const double kept = scale * scale / (scale * scale + res.value * res.value);
  res.weight = double(std::min(from.trust[k], hit->trust)) * kept * kept /
               (sigma * sigma + other * other + kSurfaceSigmaMm * kSurfaceSigmaMm);
  const Vec3d turn = cross(minus(res.at, pivot_), n);
  res.toward << turn.x, turn.y, turn.z, n.x, n.y, n.z;
  return true;
}

std::optional<double> PoseResiduals::before_mm(const Vec3d& at, std::size_t b) const {
  const Vec3f place = narrow(apply(inverse(placed_[b].first_from_pose), at));
  const auto hit = poses_[b].look(place);
  if (!hit || hit->trust < kLeastTrust) return std::nullopt;
  return length(hit->at_mm) - length(place);
}

Error meets_no_other_pose(std::size_t pose) {
  return Error{Errc::PoorGeometry,
               "what this pair shows meets none of the others: turn the head by less between two of them"}
      .at("pair " + std::to_string(pose + 1));
}

Error registration_stopped() {
  return {Errc::Cancelled, "stopped while the poses were laid onto each other"};
}

}  // namespace relievo::pipeline
