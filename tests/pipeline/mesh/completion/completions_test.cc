// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What every completion must do, by name from the table; and the mirrored half of a simulated head that is
// turned away, against the head itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "pipeline/algorithms.h"
#include "pipeline/mesh/meshers/grid_mesher.h"
#include "tests/pipeline/mesh/landmarks/field_head.h"
#include "tests/pipeline/mesh/mesh_checks.h"
#include "tests/pipeline/mesh/stage_room.h"
#include "tests/support/names_of.h"

namespace relievo::pipeline {
namespace {

using test::FieldHead;
using test::StageRoom;

struct Turned {
  hal::sim::HeadPose pose;
  FieldHead head{3};
  FaceMesh mesh{std::pmr::get_default_resource()};
  explicit Turned(double yaw_deg) {
    pose.yaw_deg = yaw_deg;
    StageRoom room;
    const PointCloud cloud = head.cloud(pose, room.pool);
    const auto made = room.run([&](StageContext& c) { return GridMesher({}).mesh(cloud, c); });
    EXPECT_TRUE(made);
    mesh = *made;  // out of the room's arena
  }
};

const Turned& turned() {
  static const Turned one(28);
  return one;
}

std::unique_ptr<Completion> named(const std::string& name) {
  AlgorithmSet set;
  EXPECT_TRUE(set.set("completion", name));
  return *make_completion(set);
}

Result<FaceMesh> completed(const std::string& name, const FaceMesh& mesh, StageRoom& room) {
  const auto completion = named(name);
  return room.run([&](StageContext& c) { return completion->complete(FaceMesh(mesh), {1, 0, 0}, c); });
}

template <typename T>
bool same(const std::pmr::vector<T>& a, const std::pmr::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

class Completions : public ::testing::TestWithParam<std::string> {};

TEST_P(Completions, MakeOneSurfaceAndLeaveTheMeasuredAsItIs) {
  StageRoom room;
  const FaceMesh& before = turned().mesh;
  const auto after = completed(GetParam(), before, room);
  ASSERT_TRUE(after);
  test::expect_whole_arrays(*after);
  test::expect_one_manifold_surface(*after);
  const auto measured = [](const FaceMesh& m) { return std::count(m.measured.begin(), m.measured.end(), 1); };
  EXPECT_EQ(measured(*after), measured(before));
  ASSERT_GE(after->vertices_mm.size(), before.vertices_mm.size());
  EXPECT_EQ(std::memcmp(after->vertices_mm.data(), before.vertices_mm.data(),
                        before.vertices_mm.size() * sizeof(Vec3f)),
            0);
  EXPECT_EQ(
      std::memcmp(after->sigma_mm.data(), before.sigma_mm.data(), before.sigma_mm.size() * sizeof(float)), 0);
}

TEST_P(Completions, AreTheSameForAnyNumberOfThreads) {
  StageRoom one, again;
  const auto first = completed(GetParam(), turned().mesh, one);
  ThreadPool single(1);
  StageContext context{again.output, again.scratch, single, again.progress, again.cancelled};
  const auto completion = named(GetParam());
  const auto second = run_stage(context, [&](StageContext& c) {
    return completion->complete(FaceMesh(turned().mesh), {1, 0, 0}, c);
  });
  ASSERT_TRUE(first && second);
  EXPECT_TRUE(same(first->vertices_mm, second->vertices_mm) && same(first->triangles, second->triangles) &&
              same(first->normals, second->normals) && same(first->sigma_mm, second->sigma_mm));
}

TEST_P(Completions, GiveBackWhatIsNoFace) {
  StageRoom room;
  const auto none = completed(GetParam(), FaceMesh(std::pmr::get_default_resource()), room);
  ASSERT_TRUE(none);
  EXPECT_TRUE(none->vertices_mm.empty());
  FaceMesh one(std::pmr::get_default_resource());
  one.vertices_mm = {{0, 0, 500}, {0, 1, 500}, {1, 0, 500}};
  one.normals = {{0, 0, -1}, {0, 0, -1}, {0, 0, -1}};
  one.sigma_mm = {0.1F, 0.1F, 0.1F};
  one.measured = {1, 1, 1};
  one.triangles = {{0, 1, 2}};
  const auto tiny = completed(GetParam(), one, room);
  ASSERT_TRUE(tiny);
  EXPECT_TRUE(same(tiny->vertices_mm, one.vertices_mm) && same(tiny->triangles, one.triangles));
}

TEST_P(Completions, TakeHalfAFace) {
  StageRoom room;
  const FaceMesh& whole = turned().mesh;
  PointCloud half(std::pmr::get_default_resource());
  half.lattice_step_px = 2;
  const PointCloud all = turned().head.cloud({}, room.pool);
  for (const CloudPoint& p : all.points)
    if (p.at_mm.x < 6) half.points.push_back(p);
  const auto mesh = room.run([&](StageContext& c) { return GridMesher({}).mesh(half, c); });
  ASSERT_TRUE(mesh);
  const FaceMesh kept = *mesh;  // copies go to the heap
  const auto after = completed(GetParam(), kept, room);
  ASSERT_TRUE(after);
  test::expect_whole_arrays(*after);
  test::expect_one_manifold_surface(*after);
  EXPECT_LT(after->vertices_mm.size(), 3 * whole.vertices_mm.size());
}

TEST_P(Completions, StopAndSayWhenMemoryIsUsedUp) {
  StageRoom room;
  room.cancelled = true;
  const auto stopped = completed(GetParam(), turned().mesh, room);
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, Errc::Cancelled);
  StageRoom measure;
  ASSERT_TRUE(completed(GetParam(), turned().mesh, measure));
  const std::size_t need = measure.scratch.high_water();
  for (std::size_t step = 0; step < 6 && need > 0; ++step) {
    StageRoom tiny(std::size_t{64} << 20, need * step / 6);
    const auto result = completed(GetParam(), turned().mesh, tiny);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, Errc::OutOfMemory);
  }
}

INSTANTIATE_TEST_SUITE_P(All, Completions, testing::ValuesIn(relievo::test::names_of("completion")),
                         [](const auto& one) { return relievo::test::test_name(one.param); });

class HiddenFace : public ::testing::TestWithParam<std::string> {};

// The side that is turned away, where the cameras see next to nothing of it.
TEST_P(HiddenFace, LiesWithinTwoMillimetresOfTheHead) {
  StageRoom room;
  const Turned& t = turned();
  const auto after = completed(GetParam(), t.mesh, room);
  ASSERT_TRUE(after);
  const RigidTransform head_from_camera = inverse(FieldHead::camera_from_head(t.pose));
  std::vector<double> off;
  int within = 0;
  for (std::size_t v = t.mesh.vertices_mm.size(); v < after->vertices_mm.size(); ++v) {
    ASSERT_EQ(after->measured[v], 0);
    const Vec3f& m = after->vertices_mm[v];
    const Vec3d p = apply(head_from_camera, {double(m.x), double(m.y), double(m.z)});
    off.push_back(std::abs(t.head.field().distance({p.x, p.y, p.z})));
    within += off.back() < static_cast<double>(after->sigma_mm[v]) ? 1 : 0;
  }
  ASSERT_GT(off.size(), 1000U) << "a head turned by 28 degrees hides a good part of one cheek";
  const double share = within / static_cast<double>(off.size());
  std::sort(off.begin(), off.end());
  RecordProperty("median_mm", std::to_string(off[off.size() / 2]));
  std::printf("%zu completed vertices: median %.2f mm, 95 %% within %.2f mm, within sigma %.2f\n", off.size(),
              off[off.size() / 2], off[off.size() * 95 / 100], share);
  EXPECT_LT(off[off.size() / 2], 2);
  EXPECT_LT(off[off.size() * 95 / 100], 6);
  EXPECT_GT(share, 0.5);
}

INSTANTIATE_TEST_SUITE_P(By, HiddenFace, testing::Values("symmetric", "generic-head"),
                         [](const auto& one) { return relievo::test::test_name(one.param); });

}  // namespace
}  // namespace relievo::pipeline
