// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>

#include "hal/base/statistics.h"
#include "pipeline/base/shared_arena.h"
#include "pipeline/fuse/pose_residuals.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

constexpr double kReachMm = 3;       // a surface further off is another one
constexpr double kSameWay = 0.6;     // cosine between the normals of what is taken for the same skin
constexpr float kLeastTrust = 0.2F;  // less is the rim of what was measured
constexpr float kNowhere = std::numeric_limits<float>::quiet_NaN();

// By how much a place of pose `a` lies before what pose `b` shows there.
float distance_mm(const Vec3d& at, const Vec3d& normal, const PoseSurface& b, const RigidTransform& placed) {
  const auto hit = look(b, placed, at);
  if (!hit || hit->own.trust < kLeastTrust) return kNowhere;
  return dot(hit->normal, normal) < kSameWay || std::abs(hit->before_mm) > kReachMm ? kNowhere
                                                                                    : float(hit->before_mm);
}

PoseMeeting meeting_of(std::pmr::vector<float>& distances, double area_mm2) {
  if (distances.empty()) return {};
  double squares = 0;
  for (float& d : distances) {
    squares += double(d) * double(d);
    d = std::abs(d);
  }
  return {area_mm2, std::sqrt(squares / double(distances.size())), percentile(distances, 0.95)};
}

// Of one pose with the others.
void measure_agreement_of(std::size_t a, std::span<const PoseSurface> poses, Registration& registration,
                          SharedArena& memory) {
  const PoseSurface& pose = poses[a];
  const RigidTransform& placed = registration.poses[a].first_from_pose;
  ResidualMap& map = registration.residuals[a];
  std::array<double, kMostPoses> area_mm2{};
  std::pmr::vector<std::pmr::vector<float>> distances(poses.size(), &memory);
  for (std::size_t b = 0; b < poses.size(); ++b)
    if (b != a) distances[b].reserve(map.mm.size());
  for (std::size_t i = 0; i < map.mm.size(); ++i) {
    const std::size_t k = i / std::size_t(map.columns) * kResidualEvery * std::size_t(pose.columns) +
                          i % std::size_t(map.columns) * kResidualEvery;
    const SurfaceHit& node = pose.nodes[k];
    if (node.trust < kLeastTrust) continue;
    const Vec3d at = apply(placed, wide(node.at_mm)), normal = apply(placed.rotation, wide(node.normal));
    const double side_mm = kResidualEvery * pose.step_px * double(node.at_mm.z) / pose.focal_px;
    const double cosine = std::abs(double(dot(node.normal, unit(node.at_mm))));
    float sum = 0, count = 0;
    for (std::size_t b = 0; b < poses.size(); ++b) {
      if (b == a) continue;
      const float d = distance_mm(at, normal, poses[b], registration.poses[b].first_from_pose);
      if (std::isnan(d)) continue;
      distances[b].push_back(d);
      area_mm2[b] += side_mm * side_mm / std::max(cosine, 0.1);
      sum += d, ++count;
    }
    if (count > 0) map.mm[i] = sum / count;
  }
  for (std::size_t b = 0; b < poses.size(); ++b)
    registration.poses[a].meets[b] = meeting_of(distances[b], area_mm2[b]);
}

}  // namespace

void measure_agreement(std::span<const PoseSurface> poses, Registration& registration,
                       StageContext& context) {
  for (const PoseSurface& pose : poses) {
    ResidualMap& map = registration.residuals.emplace_back(&context.output);
    map.columns = (pose.columns + kResidualEvery - 1) / kResidualEvery;
    map.rows = (pose.rows + kResidualEvery - 1) / kResidualEvery;
    map.mm.assign(std::size_t(map.columns) * std::size_t(map.rows), kNowhere);
  }
  SharedArena memory(context.scratch);
  const auto measure = [&](int a) { measure_agreement_of(std::size_t(a), poses, registration, memory); };
  // By one reference: more would be kept in the heap.
  context.pool.for_each_band(int(poses.size()), int(poses.size()),
                             [&measure](int, int, int a) { measure(a); });
}

}  // namespace relievo::pipeline
