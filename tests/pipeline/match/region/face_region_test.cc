// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

#include "hal/picture_file.h"
#include "pipeline/match/region/face_region.h"
#include "tests/pipeline/mesh/stage_room.h"
#include "tests/pipeline/mesh/truth_cloud.h"

namespace relievo::pipeline {
namespace {

bool cascades_installed() { return std::filesystem::exists(kCascadeFolder); }

RectifiedPair blank_pair(int width, int height) {
  RectifiedPair pair(std::pmr::get_default_resource());
  pair.width_px = width;
  pair.height_px = height;
  return pair;
}

TEST(FaceFinder, AForeignCascadeIsNotParsed) {
  const std::filesystem::path dir = std::filesystem::path(testing::TempDir()) / "foreign_cascades";
  std::filesystem::create_directories(dir);
  for (const char* name : {"alt2", "default", "alt"})
    std::ofstream(dir / (std::string("haarcascade_frontalface_") + name + ".xml")) << "<opencv_storage/>";
  const auto finder = FaceFinder::open(dir.string());
  ASSERT_FALSE(finder);
  EXPECT_EQ(finder.error().code, Errc::StoreCorrupt);
  std::filesystem::remove_all(dir);
}

TEST(FaceFinder, MissingCascadesSayWhatToInstall) {
  const auto finder = FaceFinder::open("/nonexistent");
  ASSERT_FALSE(finder);
  EXPECT_EQ(finder.error().code, Errc::NotFound);
  EXPECT_NE(finder.error().what.view().find("opencv-data"), std::string_view::npos);
}

TEST(FaceFinder, NoFaceInNoiseAndNoneInNothing) {
  if (!cascades_installed()) GTEST_SKIP() << "opencv-data is not installed";
  auto finder = FaceFinder::open();
  ASSERT_TRUE(finder);
  std::vector<std::byte> pixels(640 * 480);
  std::mt19937 random(1);
  for (std::byte& b : pixels) b = static_cast<std::byte>(random() & 0xFF);
  const auto noise = finder->find({pixels.data(), 640, 480, 640, PixelFormat::Grey8});
  ASSERT_FALSE(noise);
  EXPECT_EQ(noise.error().code, Errc::NoFace);
  const auto nothing = finder->find({});
  ASSERT_FALSE(nothing);
  EXPECT_EQ(nothing.error().code, Errc::InvalidInput);
  const std::atomic<bool> cancelled{true};
  const auto stopped = finder->find({pixels.data(), 640, 480, 640, PixelFormat::Grey8}, &cancelled);
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, Errc::Cancelled);
  const auto speck = finder->find({pixels.data(), 1, 1, 1, PixelFormat::Grey8});
  EXPECT_FALSE(speck);
}

// The judged face of each rendered head lies inside the region that is marked for it.
TEST(FaceFinder, TheRegionHoldsTheRenderedFaces) {
  if (!cascades_installed()) GTEST_SKIP() << "opencv-data is not installed";
  auto finder = FaceFinder::open();
  ASSERT_TRUE(finder);
  for (const char* name : {"d1", "d2", "d3"}) {
    const auto dir = rendered_head(name);
    if (!dir) GTEST_SKIP() << "RELIEVO_TEST_DATA does not name the rendered heads";
    const auto picture = hal::read_picture(*dir / "left.png");
    ASSERT_TRUE(picture);
    const auto box = finder->find(picture->view());
    ASSERT_TRUE(box) << name;
    RectifiedPair pair = blank_pair(picture->width_px, picture->height_px);
    StageRoom room;
    ASSERT_TRUE(mark_face_region(pair, *box, room.context));
    TruthOptions options;
    options.flags = 1;
    const PointCloud skin = truth_cloud(*dir, options);
    Vec3f tip{0, 0, 1e9F};
    for (const CloudPoint& p : skin.points)
      if (p.at_mm.z < tip.z) tip = p.at_mm;
    std::size_t inside = 0;
    std::size_t all = 0;
    for (const CloudPoint& p : skin.points) {
      if (std::hypot(p.at_mm.x - tip.x, p.at_mm.y - tip.y, p.at_mm.z - tip.z) > 115) continue;
      ++all;
      inside += pair.region[static_cast<std::size_t>(p.left_px.y) * static_cast<std::size_t>(pair.width_px) +
                            static_cast<std::size_t>(p.left_px.x)];
    }
    EXPECT_GT(static_cast<double>(inside), 0.999 * static_cast<double>(all)) << name;
  }
}

TEST(FaceRegion, AnEllipseAroundTheFaceCutAtTheBorder) {
  StageRoom room;
  RectifiedPair pair = blank_pair(400, 300);
  ASSERT_TRUE(mark_face_region(pair, {{100, 150}, 100, 50}, room.context));
  const auto at = [&](int x, int y) {
    return pair.region[static_cast<std::size_t>(y) * 400 + static_cast<std::size_t>(x)];
  };
  EXPECT_EQ(at(100, 150), 1);
  EXPECT_EQ(at(100 + 77, 160), 1) << "115 mm beside the nose";
  EXPECT_EQ(at(100, 160 + 77), 1);
  EXPECT_EQ(at(399, 150), 0);
  EXPECT_EQ(at(100, 299), 0);
  ASSERT_TRUE(mark_face_region(pair, {{-50, -40}, 100, 50}, room.context));
  EXPECT_EQ(at(0, 0), 1);
  EXPECT_EQ(at(399, 299), 0);
  ASSERT_TRUE(mark_face_region(pair, {{-5000, -4000}, 100, 50}, room.context));
  EXPECT_EQ(std::count(pair.region.begin(), pair.region.end(), 1), 0);
}

TEST(FaceRegion, WhatCannotBeMarked) {
  StageRoom room;
  RectifiedPair pair = blank_pair(0, 0);
  EXPECT_FALSE(mark_face_region(pair, {{100, 150}, 100, 50}, room.context));
  pair = blank_pair(400, 300);
  EXPECT_FALSE(mark_face_region(pair, {{100, 150}, 0, 50}, room.context));
  EXPECT_FALSE(mark_face_region(pair, {{std::nan(""), 150}, 10, 50}, room.context));
  room.cancelled = true;
  const auto cancelled = mark_face_region(pair, {{100, 150}, 100, 50}, room.context);
  ASSERT_FALSE(cancelled);
  EXPECT_EQ(cancelled.error().code, Errc::Cancelled);
  StageRoom tiny(100, 100);
  const auto small = tiny.run([&](StageContext& c) -> Result<void> {
    RectifiedPair in_arena(&c.output);
    in_arena.width_px = 400;
    in_arena.height_px = 300;
    return mark_face_region(in_arena, {{100, 150}, 100, 50}, c);
  });
  ASSERT_FALSE(small);
  EXPECT_EQ(small.error().code, Errc::OutOfMemory);
}

}  // namespace
}  // namespace relievo::pipeline
