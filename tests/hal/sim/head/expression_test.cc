// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/sim/head/shape/head_traits.h"

#include <gtest/gtest.h>

#include "hal/sim/head/shape/head_field.h"
#include "tests/support/glasses_scene.h"

namespace relievo::hal::sim {
namespace {

HeadField with(const Expression& expression) {
  HeadTraits t = traits_of(5);
  t.expression = expression;
  return HeadField(t);
}
double front_at(const HeadField& field, double x, double y) {
  double z = 140;
  while (z > 30 && field.distance({x, y, z}) > 0.05) z -= 0.1;
  return z;
}

TEST(Expression, ClosedLidsCoverTheBallAndOpenOnesDoNot) {
  const HeadField open = with({}), shut = with({0, 0, 0, 0}), half = with({0.5, 0, 0, 0});
  const Vec3 c = open.eye.centre();
  EXPECT_LT(front_at(open, c.x, 0), c.z + open.eye.radius() - 3);  // into the opening
  EXPECT_GT(front_at(shut, c.x, 0), c.z + shut.eye.radius());
  EXPECT_NEAR(shut.eye.upper_lid(0), shut.eye.lower_lid(0), 1e-9);
  EXPECT_NEAR(2 * (half.eye.upper_lid(0) - half.eye.lower_lid(0)),
              open.eye.upper_lid(0) - open.eye.lower_lid(0), 1e-9);
}

TEST(Expression, AJawDropsByWhatIsSaidAndLeavesTheUpperLip) {
  const HeadField shut = with({}), open = with({1, 12, 0, 0});
  const double sto = stomion_y(shut.traits);
  EXPECT_LT(front_at(open, 0, sto - 6), front_at(shut, 0, sto - 6) - 12);  // a hole
  EXPECT_NEAR(front_at(open, 0, sto + 12), front_at(shut, 0, sto + 12), 0.3);
  EXPECT_NEAR(front_at(open, 0, gnathion_y(shut.traits) - 2), front_at(shut, 0, gnathion_y(shut.traits) + 10),
              0.5);  // the chin, 12 mm lower
  const double corner = shut.mouth.half_width() + 4;
  EXPECT_NEAR(front_at(open, corner, sto + 3), front_at(shut, corner, sto + 3), 0.3);
}

TEST(Expression, ASmileIsWiderAndItsCornersAreHigher) {
  const HeadField rest = with({}), smile = with({1, 0, 1, 0});
  EXPECT_NEAR(smile.mouth.half_width() / rest.mouth.half_width(), 1.22, 1e-9);
  EXPECT_GT(smile.mouth.line_y(smile.mouth.half_width()), rest.mouth.line_y(rest.mouth.half_width()) + 5);
}

// A grey wall where the face would be.
class Wall final : public Scene {
 public:
  RayHit look(Vec3, Vec3 d) const override { return {{0.3, 0.3, 0.3}, 560 / d.z, 0, false}; }
  bool solid(Vec3, Vec3, SolidPoint&) const override { return true; }
  bool blocked(Vec3, Vec3, double) const override { return false; }
  Mesh solid_mesh() const override { return {}; }
};

// A mirror on the way from the eye to the camera shows the lamp behind it: brighter than what it stands
// before.
TEST(Glasses, MirrorTheLampsAndDimTheRestALittle) {
  HeadPose pose;
  pose.right_mm = 70, pose.yaw_deg = 8;
  const Wearer wearer{{Vec3{31, 0, 74}, {-31, 0, 74}}, 12, 150};
  const auto worn = make_glasses_scene(std::make_unique<Wall>(), wearer, pose, {});
  int glare = 0, dimmed = 0, rim = 0, other = 0;
  for (double x = 25; x < 115; x += 1.5)
    for (double y = -60; y < -10; y += 1.5) {
      const RayHit seen = worn->look({}, normalised({x, y, 545}));
      if (seen.body == 0) continue;
      if (seen.light.y < 0.15) ++rim;
      else if (seen.light.y > 0.5) ++glare;
      else if (seen.light.y > 0.85 * 0.3 && seen.light.y < 0.35) ++dimmed;
      else ++other;
    }
  EXPECT_GT(rim, 60);
  EXPECT_GT(glare, 20);
  EXPECT_GT(dimmed, 5 * glare);
  EXPECT_LT(other, glare);
  Glasses flat;
  flat.curve_mm = 5000;
  pose.yaw_deg = 0;
  EXPECT_EQ(mirrored_mm2(wearer, pose, flat, {}), 0);  // no lamp lies where this mirror looks
}

}  // namespace
}  // namespace relievo::hal::sim
