// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The simulated cameras: what goes out through the lens comes back, and pictures show what is where.
#include "hal/sim/optics/rig.h"

#include <gtest/gtest.h>

#include "hal/base/whole_file.h"
#include "hal/sim/board_scene.h"
#include "hal/sim/render.h"
#include "tests/hal/temporary_folder.h"

namespace relievo::hal::sim {
namespace {

RigOptions small_rig() {
  RigOptions o;
  o.width_px = 640;
  o.height_px = 400;
  return o;
}

TEST(SimRig, ProjectionUndoesTheRay) {
  const SimRig rig = make_rig(small_rig());
  for (const SimView* view : {&rig.left, &rig.right})
    for (int y = 0; y < 400; y += 57)
      for (int x = 0; x < 640; x += 71) {
        const Pixel back = view->project(view->centre() + view->ray(x, y) * 500);
        EXPECT_NEAR(back.x, x, 1e-7);
        EXPECT_NEAR(back.y, y, 1e-7);
      }
}

TEST(SimRig, BothCamerasLookAtTheMeetingPointFromTheBaseline) {
  RigOptions o = small_rig();
  o.perturbation = 0;
  const SimRig rig = make_rig(o);
  const Vec3 meeting{0, 0, 560 / std::cos(std::atan(70.0 / 560))};
  const Pixel l = rig.left.project(meeting), r = rig.right.project(meeting);
  EXPECT_NEAR(l.x, rig.left.cx_px, 0.5);
  EXPECT_NEAR(r.x, rig.right.cx_px, 0.5);
  EXPECT_NEAR(r.y, rig.right.cy_px, 0.5);
  EXPECT_NEAR(length(rig.right.centre()), 140, 1e-9);
}

TEST(SimRig, TheSeedIsTheRig) {
  RigOptions a = small_rig(), b = small_rig();
  b.seed = 2;
  EXPECT_EQ(make_rig(a).left.fx_px, make_rig(a).left.fx_px);
  EXPECT_NE(make_rig(a).left.fx_px, make_rig(b).left.fx_px);
}

TEST(SimRig, WritesTheKeysOfOpenCvsStereoSample) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_rig(folder / "rig.yml", make_rig(small_rig())));
  const auto bytes = read_whole_file(folder / "rig.yml", 1 << 20);
  ASSERT_TRUE(bytes);
  const std::string text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  EXPECT_TRUE(text.starts_with("%YAML:1.0"));
  for (const char* key : {"image_width: 640", "image_height: 400", "K1:", "D1:", "K2:", "D2:", "R:", "T:"})
    EXPECT_NE(text.find(key), std::string::npos) << key;
}

// Where black meets white in both directions: the centre of the local checker pattern, by symmetry.
double saddle_error(const Picture& picture, Pixel at) {
  const ImageView view = picture.view();
  const auto value = [&](double x, double y) {
    const int u = static_cast<int>(std::floor(x)), v = static_cast<int>(std::floor(y));
    const double a = x - u, b = y - v;
    return (1 - b) * ((1 - a) * view.row(v)[u] + a * view.row(v)[u + 1]) +
           b * ((1 - a) * view.row(v + 1)[u] + a * view.row(v + 1)[u + 1]);
  };
  double best = 1e9, best_x = 0, best_y = 0;
  for (double dy = -1.5; dy <= 1.5; dy += 0.05)
    for (double dx = -1.5; dx <= 1.5; dx += 0.05) {
      double sum = 0;
      for (int k = 1; k <= 4; ++k)
        for (int j = -4; j <= 4; ++j) {
          const double d = value(at.x + dx + k, at.y + dy + j) - value(at.x + dx - k, at.y + dy - j);
          sum += d * d;
        }
      if (sum < best) best = sum, best_x = dx, best_y = dy;
    }
  return std::hypot(best_x, best_y);
}

TEST(BoardScene, CornersAreWhereTheLensPutsThem) {
  const SimRig rig = make_rig(small_rig());
  const BoardPattern pattern;
  const auto poses = good_board_poses(rig, pattern, 2, 3);
  ASSERT_TRUE(poses);
  ThreadPool pool(2);
  SensorOptions sensor;
  sensor.noise = 0;
  sensor.grey = true;
  for (const BodyPose& pose : *poses) {
    const PicturePair pair = render_pair(BoardScene(pattern, pose), rig, sensor, 1, pool);
    for (int y = 0; y < pattern.corners_y; y += 3)
      for (int x = 0; x < pattern.corners_x; x += 3) {
        const Vec3 corner = pose.to_world({x * pattern.square_mm, y * pattern.square_mm, 0});
        EXPECT_LT(saddle_error(pair.left, rig.left.project(corner)), 0.25) << x << "," << y;
        EXPECT_LT(saddle_error(pair.right, rig.right.project(corner)), 0.25) << x << "," << y;
      }
  }
}

TEST(BoardScene, FourteenPosesTiltAllWays) {
  const SimRig rig = make_rig(small_rig());
  const auto poses = good_board_poses(rig, {}, 14, 1);
  ASSERT_TRUE(poses);
  ASSERT_EQ(poses->size(), 14U);
  int left = 0, up = 0;
  for (const BodyPose& p : *poses) {
    left += p.world_from_body.row[0].z > 0.1 ? 1 : 0;
    up += p.world_from_body.row[1].z > 0.1 ? 1 : 0;
  }
  EXPECT_GE(left, 3);
  EXPECT_LE(left, 11);
  EXPECT_GE(up, 3);
  EXPECT_LE(up, 11);
}

}  // namespace
}  // namespace relievo::hal::sim
