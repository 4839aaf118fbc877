// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/gate/relief/live_relief.h"
#include "hal/base/statistics.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>

#include <vector>

#include "hal/sim/render.h"
#include "hal/sim/target/target_photo.h"
#include "pipeline/base/workspace.h"
#include "tests/support/rig_calibration.h"
#include "tests/support/small_rig.h"

namespace relievo::pipeline {
namespace {

namespace sim = hal::sim;

constexpr std::size_t kOutput = std::size_t{8} << 20, kScratch = std::size_t{48} << 20;

// Two speckled plates, one before the other: what a hand before a face is, with every depth known.
class Plates final : public sim::Scene {
 public:
  Plates() : near_({90, 70, 5}, place(70, 400)), far_({240, 180, 6}, place(50, 560)) {}
  sim::RayHit look(sim::Vec3 o, sim::Vec3 d) const override {
    const sim::RayHit a = near_.look(o, d);
    return a.body >= 0 ? a : far_.look(o, d);
  }
  bool solid(sim::Vec3 o, sim::Vec3 d, sim::SolidPoint& out) const override {
    return near_.solid(o, d, out) || far_.solid(o, d, out);
  }
  bool blocked(sim::Vec3, sim::Vec3, double) const override { return false; }
  sim::Mesh solid_mesh() const override { return far_.solid_mesh(); }

 private:
  static sim::BodyPose place(double right_mm, double distance_mm) {
    return {sim::rotation(sim::radians(8), sim::radians(12), 0), {right_mm - 50, 0, distance_mm}};
  }
  sim::PlateScene near_, far_;
};

struct Photographed {
  Photographed() {
    ThreadPool pool(2);
    rig = sim::make_rig(test::small_rig(0.25));
    pictures = sim::render_pair(scene, rig, {}, 3, pool);
    calibration = test::true_calibration(rig);
  }
  StereoFrame frame() const { return {pictures.left.view(), pictures.right.view()}; }
  Plates scene;
  sim::SimRig rig;
  sim::PicturePair pictures;
  StereoCalibration calibration;
};
const Photographed& photographed() {
  static const Photographed once;
  return once;
}

LiveRelief small() {
  LiveRelief options;
  options.reduction = 1;  // the pictures are a quarter of the rig's already
  return options;
}

Result<Relief> look(Workspace& work, const LiveRelief& options = small()) {
  const Photographed& p = photographed();
  return run_stage(work.context, [&](StageContext& c) { return options.look(p.frame(), p.calibration, c); });
}

TEST(LiveRelief, IsTrueToTheMillimetreAndKeepsTwoSurfacesApart) {
  Workspace work(2, kOutput, kScratch);
  const auto relief = look(work);
  ASSERT_TRUE(relief) << relief.error().what.view();
  const Photographed& p = photographed();
  std::vector<double> off;
  int seen = 0, known = 0;
  std::vector<long> near_names(std::size_t{*std::ranges::max_element(relief->surface)} + 1),
      far_names = near_names;
  for (int y = 0; y < relief->height_px; ++y)
    for (int x = 0; x < relief->width_px; ++x) {
      const Vec3d ray = apply(
          transposed(relief->rectified_from_left),
          {(x - relief->centre_px.x) / relief->focal_px, (y - relief->centre_px.y) / relief->focal_px, 1});
      sim::SolidPoint truth;
      if (!p.scene.solid({0, 0, 0}, sim::normalised({ray.x, ray.y, ray.z}), truth)) continue;
      const double z = apply(relief->rectified_from_left, {truth.point.x, truth.point.y, truth.point.z}).z;
      ++seen;
      if (!relief->known(x, y)) continue;
      ++known;
      off.push_back(std::abs(static_cast<double>(relief->depth_mm[relief->index(x, y)]) - z));
      if (off.back() < 20) ++(z < 480 ? near_names : far_names)[relief->surface[relief->index(x, y)]];
    }
  ASSERT_GT(seen, 20000);
  EXPECT_GT(known, seen * 8 / 10);  // the strip that only one camera sees is not known
  EXPECT_LT(median(off), 1.0) << "mm";
  EXPECT_LT(percentile(off, 0.9), 4.0) << "nine of ten, mm";
  const auto most = [](const std::vector<long>& names) {
    return std::max_element(names.begin(), names.end()) - names.begin();
  };
  EXPECT_NE(most(near_names), most(far_names));
  EXPECT_GT(near_names[static_cast<std::size_t>(most(near_names))], 4000);
  EXPECT_EQ(near_names[static_cast<std::size_t>(most(far_names))], 0);
}

TEST(LiveRelief, IsTheSameForAnyNumberOfThreadsAndTwice) {
  Workspace one(1, kOutput, kScratch), three(3, kOutput, kScratch);
  const auto a = look(one), b = look(three), c = look(three);
  ASSERT_TRUE(a && b && c);
  EXPECT_EQ(a->depth_mm, b->depth_mm);
  EXPECT_EQ(a->surface, b->surface);
  EXPECT_EQ(b->depth_mm, c->depth_mm);
}

TEST(LiveRelief, SaysWhenMemoryEnds) {
  Workspace whole(1, kOutput, kScratch);
  ASSERT_TRUE(look(whole));
  for (const double share : {0.1, 0.5, 0.95}) {
    Workspace work(1, kOutput,
                   static_cast<std::size_t>(share * static_cast<double>(whole.scratch.high_water())));
    const auto relief = look(work);
    ASSERT_FALSE(relief) << share;
    EXPECT_EQ(relief.error().code, Errc::OutOfMemory);
  }
}

TEST(LiveRelief, RefusesWhatItCannotUse) {
  Workspace work(1, kOutput, kScratch);
  const Photographed& p = photographed();
  const auto code = [&](const StereoFrame& frame, const LiveRelief& options) {
    const auto relief =
        run_stage(work.context, [&](StageContext& c) { return options.look(frame, p.calibration, c); });
    return relief ? Errc::InvalidState : relief.error().code;
  };
  EXPECT_EQ(code({}, small()), Errc::InvalidInput);
  StereoFrame cut = p.frame();
  cut.right.height_px -= 4;
  EXPECT_EQ(code(cut, small()), Errc::InvalidInput);
  LiveRelief options = small();
  options.reduction = 0;
  EXPECT_EQ(code(p.frame(), options), Errc::InvalidInput);
  work.cancelled = true;
  EXPECT_EQ(code(p.frame(), small()), Errc::Cancelled);
}

TEST(SmallPair, EveryPixelIsTheMeanOfItsSquareInEveryFormat) {
  Workspace work(2, 1 << 16, 1 << 20);
  const int w = 13, h = 10, factor = 3;  // one column and one row are left over
  std::vector<std::uint8_t> rgb(static_cast<std::size_t>(3 * w * h));
  std::vector<std::uint16_t> deep(static_cast<std::size_t>(w * h));
  for (std::size_t i = 0; i < rgb.size(); ++i) rgb[i] = static_cast<std::uint8_t>(i * 37 % 256);
  for (std::size_t i = 0; i < deep.size(); ++i) deep[i] = static_cast<std::uint16_t>(i * 7919 % 65536);
  const ImageView colour = reduced(
      {reinterpret_cast<const std::byte*>(rgb.data()), w, h, 3 * w, PixelFormat::Rgb8}, factor, work.context);
  const ImageView grey =
      reduced({reinterpret_cast<const std::byte*>(deep.data()), w, h, 2 * w, PixelFormat::Grey16}, factor,
              work.context);
  ASSERT_EQ(colour.width_px, 4);
  ASSERT_EQ(colour.height_px, 3);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 4; ++x) {
      double green = 0, light = 0;
      for (int j = 0; j < factor; ++j)
        for (int i = 0; i < factor; ++i) {
          const auto at = static_cast<std::size_t>((y * factor + j) * w + x * factor + i);
          green += rgb[3 * at + 1] / 9.0;
          light += deep[at] / 9.0;
        }
      EXPECT_NEAR(colour.row(y)[3 * x + 1], green, 0.56);
      EXPECT_NEAR(reinterpret_cast<const std::uint16_t*>(grey.row(y))[x], light, 0.56);
    }
}

TEST(SmallPair, TheSmallCalibrationSeesWhatTheSquareSaw) {
  StereoCalibration large;
  large.left.focal_px = {2950, 2940};
  large.left.centre_px = {959.5, 601.25};
  large.left.width_px = 1920, large.left.height_px = 1200;
  const StereoCalibration small = reduced(large, 4);
  // A ray through the middle of a square of 4 x 4 pixels goes through the middle of its pixel.
  const double x = 0.17, y = -0.08;
  EXPECT_NEAR((large.left.focal_px.x * x + large.left.centre_px.x + 0.5) / 4,
              small.left.focal_px.x * x + small.left.centre_px.x + 0.5, 1e-9);
  EXPECT_NEAR((large.left.focal_px.y * y + large.left.centre_px.y + 0.5) / 4,
              small.left.focal_px.y * y + small.left.centre_px.y + 0.5, 1e-9);
  EXPECT_EQ(small.left.width_px, 480);
}

}  // namespace
}  // namespace relievo::pipeline
