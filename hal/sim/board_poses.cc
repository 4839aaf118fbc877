// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "hal/sim/base/noise.h"
#include "hal/sim/board_scene.h"

namespace relievo::hal::sim {
namespace {

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

Result<std::vector<BoardPose>> good_board_poses(const SimRig& rig, const BoardPattern& b, int count,
                                                std::uint32_t seed, double distance_mm) {
  RELIEVO_TRY(b.check());
  Random random(seed + 0xb0a4dULL);
  std::vector<BoardPose> poses;
  const Vec3 middle{(b.corners_x - 1) * b.square_mm / 2, (b.corners_y - 1) * b.square_mm / 2, 0};
  const Vec3 aim = rig.left.ray((rig.left.width_px - 1) / 2.0, (rig.left.height_px - 1) / 2.0);
  for (int tries = 0; static_cast<int>(poses.size()) < count && tries < 20000; ++tries) {
    const auto k = static_cast<int>(poses.size());
    // Tilts go round the compass, so that no direction is left out by chance.
    const double compass = 6.283185307 * k / std::max(count, 1) * 3 + random.uniform(-0.3, 0.3),
                 tilt = k == 0 ? 0.03 : random.uniform(0.25, 0.6);
    const double spread = 1.0 - 0.9 * std::min(1.0, tries / 15000.0);
    BoardPose pose;
    pose.world_from_board =
        rotation(tilt * std::sin(compass), tilt * std::cos(compass), random.uniform(-0.35, 0.35));
    const Vec3 centre = aim * (distance_mm + random.uniform(-60, 110) + 4e-3 * tries) +
                        Vec3{random.uniform(-70, 70), random.uniform(-42, 42), 0} * spread;
    pose.origin_mm = centre - pose.world_from_board * middle;
    if (seen_whole(rig.left, b, pose) && seen_whole(rig.right, b, pose)) poses.push_back(pose);
  }
  if (static_cast<int>(poses.size()) < count)
    return Error{Errc::PoorGeometry,
                 "this rig does not see the whole board; choose fewer or smaller squares"};
  return poses;
}

}  // namespace relievo::hal::sim
