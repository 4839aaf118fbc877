// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The simulated person: measures of real people, a picture that agrees with its own truth.
#include "hal/sim/head/head_scene.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include "hal/sim/head/shape/head_field.h"
#include "hal/sim/render.h"
#include "tests/hal/temporary_folder.h"

namespace relievo::hal::sim {
namespace {

SimulationOptions small(std::uint32_t seed) {
  SimulationOptions o;
  o.seed = seed;
  o.rig.width_px = 480;
  o.rig.height_px = 300;
  return o;
}

PicturePair pair_of(const SimulationOptions& o, ThreadPool& pool) {
  const auto scene = make_head_scene(make_head(traits_of(o.seed), pool), o.pose, pool);
  return render_pair(*scene, make_rig(o.rig), o.sensor, 1, pool);
}

// Walks along a direction from outside until the field says: skin.
double skin_along(const HeadField& field, Vec3 from, Vec3 direction) {
  double t = 0;
  for (int i = 0; i < 4000; ++i) {
    const double away = field.distance(from + direction * t);
    if (away <= 0.01) break;
    t += std::max(0.05, 0.4 * away);  // the field is no exact distance: short of what it says
  }
  return t;
}
double front_z(const HeadField& field, double x, double y) {
  return 200 - skin_along(field, {x, y, 200}, {0, 0, -1});
}

// Farkas (1994), men and women together, +-2.5 deviations.
TEST(HeadTraits, MeasuresLieInPublishedRanges) {
  for (std::uint32_t seed = 1; seed <= 60; ++seed) {
    const HeadTraits t = traits_of(seed);
    const auto within = [&](double value, double low, double high, const char* name) {
      EXPECT_TRUE(value >= low && value <= high) << name << " " << value << " of " << seed;
    };
    within(t.head_breadth, 131, 166, "eu-eu");
    within(t.face_breadth, 116, 150, "zy-zy");
    within(t.nose_height, 43, 61, "n-sn");
    within(t.nose_width, 25, 44, "al-al");
    within(t.nose_protrusion, 15, 24, "sn-prn");
    within(t.intercanthal, 26, 39, "en-en");
    within(t.eye_fissure, 27, 35, "ex-en");
    within(t.mouth_width, 42, 63, "ch-ch");
    within(kNasionY - gnathion_y(t), 96, 140, "n-gn");
    within(t.ear_height, 50, 72, "sa-sba");
  }
}

TEST(HeadField, TheSurfaceHasTheMeasuresItWasAskedFor) {
  for (const std::uint32_t seed : {1U, 4U, 9U}) {
    const HeadField field(traits_of(seed));
    const HeadTraits& t = field.traits;
    const double breadth =
        300 - skin_along(field, {150, -18, 15}, {-1, 0, 0}) - skin_along(field, {-150, -18, 15}, {1, 0, 0});
    EXPECT_NEAR(breadth, t.face_breadth, 7) << "zy-zy";
    double tip_z = 0;
    for (double y = subnasale_y(t); y < 0; y += 0.5) tip_z = std::max(tip_z, front_z(field, 0, y));
    const double base_z = front_z(field, 0, subnasale_y(t) - 2.5);
    EXPECT_NEAR(tip_z - base_z, std::sqrt(t.nose_protrusion * t.nose_protrusion - 85), 6) << "sn-prn";
    EXPECT_GT(tip_z, front_z(field, 30, -30) + 15) << "the nose stands out";
    EXPECT_LT(front_z(field, 0, kNasionY), front_z(field, 0, 20) + 1)
        << "the root of the nose lies behind the brow";
    EXPECT_GT(field.distance({0, gnathion_y(t) - 8, 100}), 0) << "nothing below the chin";
  }
}

// Mean linear light in the middle of the left picture, which is face.
double light_on_face(const std::shared_ptr<const HeadModel>& head, const HeadPose& pose,
                     const HeadLighting& lighting, ThreadPool& pool) {
  const SimulationOptions o = small(1);
  const LightPicture picture =
      expose(*make_head_scene(head, pose, pool, lighting), make_rig(o.rig).left, o.sensor, pool);
  double sum = 0;
  const int x0 = picture.width_px / 2 - 20, y0 = picture.height_px / 2 - 20;
  for (int y = y0; y < y0 + 40; ++y)
    for (int x = x0; x < x0 + 40; ++x)
      sum += static_cast<double>(picture.rgb[3 * static_cast<std::size_t>(y * picture.width_px + x) + 1]);
  return sum / 1600;
}

TEST(HeadLighting, TheScreenIsALampAsBrightAsItsPage) {
  ThreadPool pool(2);
  const auto head = make_head(traits_of(1), pool);
  const HeadPose pose, near{.distance_mm = 450}, far{.distance_mm = 680};
  const double lamps = light_on_face(head, pose, {}, pool);
  const double half = light_on_face(head, pose, {.screen = 0.5}, pool) - lamps;
  const double whole = light_on_face(head, pose, {.screen = 1}, pool) - lamps;
  EXPECT_GT(whole, 0.03 * lamps);
  EXPECT_LT(whole, 0.3 * lamps) << "a screen is no studio lamp";
  EXPECT_NEAR(whole, 2 * half, 1e-4 * lamps);
  const auto gain = [&](const HeadPose& at) {
    return light_on_face(head, at, {.screen = 1}, pool) - light_on_face(head, at, {}, pool);
  };
  EXPECT_GT(gain(near), 1.4 * gain(far));
}

TEST(HeadPose, AxesTurnAsTheySay) {
  HeadPose pose;
  const Vec3 out = pose.world_from_head() * Vec3{0, 0, 1};
  EXPECT_NEAR(out.z, -1, 1e-12);                                      // faces the camera
  EXPECT_NEAR((pose.world_from_head() * Vec3{1, 0, 0}).x, 1, 1e-12);  // its left is the picture's right
  pose.yaw_deg = 30;
  EXPECT_NEAR((pose.world_from_head() * Vec3{0, 0, 1}).x, 0.5, 1e-9);
  pose = {};
  pose.pitch_deg = 30;
  EXPECT_NEAR((pose.world_from_head() * Vec3{0, 0, 1}).y, 0.5, 1e-9);
}

TEST(HeadScene, SameSeedSamePictureOtherSeedOtherHead) {
  ThreadPool pool(2);
  const PicturePair a = pair_of(small(3), pool), again = pair_of(small(3), pool),
                    other = pair_of(small(4), pool);
  EXPECT_EQ(a.left.bytes, again.left.bytes);
  EXPECT_EQ(a.right.bytes, again.right.bytes);
  double difference = 0;
  for (std::size_t i = 0; i < a.left.bytes.size(); ++i)
    difference += std::abs(std::to_integer<int>(a.left.bytes[i]) - std::to_integer<int>(other.left.bytes[i]));
  EXPECT_GT(difference / static_cast<double>(a.left.bytes.size()), 5);
}

TEST(HeadScene, HeadsDifferInShapeNotOnlyInColour) {
  std::vector<std::vector<double>> people;
  for (std::uint32_t s = 1; s <= 12; ++s) {
    const HeadField field(traits_of(s));
    std::vector<double>& relief = people.emplace_back();
    for (double y = -110; y <= 60; y += 10)
      for (double x = -50; x <= 50; x += 10) relief.push_back(front_z(field, x, y));
  }
  for (std::size_t i = 0; i < people.size(); ++i)
    for (std::size_t j = i + 1; j < people.size(); ++j) {
      double sum = 0;
      for (std::size_t k = 0; k < people[i].size(); ++k) sum += std::abs(people[i][k] - people[j][k]);
      EXPECT_GT(sum / static_cast<double>(people[i].size()), 0.6) << i + 1 << " and " << j + 1;
    }
}

// Every pixel that truth calls seen by both, carried over by its depth, must look the same there.
TEST(Truth, CarriesTheLeftPictureOntoTheRight) {
  ThreadPool pool(2);
  SimulationOptions o = small(2);
  o.sensor.noise = 0;
  const auto scene = make_head_scene(make_head(traits_of(o.seed), pool), o.pose, pool);
  const SimRig rig = make_rig(o.rig);
  const PicturePair pair = render_pair(*scene, rig, o.sensor, 1, pool);
  const Truth truth = measure_truth(*scene, rig, pool);
  const int all = Truth::kSkin | Truth::kSeenByBoth | Truth::kNotGrazing;
  double right_place = 0, three_px_off = 0;
  int count = 0;
  for (int y = 0; y < truth.height_px; ++y)
    for (int x = 0; x < truth.width_px; ++x) {
      if ((truth.flags[truth.at(x, y)] & all) != all) continue;
      const Vec3 ray = rig.left.ray(x, y);
      const Pixel q = rig.right.project(ray * (static_cast<double>(truth.depth_mm[truth.at(x, y)]) / ray.z));
      const int u = static_cast<int>(std::lround(q.x)), v = static_cast<int>(std::lround(q.y));
      if (u + 3 >= truth.width_px) continue;
      const auto green = [](const Picture& p, int px, int py) {
        return static_cast<double>(p.view().row(py)[3 * px + 1]);
      };
      right_place += std::abs(green(pair.left, x, y) - green(pair.right, u, v));
      three_px_off += std::abs(green(pair.left, x, y) - green(pair.right, u + 3, v));
      ++count;
    }
  ASSERT_GT(count, 10000);
  EXPECT_LT(right_place / count, 4.5);
  EXPECT_LT(right_place, 0.75 * three_px_off);
}

TEST(Truth, FilesHaveTheirSizes) {
  const TemporaryFolder folder;
  SimulationOptions o = small(1);
  o.truth = true;
  ASSERT_TRUE(render_to_folder(o, folder.path()));
  for (const char* name : {"left.png", "right.png", "rig.yml", "truth.bin", "head.ply"})
    EXPECT_TRUE(std::filesystem::exists(folder / name)) << name;
  EXPECT_EQ(std::filesystem::file_size(folder / "truth.bin"), std::strlen("480 300 z\n") + 480U * 300U * 5U);
}

TEST(Visit, IsAFolderForEachTurnAndBeginsWithTheFaceFromInFront) {
  const TemporaryFolder folder;
  SimulationOptions face = small(1);
  face.rig.width_px = 240, face.rig.height_px = 150;
  SimulationOptions visit = face;
  visit.scene = SceneKind::Visit;
  visit.drift = 0;  // a head is made once
  ASSERT_TRUE(render_to_folder(visit, folder / "visit"));
  ASSERT_TRUE(render_to_folder(face, folder / "face"));
  const auto bytes = [&](const std::filesystem::path& file) {
    std::ifstream in(folder.path() / file, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  EXPECT_EQ(bytes("visit/0/left.png"), bytes("face/left.png"));
  std::set<std::string> different;
  for (int k = 0; k < 6; ++k) {
    const std::filesystem::path own = "visit/" + std::to_string(k);
    EXPECT_EQ(bytes(own / "rig.yml"), bytes("face/rig.yml")) << k;
    different.insert(bytes(own / "left.png"));
    different.insert(bytes(own / "right.png"));
  }
  EXPECT_EQ(different.size(), 12U);
  EXPECT_EQ(different.count(""), 0U);
}

}  // namespace
}  // namespace relievo::hal::sim
