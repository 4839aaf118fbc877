// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tables 1 and 2 of Bardsley (2004), done again: a virtual rig whose baseline is 20 units is calibrated from
// pictures of a board (there: 19.284 units, focal lengths 771.6 and 770.6 px), and the corners of a cube of
// 25 units at a distance of 66 units, matched by hand, are found within one unit. A unit is 10 mm here.
//   test_pipeline --gtest_filter='Dissertation.*' prints what we find.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "hal/sim/render.h"
#include "pipeline/algorithms.h"
#include "pipeline/calibrate/calibrator.h"
#include "pipeline/match/rectify/rectifier.h"
#include "tests/support/stage_bench.h"

namespace relievo::pipeline {
namespace {

constexpr double kUnitMm = 10;
constexpr double kBaselineUnits = 20;
constexpr double kFocalPx = 771;
constexpr double kCubeUnits = 25;
constexpr double kDistanceUnits = 66;
constexpr int kViews = 8;

hal::sim::SimulationOptions virtual_rig() {
  hal::sim::SimulationOptions o;
  o.scene = hal::sim::SceneKind::Board;
  o.rig.width_px = 640;
  o.rig.height_px = 480;
  o.rig.focal_px = kFocalPx * 1920 / 640;
  o.rig.baseline_mm = kBaselineUnits * kUnitMm;
  o.rig.convergence_mm = kDistanceUnits * kUnitMm;
  o.rig.perturbation = 0;  // exactly what is said above
  return o;
}

const BoardPattern kPattern{10, 7, 20};

Result<CalibratorOutput> calibrate_by_pictures(const hal::sim::SimulationOptions& o,
                                               const hal::sim::SimRig& rig, ThreadPool& pool) {
  RELIEVO_TRY_ASSIGN(const auto poses, hal::sim::good_board_poses(rig, o.board, kViews, 1));
  CalibratorInput input{kPattern, o.rig.width_px, o.rig.height_px, {}};
  for (std::size_t v = 0; v < poses.size(); ++v) {
    const hal::sim::BoardScene scene(o.board, poses[v], o.board_look);
    const auto corners = [&](const hal::sim::SimView& view, std::uint64_t noise_seed) {
      const hal::Picture picture =
          hal::sim::read_sensor(hal::sim::expose(scene, view, o.sensor, pool), o.sensor, noise_seed);
      auto found = find_board(picture.view(), kPattern);
      return found ? std::move(*found) : BoardCorners{};
    };
    input.views.push_back({std::to_string(v), corners(rig.left, 2 * v), corners(rig.right, 2 * v + 1)});
  }
  return calibrate(input);
}

double baseline_mm(const StereoCalibration& c) {
  const Vec3d& t = c.right_from_left.translation_mm;
  return std::sqrt(t.x * t.x + t.y * t.y + t.z * t.z);
}

// The direction that a pixel sees: the estimated lens undone by fixed-point steps.
Vec3d straight(const CameraIntrinsics& c, double u, double v) {
  const double xd = (u - c.centre_px.x) / c.focal_px.x;
  const double yd = (v - c.centre_px.y) / c.focal_px.y;
  double x = xd;
  double y = yd;
  for (int i = 0; i < 50; ++i) {
    const double* k = c.distortion;
    const double r2 = x * x + y * y;
    const double radial = 1 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]));
    x = (xd - 2 * k[2] * x * y - k[3] * (r2 + 2 * x * x)) / radial;
    y = (yd - k[2] * (r2 + 2 * y * y) - 2 * k[3] * x * y) / radial;
  }
  return {x, y, 1};
}

// Eight corners, the cube turned so that three faces look at the cameras.
std::vector<hal::sim::Vec3> cube_corners(const hal::sim::SimRig& rig) {
  const hal::sim::Mat3 turn = hal::sim::rotation(0.45, 0.6, 0.1);
  const hal::sim::Vec3 middle = rig.right.centre() * 0.5 + hal::sim::Vec3{0, 0, kDistanceUnits * kUnitMm};
  std::vector<hal::sim::Vec3> corners;
  const double half = 0.5 * kCubeUnits * kUnitMm;
  for (int i = 0; i < 8; ++i)
    corners.push_back(turn * hal::sim::Vec3{(i & 1) != 0 ? half : -half, (i & 2) != 0 ? half : -half,
                                            (i & 4) != 0 ? half : -half} +
                      middle);
  return corners;
}

// A hand's click in the photograph: on a whole pixel, half a pixel of tremble.
class Hand {
 public:
  double click(double at) { return std::round(at + tremble_(random_)); }

 private:
  std::mt19937 random_{7};
  std::normal_distribution<double> tremble_{0, 0.5};
};

// The two clicks as a match of the rectified pair.
Match match_of(const RectifiedPair& pair, const StereoCalibration& c, const hal::sim::Pixel& left,
               const hal::sim::Pixel& right) {
  const auto on_window = [&pair](const Rotation& rotation, const Vec3d& ray, const Vec2d& centre) {
    const Vec3d p = apply(rotation, ray);
    return Vec2d{pair.focal_px * p.x / p.z + centre.x, pair.focal_px * p.y / p.z + centre.y};
  };
  const Vec2d l = on_window(pair.rectified_from_left, straight(c.left, left.x, left.y), pair.left_centre_px);
  const Vec2d r =
      on_window(pair.rectified_from_right, straight(c.right, right.x, right.y), pair.right_centre_px);
  return {.left_px = {static_cast<float>(l.x), static_cast<float>(l.y)},
          .disparity_px = static_cast<float>(l.x - r.x),
          .sigma_px = 0.5F};
}

struct Found {
  double worst_units = 0, rms_units = 0, side_units = 0;
};

// Corners by hand against where they truly are; the mean length of the twelve edges.
Found judge(const PointCloud& cloud, const std::vector<hal::sim::Vec3>& truth) {
  Found f;
  double squares = 0;
  const auto apart = [](const auto& a, const auto& b) {
    return std::hypot(static_cast<double>(a.x) - b.x, static_cast<double>(a.y) - b.y,
                      static_cast<double>(a.z) - b.z) /
           kUnitMm;
  };
  std::printf("  corner   true x, y, z                found\n");
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const auto& p = cloud.points[i].at_mm;
    const double off = apart(p, truth[i]);
    std::printf("  %zu      %7.2f %7.2f %7.2f    %7.2f %7.2f %7.2f   off by %.2f\n", i + 1,
                truth[i].x / kUnitMm, truth[i].y / kUnitMm, truth[i].z / kUnitMm,
                static_cast<double>(p.x) / kUnitMm, static_cast<double>(p.y) / kUnitMm,
                static_cast<double>(p.z) / kUnitMm, off);
    f.worst_units = std::max(f.worst_units, off);
    squares += off * off;
  }
  f.rms_units = std::sqrt(squares / static_cast<double>(truth.size()));
  int edges = 0;
  for (std::size_t i = 0; i < 8; ++i)
    for (const std::size_t bit : {1U, 2U, 4U})
      if ((i & bit) == 0) {
        f.side_units += apart(cloud.points[i].at_mm, cloud.points[i | bit].at_mm);
        ++edges;
      }
  f.side_units /= edges;
  return f;
}

Result<PointCloud> reconstruct(const StereoCalibration& c, const hal::sim::SimRig& rig,
                               const std::vector<hal::sim::Vec3>& corners, const char* triangulator,
                               test::StageBench& bench) {
  const std::vector<std::byte> blank(static_cast<std::size_t>(c.left.width_px) *
                                     static_cast<std::size_t>(c.left.height_px));
  const ImageView view{blank.data(), c.left.width_px, c.left.height_px, c.left.width_px, PixelFormat::Grey8};
  RELIEVO_TRY_ASSIGN(const RectifiedPair pair,
                     Rectifier({.near_mm = 400, .far_mm = 950}).rectify({view, view}, c, bench.context));
  MatchSet matches(&bench.output);
  Hand hand;
  for (const hal::sim::Vec3& corner : corners) {
    const hal::sim::Pixel l = rig.left.project(corner);
    const hal::sim::Pixel r = rig.right.project(corner);
    matches.matches.push_back(
        match_of(pair, c, {hand.click(l.x), hand.click(l.y)}, {hand.click(r.x), hand.click(r.y)}));
  }
  AlgorithmSet set;
  RELIEVO_TRY(set.set("triangulator", triangulator));
  RELIEVO_TRY_ASSIGN(const auto made, make_triangulator(set));
  return made->triangulate(pair, matches, bench.context);
}

TEST(Dissertation, ItsVirtualRigAndItsCube) {
  const hal::sim::SimulationOptions o = virtual_rig();
  const hal::sim::SimRig rig = hal::sim::make_rig(o.rig);
  test::StageBench bench(std::size_t{64} << 20, std::size_t{32} << 20);
  const auto result = calibrate_by_pictures(o, rig, bench.pool);
  ASSERT_TRUE(result) << result.error().what.view();
  const StereoCalibration& c = result->calibration;
  std::printf(
      "baseline %.3f units (true %.3f), focal lengths %.1f and %.1f px (true %.1f), pair rms %.3f px\n",
      baseline_mm(c) / kUnitMm, kBaselineUnits, c.left.focal_px.x, c.right.focal_px.x, rig.left.fx_px,
      result->quality.pair_rms_px);
  // The dissertation was off by 0.716 units.
  EXPECT_NEAR(baseline_mm(c) / kUnitMm, kBaselineUnits, 0.03);
  for (const CameraIntrinsics* camera : {&c.left, &c.right})
    EXPECT_NEAR(camera->focal_px.x, rig.left.fx_px, 1.5);

  const auto corners = cube_corners(rig);
  for (const char* triangulator : {"linear-least-squares", "inverse-disparity"}) {
    const auto cloud = reconstruct(c, rig, corners, triangulator, bench);
    ASSERT_TRUE(cloud) << cloud.error().what.view();
    ASSERT_EQ(cloud->points.size(), corners.size());
    std::printf("cube by hand, %s:\n", triangulator);
    const Found found = judge(*cloud, corners);
    std::printf("  worst corner %.2f units, rms %.2f, mean side %.2f (true %.2f)\n", found.worst_units,
                found.rms_units, found.side_units, kCubeUnits);
    EXPECT_LT(found.worst_units, 1);
    EXPECT_NEAR(found.side_units, kCubeUnits, 0.3);
  }
}

}  // namespace
}  // namespace relievo::pipeline
