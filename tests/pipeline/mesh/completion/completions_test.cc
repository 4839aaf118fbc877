// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What every completion must do, by name from the table; and the mirrored half of a simulated head that is
// turned away, against the head itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <memory_resource>
#include <set>
#include <vector>

#include <Eigen/Geometry>

#include "pipeline/algorithms.h"
#include "pipeline/mesh/completion/completions.h"
#include "pipeline/mesh/completion/generic_head.h"
#include "pipeline/mesh/completion/mesh_laplacian.h"
#include "pipeline/mesh/meshers/grid_mesher.h"
#include "tests/pipeline/mesh/landmarks/field_head.h"
#include "tests/pipeline/mesh/mesh_checks.h"
#include "tests/pipeline/mesh/stage_room.h"
#include "tests/support/names_of.h"

namespace relievo::pipeline {
namespace {

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

Result<FaceMesh> completed(const std::string& name, const FaceMesh& mesh, StageRoom& room) {
  const auto completion = relievo::test::made(&Algorithms::completion, "completion", name);
  return room.run([&](StageContext& c) { return completion(FaceMesh(mesh), {1, 0, 0}, c); });
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
  expect_whole_arrays(*after);
  expect_one_manifold_surface(*after);
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
  const auto completion = relievo::test::made(&Algorithms::completion, "completion", GetParam());
  const auto second = run_stage(context, [&](StageContext& c) {
    return completion(FaceMesh(turned().mesh), {1, 0, 0}, c);
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
  expect_whole_arrays(*after);
  expect_one_manifold_surface(*after);
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
    // A neck is cut off somewhere; and the generic head is round behind, where hair hides this one's rims.
    if (p.y < -80 || p.z < -20) continue;
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

// The face becomes a head that a closed surface bounds, and where it begins nothing shows: the planes through
// what lies within 6 mm on either side of the seam meet without a step and nearly without a crease.
struct Patch {
  Vec3f middle{}, normal{};
  float area = 0;
};

Patch patch_at(const FaceMesh& m, const Vec3f& at, std::size_t from, std::size_t to) {
  Patch sum;
  for (std::size_t t = from; t < to; ++t) {
    const auto& [i, j, k] = m.triangles[t];
    const Vec3f &a = m.vertices_mm[i], &b = m.vertices_mm[j], &c = m.vertices_mm[k];
    if (squared_distance(a, at) > 36) continue;
    const Vec3f n = cross(minus(b, a), minus(c, a));
    const float area = length(n);
    sum.normal = {sum.normal.x + n.x, sum.normal.y + n.y, sum.normal.z + n.z};
    sum.middle = {sum.middle.x + area * (a.x + b.x + c.x) / 3, sum.middle.y + area * (a.y + b.y + c.y) / 3,
                  sum.middle.z + area * (a.z + b.z + c.z) / 3};
    sum.area += area;
  }
  if (!(sum.area > 0)) return sum;
  sum.normal = times(sum.normal, 1 / length(sum.normal));
  sum.middle = times(sum.middle, 1 / sum.area);
  return sum;
}

std::size_t open_edges(const FaceMesh& mesh) {
  std::set<Edge> edges;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) edges.insert({t[k], t[(k + 1) % 3]});
  std::size_t open = 0;
  for (const auto& [a, b] : edges) open += 1 - edges.count({b, a});
  return open;
}

TEST(GenericHead, ClosesAndGoesOnWhereTheFaceEnds) {
  StageRoom room;
  const FieldHead head(3);
  const PointCloud cloud = head.cloud_of_two({}, room.pool);
  GridMesher coarse;
  coarse.max_triangles = 80'000;
  const auto face = room.run([&](StageContext& c) { return GridMesher(coarse).mesh(cloud, c); });
  ASSERT_TRUE(face);
  const FaceMesh before = *face;  // out of the room's arena
  const auto after = completed("generic-head", before, room);
  ASSERT_TRUE(after);
  const std::size_t border = open_edges(before), open = open_edges(*after);
  std::printf("of %zu edges of the border %zu are open yet\n", border, open);
  ASSERT_GT(border, 300U);
  EXPECT_EQ(open, 0U);

  const std::size_t own = before.triangles.size(), old = before.vertices_mm.size();
  std::vector<std::uint32_t> seam;
  for (std::size_t t = own; t < after->triangles.size(); ++t)
    for (const std::uint32_t v : after->triangles[t])
      if (v < old) seam.push_back(v);
  ASSERT_GT(seam.size(), 500U);
  std::vector<double> step, crease;
  for (std::size_t i = 0; i < seam.size(); i += 12) {
    const Vec3f& at = after->vertices_mm[seam[i]];
    const Patch in = patch_at(*after, at, 0, own), out = patch_at(*after, at, own, after->triangles.size());
    if (in.area < 20 || out.area < 20) continue;
    const Vec3f to_in = minus(in.middle, at), to_out = minus(out.middle, at);
    step.push_back(std::abs(static_cast<double>(dot(in.normal, to_in) - dot(out.normal, to_out))));
    crease.push_back(std::acos(std::min(1.0, static_cast<double>(dot(in.normal, out.normal)))) * 57.29578);
  }
  std::sort(step.begin(), step.end());
  std::sort(crease.begin(), crease.end());
  const std::size_t n = step.size();
  ASSERT_GT(n, 50U);
  std::printf("%zu places of the seam: step %.2f mm (median), %.2f (95 %%); crease %.1f degrees, %.1f\n", n,
              step[n / 2], step[n * 95 / 100], crease[n / 2], crease[n * 95 / 100]);
  EXPECT_LT(step[n / 2], 0.1);
  EXPECT_LT(step[n * 95 / 100], 0.3);
  EXPECT_LT(crease[n / 2], 6);
  EXPECT_LT(crease[n * 95 / 100], 15);
}

// A ball laid off its middle, known at few nodes: between them it bends like a ball, most of all along the
// edges of the icosahedron, where the nodes lie unevenly.
TEST(GenericHead, AFinerGlobeShowsNoFolds) {
  Globe globe(3, std::pmr::get_default_resource());
  const auto radius_of = [](const Vec3d& d) { return 100 + 30 * d.x; };
  std::array<std::pmr::vector<double>, 1> fields;
  for (const Vec3d& d : globe.direction) fields[0].push_back(radius_of(d));
  globe.quarter(fields);
  globe.quarter(fields);
  ASSERT_EQ(fields[0].size(), globe.direction.size());
  std::vector<Eigen::Vector3d> at;
  for (std::size_t v = 0; v < globe.direction.size(); ++v) {
    const Vec3d& d = globe.direction[v];
    at.emplace_back(fields[0][v] * Eigen::Vector3d(d.x, d.y, d.z));
  }
  // Where two triangles meet, the angle between them: that of a ball for the edge's length.
  std::map<std::array<std::uint32_t, 2>, Eigen::Vector3d> normal;
  double worst = 0;
  for (const auto& t : globe.triangles) {
    const Eigen::Vector3d n = (at[t[1]] - at[t[0]]).cross(at[t[2]] - at[t[0]]).normalized();
    for (std::size_t k = 0; k < 3; ++k) {
      const std::array<std::uint32_t, 2> edge{std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])};
      const auto [other, fresh] = normal.try_emplace(edge, n);
      if (!fresh) worst = std::max(worst, std::acos(std::min(1.0, n.dot(other->second))) * 57.29578);
    }
  }
  std::printf("largest angle between triangles %.2f degrees\n", worst);
  EXPECT_LT(worst, 2.0);
}

TEST(GenericHead, WhatIsLaidAnewGoesOnWithoutACrease) {
  // A flat field whose inner nodes were lifted and bent: the plate through its fixed frame is flat again.
  constexpr std::uint32_t kSide = 20;
  std::vector<Eigen::Vector3d> at;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<char> free;
  for (std::uint32_t r = 0; r < kSide; ++r)
    for (std::uint32_t c = 0; c < kSide; ++c) {
      const bool inside = r > 2 && c > 2 && r + 3 < kSide && c + 3 < kSide;
      at.emplace_back(c + 0.3 * (r % 2), r, inside ? 3 + (r * c) % 5 : 0.2 * r);
      free.push_back(inside ? 1 : 0);
      if (r + 1 == kSide || c + 1 == kSide) continue;
      const std::uint32_t k = r * kSide + c;
      triangles.push_back({k, k + 1, k + kSide});
      triangles.push_back({k + 1, k + kSide + 1, k + kSide});
    }
  const std::vector<Eigen::Vector3d> before = at;
  fair(at, triangles, free);
  for (std::size_t v = 0; v < at.size(); ++v) {
    if (free[v] == 0) EXPECT_EQ(at[v], before[v]);
    else EXPECT_NEAR(at[v].z(), 0.2 * at[v].y(), 1e-3);
  }
}

// The same face with a border that folds as the globe sees it.
TEST(GenericHead, LeavesNoEdgeOpen) {
  StageRoom room;
  const auto after = completed("generic-head", Turned(0).mesh, room);
  ASSERT_TRUE(after);
  EXPECT_EQ(open_edges(*after), 0U);
}

TEST(GenericHead, TakesNoFileButItsOwn) {
  const std::span<const std::byte> own = generic_head_file();
  ASSERT_TRUE(read_generic_head(own));
  EXPECT_EQ(read_generic_head(own.first(own.size() - 2)).error().code, Errc::InvalidInput);
  EXPECT_EQ(read_generic_head({}).error().code, Errc::InvalidInput);
  for (std::size_t byte = 0; byte < sizeof(GenericHeadHeader); ++byte) {
    std::vector<std::byte> broken(own.begin(), own.end());
    broken[byte] ^= std::byte{1};
    EXPECT_FALSE(read_generic_head(broken)) << "byte " << byte;
  }
}

// A globe is closed, its nodes are evenly apart, and what is the same everywhere, or grows evenly along an
// axis, stays so when it is refined.
TEST(Globe, KeepsValuesSmoothWhenItIsRefined) {
  Globe globe(kGlobeTimes, std::pmr::get_default_resource());
  ASSERT_EQ(globe.direction.size(), std::size_t{kGlobeNodes});
  ASSERT_EQ(globe.triangles.size(), 2U * kGlobeNodes - 4);
  std::array<std::pmr::vector<double>, 2> fields;
  fields[0].assign(kGlobeNodes, 5);
  for (const Vec3d& d : globe.direction) fields[1].push_back(d.y);
  globe.quarter(fields);
  ASSERT_EQ(fields[1].size(), globe.direction.size());
  for (std::size_t v = 0; v < globe.direction.size(); ++v) {
    ASSERT_NEAR(fields[0][v], 5, 1e-9);
    ASSERT_NEAR(fields[1][v], globe.direction[v].y, 0.01);
  }
  for (const auto& [a, b, c] : globe.triangles) {
    const auto& p = globe.direction;
    const double outward = p[a].x * (p[b].y * p[c].z - p[b].z * p[c].y) +
                           p[a].y * (p[b].z * p[c].x - p[b].x * p[c].z) +
                           p[a].z * (p[b].x * p[c].y - p[b].y * p[c].x);
    ASSERT_GT(outward, 0);
  }
}

}  // namespace
}  // namespace relievo::pipeline
