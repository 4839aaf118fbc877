// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/fuse/head_pose.h"

#include <algorithm>
#include <cmath>

#include "hal/base/statistics.h"
#include "pipeline/mesh/lattice/lattice_surface.h"
#include "pipeline/mesh/surface_cleaner.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

// What joins two nodes to one surface: as the grid mesher has it.
constexpr LatticeLimits kLimits{4.33F, 4, 3, 0.5F};  // tangent of 77 degrees
// Along the line of sight: more is hair seen through and what lies behind, unless cameras far away or few
// pixels make it usual.
constexpr float kMostSigmaMm = 1, kMostOfUsual = 4;
constexpr float kEdgeNodes = 6;         // over which trust grows from the edge of what was measured
constexpr float kEdgeOnCosine = 0.26F;  // 75 degrees: no trust ...
constexpr float kFullCosine = 0.5F;     // ... and 60: all of it

// Steps from the edge, by two sweeps of a chamfer (Borgefors 1986).
std::pmr::vector<float> steps_from_edge(const HeadPose& pose, std::pmr::memory_resource* memory) {
  constexpr float kDiagonal = 1.4F;
  const int columns = pose.columns, rows = pose.rows;
  std::pmr::vector<float> steps(memory);
  steps.reserve(pose.nodes.size());
  for (const SurfaceHit& node : pose.nodes) steps.push_back(node.trust > 0 ? 1e6F : 0.0F);
  const auto at = [&](int c, int r) {
    return c < 0 || r < 0 || c >= columns || r >= rows
               ? 0.0F
               : steps[std::size_t(r) * std::size_t(columns) + std::size_t(c)];
  };
  const auto relax = [&](int c, int r, int way) {
    float& here = steps[std::size_t(r) * std::size_t(columns) + std::size_t(c)];
    here = std::min({here, at(c - way, r) + 1, at(c, r - way) + 1, at(c - way, r - way) + kDiagonal,
                     at(c + way, r - way) + kDiagonal});
  };
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) relax(c, r, 1);
  for (int r = rows - 1; r >= 0; --r)
    for (int c = columns - 1; c >= 0; --c) relax(c, r, -1);
  return steps;
}

// So that 0 0 0 says where it ends.
void keep_photograph(const RectifiedView& view, std::pmr::vector<std::uint8_t>& rgb) {
  rgb.assign(view.rgb.begin(), view.rgb.end());
  for (std::size_t k = 0; k < view.valid.size(); ++k) {
    std::uint8_t* pixel = &rgb[3 * k];
    if (view.valid[k] == 0) pixel[0] = pixel[1] = pixel[2] = 0;
    else if (pixel[0] == 0 && pixel[1] == 0 && pixel[2] == 0) pixel[0] = pixel[1] = pixel[2] = 1;
  }
}

}  // namespace

Result<HeadPose> make_head_pose(const PointCloud& cloud, const RectifiedPair& pair, StageContext& context) {
  if (cloud.lattice_step_px <= 0)
    return Error{Errc::Unsupported,
                 "only points on a lattice can be fused: choose selector=dense or grid-points"};
  PointLattice lattice = make_lattice(cloud, &context.scratch);
  if (lattice.columns < 3 || lattice.rows < 3)
    return Error{Errc::PoorGeometry, "too little was measured to make a surface of"};
  join_neighbours(lattice, kLimits, &context.scratch);
  if (context.stop()) return stopped();

  HeadPose pose(&context.output);
  pose.columns = lattice.columns;
  pose.rows = lattice.rows;
  pose.rectified_from_camera = pair.rectified_from_left;
  pose.focal_px = pair.focal_px;
  pose.centre_px = pair.left_centre_px;
  pose.step_px = cloud.lattice_step_px;
  pose.first_px = {1e9, 1e9};
  for (const CloudPoint& p : cloud.points) {
    pose.first_px.x = std::min(pose.first_px.x, double(p.left_px.x));
    pose.first_px.y = std::min(pose.first_px.y, double(p.left_px.y));
  }
  pose.nodes.reserve(lattice.size());
  for (const Vec3f& at : lattice.at_mm) pose.nodes.push_back({at, {}});

  for_each_triangle(lattice, [&](const Triangle& t) {
    const Vec3f area = area_normal(lattice.at_mm, t);
    for (const std::uint32_t v : t) pose.nodes[v].normal = plus(pose.nodes[v].normal, area);
  });
  std::pmr::vector<float> sigmas(&context.scratch);
  for (const CloudPoint& p : cloud.points) sigmas.push_back(p.sigma_mm);
  const float most_sigma_mm = std::max(kMostSigmaMm, kMostOfUsual * float(median(sigmas)));
  // 1 where all cells around a node carry surface and it is not too unsure.
  std::pmr::vector<float> whole(lattice.size(), 0.0F, &context.scratch);
  for (int r = 1; r + 1 < lattice.rows; ++r)
    for (int c = 1; c + 1 < lattice.columns; ++c) {
      bool all = !(lattice.sigma_mm[lattice.index(c, r)] > most_sigma_mm);
      for (const auto& [dc, dr] : {std::pair{0, 0}, {-1, 0}, {0, -1}, {-1, -1}})
        all = all && triangle_count(lattice.cells[lattice.index(c + dc, r + dr)]) == 2;
      whole[lattice.index(c, r)] = all ? 1.0F : 0.0F;
    }
  // A triangle's normal is noise over a cell's width: five nodes' mean has a fifth of it.
  std::pmr::vector<Vec3f> raw(&context.scratch);
  raw.reserve(pose.nodes.size());
  for (const SurfaceHit& node : pose.nodes) raw.push_back(node.normal);
  for (int r = 1; r + 1 < pose.rows; ++r)
    for (int c = 1; c + 1 < pose.columns; ++c) {
      const std::size_t k = lattice.index(c, r);
      if (whole[k] == 0) continue;
      Vec3f sum{};
      for (int dr = -2; dr <= 2; ++dr)
        for (int dc = -2; dc <= 2; ++dc) {
          if (!lattice.inside(c + dc, r + dr)) continue;
          const std::size_t other = lattice.index(c + dc, r + dr);
          if (whole[other] != 0) sum = plus(sum, raw[other]);
        }
      Vec3f n = unit(sum);
      const Vec3f sight = unit(lattice.at_mm[k]);
      if (dot(n, sight) > 0) n = times(n, -1.0F);
      const float cosine = -dot(n, sight);
      SurfaceHit& node = pose.nodes[k];
      node.normal = n;
      node.sigma_mm = lattice.sigma_mm[k] * std::max(cosine, kEdgeOnCosine);
      node.trust = std::clamp((cosine - kEdgeOnCosine) / (kFullCosine - kEdgeOnCosine), 0.0F, 1.0F);
    }
  fade_to_edges(pose, kEdgeNodes, &context.scratch);
  pose.width_px = pair.width_px;
  pose.height_px = pair.height_px;
  pose.right_centre_px = pair.right_centre_px;
  pose.baseline_mm = pair.baseline_mm;
  keep_photograph(pair.left, pose.left_rgb);
  keep_photograph(pair.right, pose.right_rgb);
  return pose;
}

FaceMesh coarse_mesh(const HeadPose& pose, int most_triangles, StageContext& context) {
  const int every = std::max(1, int(std::ceil(std::sqrt(2 * double(pose.nodes.size()) / most_triangles))));
  const int columns = (pose.columns + every - 1) / every, rows = (pose.rows + every - 1) / every;
  std::pmr::vector<std::size_t> node(&context.scratch);
  std::pmr::vector<Vec3f> at_mm(&context.scratch);
  for (int r = 0; r < pose.rows; r += every)
    for (int c = 0; c < pose.columns; c += every) {
      node.push_back(std::size_t(r) * std::size_t(pose.columns) + std::size_t(c));
      at_mm.push_back(pose.nodes[node.back()].at_mm);
    }
  std::pmr::vector<Triangle> triangles(&context.scratch);
  const float least_cosine = cosine_of_slope(kLimits.max_slope);
  const auto add = [&](const Triangle& t) {
    if (std::all_of(t.begin(), t.end(), [&](std::uint32_t v) { return pose.nodes[node[v]].trust > 0; }) &&
        facing(at_mm[t[0]], at_mm[t[1]], at_mm[t[2]], least_cosine))
      triangles.push_back(t);
  };
  const auto w = std::uint32_t(columns);
  for (std::uint32_t r = 0; r + 1 < std::uint32_t(rows); ++r)
    for (std::uint32_t a = r * w; a + 1 < (r + 1) * w; ++a) {
      add({a, a + w, a + w + 1});
      add({a, a + w + 1, a + 1});
    }
  keep_one_surface(at_mm, triangles, {}, &context.scratch);
  FaceMesh mesh = pack_mesh(at_mm.size(), triangles, context, [&](std::size_t v) {
    return PackedVertex{at_mm[v], pose.nodes[node[v]].sigma_mm, 1};
  });
  compute_normals(mesh, 1, &context.scratch);
  return mesh;
}

void fade_to_edges(HeadPose& pose, float nodes, std::pmr::memory_resource* scratch) {
  const auto steps = steps_from_edge(pose, scratch);
  for (std::size_t k = 0; k < pose.nodes.size(); ++k)
    pose.nodes[k].trust = std::min(pose.nodes[k].trust, steps[k] / nodes);
}

std::optional<SurfaceHit> HeadPose::look(const Vec3f& place) const {
  const Vec3d p = apply(rectified_from_camera, wide(place));
  if (!(p.z > 0)) return std::nullopt;
  const double x = (focal_px * p.x / p.z + centre_px.x - first_px.x) / step_px;
  const double y = (focal_px * p.y / p.z + centre_px.y - first_px.y) / step_px;
  if (!(x >= 0 && y >= 0 && x < columns - 1 && y < rows - 1)) return std::nullopt;
  const std::size_t w = std::size_t(columns);
  const std::size_t k = std::size_t(y) * w + std::size_t(x);
  const float fx = float(x - std::floor(x)), fy = float(y - std::floor(y));
  SurfaceHit hit{};
  float least = 1;
  const Vec3f& first_normal = nodes[k].normal;
  for (std::size_t i = 0; i < 4; ++i) {
    const SurfaceHit& node = nodes[k + i % 2 + (i / 2) * w];
    if (node.trust <= 0) return std::nullopt;
    const float share = (i % 2 == 0 ? 1 - fx : fx) * (i < 2 ? 1 - fy : fy);
    hit.at_mm = along(hit.at_mm, share, node.at_mm);
    hit.normal = along(hit.normal, share, node.normal);
    hit.sigma_mm += share * node.sigma_mm;
    hit.trust += share * node.trust;
    least = std::min(least, dot(node.normal, first_normal));
  }
  if (least < 0) return std::nullopt;  // a fold between the nodes
  hit.normal = unit(hit.normal);
  return hit;
}

std::optional<PlacedHit> look(const HeadPose& pose, const RigidTransform& first_from_pose,
                              const Vec3d& place) {
  const auto hit = pose.look(narrow(apply(inverse(first_from_pose), place)));
  if (!hit) return std::nullopt;
  const Vec3d normal = apply(first_from_pose.rotation, wide(hit->normal));
  return PlacedHit{*hit, normal, dot(normal, minus(place, apply(first_from_pose, wide(hit->at_mm))))};
}

}  // namespace relievo::pipeline
