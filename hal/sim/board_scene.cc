// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/sim/board_scene.h"

#include "hal/sim/noise.h"

namespace relievo::hal::sim {
namespace {

constexpr double kWhite = 0.62, kBlack = 0.035, kRoom = 0.10;

bool seen_whole(const SimView& view, const BoardPattern& b, const BoardPose& pose) {
  for (const double x : {-1.0, static_cast<double>(b.corners_x)})
    for (const double y : {-1.0, static_cast<double>(b.corners_y)}) {
      const Vec3 p = pose.to_world({x * b.square_mm, y * b.square_mm, 0});
      if (view.depth_mm(p) < 50) return false;
      const Pixel q = view.project(p);
      if (q.x < 6 || q.y < 6 || q.x > view.width_px - 7 || q.y > view.height_px - 7) return false;
    }
  return true;
}

}  // namespace

Result<void> BoardPattern::check() const {
  if (corners_x < 3 || corners_y < 3 || corners_x > 60 || corners_y > 60)
    return Error{Errc::InvalidInput, "a board has between 3 and 60 inner corners a side"};
  if (!(square_mm > 1) || !(square_mm < 500)) return Error{Errc::InvalidInput, "the squares of a board measure between 1 and 500 mm"};
  return {};
}

bool BoardScene::meet(Vec3 origin, Vec3 direction, double& distance, double& x, double& y) const {
  const Mat3 board_from_world = pose_.world_from_board.transposed();
  const Vec3 o = board_from_world * (origin - pose_.origin_mm), d = board_from_world * direction;
  if (std::abs(d.z) < 1e-9) return false;
  distance = -o.z / d.z;
  x = o.x + distance * d.x;
  y = o.y + distance * d.y;
  const double low = -pattern_.square_mm - pattern_.margin_mm;
  return distance > 0 && x > low && y > low && x < pattern_.corners_x * pattern_.square_mm + pattern_.margin_mm &&
         y < pattern_.corners_y * pattern_.square_mm + pattern_.margin_mm;
}

Sight BoardScene::look(Vec3 origin, Vec3 direction) const {
  double distance = 0, x = 0, y = 0;
  if (!meet(origin, direction, distance, x, y)) return {{kRoom, kRoom, kRoom}, RayCaster::kFar, -1, false};
  const double sx = x / pattern_.square_mm, sy = y / pattern_.square_mm;
  const bool printed = sx > -1 && sy > -1 && sx < pattern_.corners_x && sy < pattern_.corners_y;
  const int parity = (static_cast<int>(std::floor(sx)) + static_cast<int>(std::floor(sy))) & 1;
  const Vec3 p = origin + direction * distance;
  const Vec3 normal{pose_.world_from_board.row[0].z, pose_.world_from_board.row[1].z, pose_.world_from_board.row[2].z};
  const double lit = 0.55 + 0.45 * std::abs(dot(normal, normalised(p - Vec3{-200, -200, 0})));
  const double v = (printed && parity == 0 ? kBlack : kWhite) * lit * (1 + 0.01 * value_noise(p * 0.02, 5));
  return {{v, v, v}, distance, printed ? parity : 2, false};
}

bool BoardScene::solid(Vec3 origin, Vec3 direction, SolidPoint& out) const {
  double distance = 0, x = 0, y = 0;
  if (!meet(origin, direction, distance, x, y)) return false;
  out.point = origin + direction * distance;
  out.normal = pose_.world_from_board * Vec3{0, 0, -1};
  out.skin = false;
  return true;
}

Mesh BoardScene::solid_mesh() const {
  const double low = -pattern_.square_mm - pattern_.margin_mm;
  const double right = pattern_.corners_x * pattern_.square_mm + pattern_.margin_mm, bottom = pattern_.corners_y * pattern_.square_mm + pattern_.margin_mm;
  Mesh mesh;
  for (const Vec3 p : {Vec3{low, low, 0}, {right, low, 0}, {right, bottom, 0}, {low, bottom, 0}}) {
    const Vec3 q = pose_.to_world(p);
    mesh.points.push_back({static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z)});
  }
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

Result<std::vector<BoardPose>> good_board_poses(const SimRig& rig, const BoardPattern& b, int count, std::uint32_t seed, double distance_mm) {
  RELIEVO_TRY(b.check());
  Random random(seed + 0xb0a4dULL);
  std::vector<BoardPose> poses;
  const Vec3 middle{(b.corners_x - 1) * b.square_mm / 2, (b.corners_y - 1) * b.square_mm / 2, 0};
  const Vec3 aim = rig.left.ray((rig.left.width_px - 1) / 2.0, (rig.left.height_px - 1) / 2.0);
  for (int tries = 0; static_cast<int>(poses.size()) < count && tries < 20000; ++tries) {
    const auto k = static_cast<int>(poses.size());
    // Tilts go round the compass, so that no direction is left out by chance.
    const double compass = 6.283185307 * k / std::max(count, 1) * 3 + random.uniform(-0.3, 0.3), tilt = k == 0 ? 0.03 : random.uniform(0.25, 0.6);
    const double spread = 1.0 - 0.9 * std::min(1.0, tries / 15000.0);
    BoardPose pose;
    pose.world_from_board = rotation(tilt * std::sin(compass), tilt * std::cos(compass), random.uniform(-0.35, 0.35));
    const Vec3 centre = aim * (distance_mm + random.uniform(-60, 110) + 4e-3 * tries) + Vec3{random.uniform(-70, 70), random.uniform(-42, 42), 0} * spread;
    pose.origin_mm = centre - pose.world_from_board * middle;
    if (seen_whole(rig.left, b, pose) && seen_whole(rig.right, b, pose)) poses.push_back(pose);
  }
  if (static_cast<int>(poses.size()) < count)
    return Error{Errc::PoorGeometry, "this rig does not see the whole board; choose fewer or smaller squares"};
  return poses;
}

}  // namespace relievo::hal::sim
