// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sheets of every bend have no relief, heads have, and the two figures are what geometry says they are.
#include "pipeline/relief/relief_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <string>

#include "hal/sim/sheet/sheet_photo.h"
#include "pipeline/mesh/meshers/scattered_meshers.h"
#include "tests/pipeline/mesh/landmarks/field_head.h"
#include "tests/support/stage_fixture.h"

namespace relievo::pipeline {
namespace {

namespace sim = hal::sim;
using sim::Vec3;

constexpr double kDepthMm = 560;

struct ReliefFixture : relievo::test::StageFixture {
  ReliefFixture() : StageFixture(std::size_t{16} << 20, std::size_t{64} << 20) {}
};

// A pair whose face is found in the middle of what lies kDepthMm away.
RectifiedPair pair_of() {
  RectifiedPair pair(std::pmr::get_default_resource());
  pair.focal_px = 1475;
  pair.left_centre_px = pair.face_centre_px = {480, 300};
  pair.face_width_px = 150 / kDepthMm * pair.focal_px;
  return pair;
}

FaceMesh empty_mesh() { return FaceMesh(std::pmr::get_default_resource()); }

void add(FaceMesh& mesh, const Vec3& p, double sigma_mm) {
  mesh.vertices_mm.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
  mesh.sigma_mm.push_back(static_cast<float>(sigma_mm));
  mesh.measured.push_back(1);
}

// A surface given over the sheet's own u and v, turned, held at kDepthMm, with noise along the line of sight.
FaceMesh held(const std::function<Vec3(double, double)>& surface, double noise_mm,
              const Vec3& turn_deg = {0, 0, 0}) {
  FaceMesh mesh = empty_mesh();
  const sim::Mat3 turn =
      sim::rotation(sim::radians(turn_deg.x), sim::radians(turn_deg.y), sim::radians(turn_deg.z));
  std::mt19937 random(11);
  std::normal_distribution<double> noise(0, noise_mm);
  constexpr int kHalf = 64;
  constexpr double kStepMm = 1.25;
  for (int row = -kHalf; row <= kHalf; ++row)
    for (int column = -kHalf; column <= kHalf; ++column) {
      const double u = column * kStepMm, v = row * kStepMm;
      const Vec3 p = turn * surface(u, v) + Vec3{0, 0, kDepthMm};
      add(mesh, p + normalised(p) * noise(random), std::max(noise_mm, 0.02));
    }
  return mesh;
}

FaceMesh held(const sim::SheetBend& bend, double noise_mm, const Vec3& turn_deg = {0, 0, 0}) {
  return held([&](double u, double v) { return bent(bend, u, v); }, noise_mm, turn_deg);
}

Result<ReliefFigures> measured(const FaceMesh& mesh) {
  ReliefFixture fixture;
  return run_stage(fixture.context, [&](StageContext& c) { return measure_relief(mesh, pair_of(), c); });
}

ReliefFigures relief_of(const FaceMesh& mesh) {
  const auto relief = measured(mesh);
  EXPECT_TRUE(relief);
  return relief ? *relief : ReliefFigures{};
}

std::string name_of(const ReliefFigures& r) {
  return "off a plane " + std::to_string(r.off_plane_mm) + ", a sheet " + std::to_string(r.off_sheet_mm) +
         " mm, curved " + std::to_string(r.curvature_sr) + " sr";
}

TEST(ReliefCheck, APlaneIsAsFlatAsItsNoise) {
  const ReliefFigures r = relief_of(held(sim::SheetBend{}, 0.2, {25, -30, 10}));
  // Six points fall into a cell.
  EXPECT_LT(r.off_plane_mm, 0.2);
  EXPECT_LT(r.off_sheet_mm, 0.15);
  EXPECT_LT(r.curvature_sr, 0.2);
  EXPECT_EQ(judge(r, {}), ReliefVerdict::Picture) << name_of(r);
}

// Bends that a hand can hold, in every direction: none leaves the nearest sheet, though all leave the plane.
TEST(ReliefCheck, NoBentSheetIsAFace) {
  for (const double radius : {60.0, -110.0, 250.0})
    for (const double axis : {0.0, 57.0})
      for (const Vec3& turn : {Vec3{0, 0, 0}, Vec3{12, -25, 20}})
        for (const sim::SheetBend& bend :
             {sim::SheetBend{radius, axis, 0, 0}, sim::SheetBend{radius, axis, 350, 0},
              sim::SheetBend{radius, axis, 0, 150}}) {
          const ReliefFigures r = relief_of(held(bend, 0.15, turn));
          const std::string which = std::to_string(radius) + " " + std::to_string(axis) + " " +
                                    std::to_string(bend.apex_mm) + " " + std::to_string(bend.wave_mm) + ": ";
          EXPECT_GT(r.off_plane_mm, 0.3) << which << name_of(r);
          EXPECT_LT(r.off_sheet_mm, 0.3) << which << name_of(r);
          EXPECT_LT(r.curvature_sr, 1.25) << which << name_of(r);
          EXPECT_EQ(judge(r, {}), ReliefVerdict::Picture) << which << name_of(r);
        }
}

// A lamp mirrored in a screen stands behind it.
TEST(ReliefCheck, AMirroredLampGivesASheetNoFace) {
  FaceMesh mesh = held(sim::SheetBend{150, 20, 0, 0}, 0.2);
  for (Vec3f& v : mesh.vertices_mm)
    if (std::hypot(v.x - 15, v.y + 20) < 12) v.z += 12;
  const ReliefFigures r = relief_of(mesh);
  EXPECT_LT(r.off_sheet_mm, 0.3) << name_of(r);
  EXPECT_EQ(judge(r, {}), ReliefVerdict::Picture) << name_of(r);
}

// Gauss: a cap of a sphere curves by its area over the radius squared.
TEST(ReliefCheck, TheCurvatureOfABallIsItsSolidAngle) {
  constexpr double kRadius = 75;
  const auto ball = [&](double u, double v) {
    const double r = std::min(std::hypot(u, v), 0.98 * kRadius);
    return Vec3{u, v, kRadius - std::sqrt(kRadius * kRadius - r * r)};
  };
  const ReliefFigures r = relief_of(held(ball, 0.05));
  // The figure's disc of 60 mm, seen from the ball's middle; what lies at its rim is taken to curve as the
  // rest, and a ball's rim is steeper.
  const double cap = 2 * 3.14159265 * (1 - std::sqrt(1 - 60 * 60 / (kRadius * kRadius)));
  EXPECT_GT(r.curvature_sr, 0.9 * cap) << name_of(r);
  EXPECT_LT(r.curvature_sr, cap) << name_of(r);
}

FaceMesh head_in(std::uint32_t seed, const sim::HeadPose& pose, double noise_mm,
                 double keep_from_mm = -1000) {
  static ThreadPool pool(2);
  const PointCloud cloud = FieldHead(seed).cloud(pose, pool, noise_mm);
  FaceMesh mesh = empty_mesh();
  for (const CloudPoint& p : cloud.points)
    if (static_cast<double>(p.at_mm.x) > keep_from_mm)
      add(mesh,
          {static_cast<double>(p.at_mm.x), static_cast<double>(p.at_mm.y), static_cast<double>(p.at_mm.z)},
          noise_mm);
  return mesh;
}

TEST(ReliefCheck, HeadsAreFacesTurnedNoisyAndHalfHidden) {
  for (const double yaw : {-30.0, 30.0}) {
    sim::HeadPose pose;
    pose.yaw_deg = yaw, pose.pitch_deg = yaw / 3;
    const ReliefFigures r = relief_of(head_in(5, pose, 0.3));
    EXPECT_EQ(judge(r, {}), ReliefVerdict::Face) << "turned " << yaw << ": " << name_of(r);
  }
  const ReliefFigures noisy = relief_of(head_in(6, {}, 0.9));
  EXPECT_EQ(judge(noisy, {}), ReliefVerdict::Face) << name_of(noisy);
  const ReliefFigures half = relief_of(head_in(6, {}, 0.3, -12));
  EXPECT_LT(half.covered, 0.7);
  EXPECT_EQ(judge(half, {}), ReliefVerdict::Face) << name_of(half);
}

// Dark skin in little light leaves holes all over a face: what is between them tells as much.
TEST(ReliefCheck, HolesMakeNoPictureOfAFaceAndNoFaceOfAPicture) {
  const auto pierced = [](const FaceMesh& whole, double radius_mm) {
    FaceMesh mesh = empty_mesh();
    for (std::size_t k = 0; k < whole.vertices_mm.size(); ++k) {
      const Vec3f& v = whole.vertices_mm[k];
      const double x = std::remainder(double(v.x), 36), y = std::remainder(double(v.y), 36);
      if (std::hypot(x, y) > radius_mm)
        add(mesh, {double(v.x), double(v.y), double(v.z)}, double(whole.sigma_mm[k]));
    }
    return mesh;
  };
  const FaceMesh face = head_in(6, {}, 0.3), sheet = held(sim::SheetBend{110, 57, 0, 0}, 0.15);
  const ReliefFigures whole = relief_of(face), holes = relief_of(pierced(face, 11));
  EXPECT_LT(holes.covered, 0.75);
  EXPECT_NEAR(holes.curvature_sr, whole.curvature_sr, 0.35 * whole.curvature_sr);
  EXPECT_EQ(judge(holes, {}), ReliefVerdict::Face) << name_of(holes);
  const ReliefFigures flat = relief_of(pierced(sheet, 11));
  EXPECT_EQ(judge(flat, {}), ReliefVerdict::Picture) << name_of(flat);
  // Crumbs tell nothing of either.
  for (const FaceMesh* mesh : {&face, &sheet})
    EXPECT_EQ(judge(relief_of(pierced(*mesh, 20)), {}), ReliefVerdict::Unjudged);
}

// Relief that noise could feign is none.
TEST(ReliefCheck, WhatIsLessThanItsSigmaSaysIsNoFace) {
  const ReliefOptions options;
  ReliefFigures r{1, 0.3, 6, 2, 18, 7};
  EXPECT_EQ(judge(r, options), ReliefVerdict::Face);
  r.sigma_mm = 1.6;
  EXPECT_EQ(judge(r, options), ReliefVerdict::Unjudged) << "such noise hides a face's relief as well";
  r = {1, 0.3, 6, 0.8, 18, 7};
  EXPECT_EQ(judge(r, options), ReliefVerdict::Picture);
  r = {1, 0.3, 6, 2, 18, 1};
  EXPECT_EQ(judge(r, options), ReliefVerdict::Picture);
  r.covered = 0.2;
  EXPECT_EQ(judge(r, options), ReliefVerdict::Unjudged) << "so little of a face may be curved as little";
  r.off_sheet_mm = 0.8;
  EXPECT_EQ(judge(r, options), ReliefVerdict::Unjudged) << "or lie nearly as flat";
  r.off_sheet_mm = 0.3;
  EXPECT_EQ(judge(r, options), ReliefVerdict::Picture);
  EXPECT_EQ(judge({}, options), ReliefVerdict::Unjudged);
}

// Chosen places lie 6 mm apart and more: what spans them is judged.
TEST(ReliefCheck, ScatteredPointsAreJudgedByTheSurfaceThatSpansThem) {
  static ThreadPool pool(2);
  ReliefFixture fixture;
  const auto thinned = [](PointCloud cloud) {
    PointCloud few(std::pmr::get_default_resource());
    for (std::size_t k = 0; k < cloud.points.size(); k += 97) few.points.push_back(cloud.points[k]);
    return few;
  };
  const auto verdict_of = [&](const PointCloud& cloud) {
    const auto mesh =
        run_stage(fixture.context, [&](StageContext& c) { return DelaunayMesher({}).mesh(cloud, c); });
    EXPECT_TRUE(mesh);
    EXPECT_LT(mesh->vertices_mm.size(), 2000U);
    const ReliefFigures r = relief_of(*mesh);
    EXPECT_GT(r.covered, 0.5);
    return judge(r, {});
  };
  PointCloud head = thinned(FieldHead(4).cloud({}, pool, 0.2));
  EXPECT_EQ(verdict_of(head), ReliefVerdict::Face);
  for (CloudPoint& p : head.points) {  // a picture of it on a screen
    const float flat = 560 / p.at_mm.z;
    p.at_mm = {p.at_mm.x * flat, p.at_mm.y * flat, 560 + 0.2F * std::sin(p.at_mm.z * 40)};
  }
  EXPECT_EQ(verdict_of(head), ReliefVerdict::Picture);
}

TEST(ReliefCheck, SaysToThePersonWhatToDoAndToTheTechnicianWhatWasMeasured) {
  const Error error = error_of(ReliefVerdict::Picture, {1, 0.1, 0.25, 0.21, 0.5, 0.4}, {});
  EXPECT_EQ(error.code, Errc::NoFace);
  EXPECT_NE(error.what.view().find("look into the cameras yourself"), std::string_view::npos);
  for (const char* figure :
       {"0.25 mm off a plane", "0.21 mm off a bent sheet", "at least 1.2", "sigma 0.10", "0.4 sr"})
    EXPECT_NE(error.where().find(figure), std::string_view::npos) << figure << " in " << error.where();
}

TEST(ReliefCheck, KeepsTheStagesContract) {
  const FaceMesh mesh = held(sim::SheetBend{90, 20, 0, 0}, 0.2);
  const ReliefFigures once = relief_of(mesh), again = relief_of(mesh);
  EXPECT_EQ(once.off_sheet_mm, again.off_sheet_mm);
  EXPECT_EQ(once.curvature_sr, again.curvature_sr);

  const auto empty = measured(empty_mesh());
  ASSERT_TRUE(empty);
  EXPECT_EQ(error_of(judge(*empty, {}), *empty, {}).code, Errc::PoorGeometry);

  ReliefFixture fixture;
  fixture.cancelled = true;
  const auto stopped =
      run_stage(fixture.context, [&](StageContext& c) { return measure_relief(mesh, pair_of(), c); });
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, Errc::Cancelled);

  relievo::test::StageFixture tiny(1 << 10, 1 << 16);
  const auto full =
      run_stage(tiny.context, [&](StageContext& c) { return measure_relief(mesh, pair_of(), c); });
  ASSERT_FALSE(full);
  EXPECT_EQ(full.error().code, Errc::OutOfMemory);
}

TEST(ReliefCheck, TakesNoOptionsBelowNothing) {
  ReliefOptions options;
  EXPECT_TRUE(check_options(options, "relief"));
  options.least_sigmas = -1;
  EXPECT_FALSE(check_options(options, "relief"));
}

}  // namespace
}  // namespace relievo::pipeline
