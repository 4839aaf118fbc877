// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/fuse/step_smoother.h"

#include <algorithm>
#include <cmath>

#include "pipeline/mesh/completion/mesh_laplacian.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

constexpr float kStepCosine = 0.77F;  // 40 degrees
constexpr float kSameWayCosine = 0.9F;
constexpr int kRings = 5;      // of vertices around a step that are laid anew ...
constexpr int kHeldRings = 2;  // ... and around those, what says how the surface goes on

Vec3f area_normal(std::span<const Vec3f> at, const Triangle& t) {
  return cross(minus(at[t[1]], at[t[0]]), minus(at[t[2]], at[t[0]]));
}

// Steep, while what lies to both sides of it faces one way: a nostril's rim is none.
bool is_step(std::span<const Vec3f> at, std::span<const Vec3f> beside, const Triangle& t) {
  Vec3f around{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3f a = unit(beside[t[k]]), b = unit(beside[t[(k + 1) % 3]]);
    if (length(a) > 0 && length(b) > 0 && dot(a, b) < kSameWayCosine) return false;
    around = plus(around, a);
  }
  return length(around) > 0 && dot(unit(area_normal(at, t)), unit(around)) < kStepCosine;
}

}  // namespace

std::pmr::vector<float> smooth_steps(std::span<Vec3f> vertices_mm, std::span<const Triangle> triangles,
                                     std::span<const std::uint8_t> label, std::span<const std::uint8_t> stays,
                                     std::pmr::memory_resource* memory) {
  std::pmr::vector<float> moved(vertices_mm.size(), 0.0F, memory);
  const auto is_known = [&](const Triangle& t) {
    return std::none_of(t.begin(), t.end(), [&](std::uint32_t v) { return label[v] == kBetweenNothing; });
  };
  const auto is_between = [&](const Triangle& t) {
    return is_known(t) && (label[t[0]] != label[t[1]] || label[t[0]] != label[t[2]]);
  };
  std::pmr::vector<Vec3f> beside(vertices_mm.size(), Vec3f{}, memory);
  for (const Triangle& t : triangles) {
    if (is_between(t)) continue;
    const Vec3f n = area_normal(vertices_mm, t);
    for (const std::uint32_t v : t) beside[v] = plus(beside[v], n);
  }
  // Rings around a step: 0 is far away, the highest the step itself.
  constexpr std::uint8_t kStep = kRings + kHeldRings + 1;
  std::pmr::vector<std::uint8_t> near(vertices_mm.size(), 0, memory);
  bool any = false;
  for (const Triangle& t : triangles) {
    if (!is_between(t)) continue;
    if (!is_step(vertices_mm, beside, t)) continue;
    for (const std::uint32_t v : t) near[v] = kStep;
    any = true;
  }
  if (!any) return moved;
  for (std::uint8_t ring = kStep; ring > 1; --ring)
    for (const Triangle& t : triangles)
      if (near[t[0]] == ring || near[t[1]] == ring || near[t[2]] == ring)
        for (const std::uint32_t v : t) near[v] = std::max(near[v], static_cast<std::uint8_t>(ring - 1));

  std::pmr::vector<std::uint32_t> part_of(vertices_mm.size(), 0, memory), all_of(memory);
  for (std::uint32_t v = 0; v < near.size(); ++v)
    if (near[v] > 0) {
      part_of[v] = static_cast<std::uint32_t>(all_of.size());
      all_of.push_back(v);
    }
  std::vector<Eigen::Vector3d> at;
  std::vector<char> free;
  for (const std::uint32_t v : all_of) {
    const Vec3d p = wide(vertices_mm[v]);
    at.emplace_back(p.x, p.y, p.z);
    free.push_back(near[v] > kHeldRings && stays[v] == 0 && label[v] != kBetweenNothing ? 1 : 0);
  }
  std::vector<Triangle> part;
  for (const Triangle& t : triangles)
    if (near[t[0]] > 0 && near[t[1]] > 0 && near[t[2]] > 0 && is_known(t))
      part.push_back({part_of[t[0]], part_of[t[1]], part_of[t[2]]});
  fair(at, part, free);
  for (std::size_t i = 0; i < all_of.size(); ++i) {
    if (free[i] == 0) continue;
    const Vec3f now = narrow(Vec3d{at[i].x(), at[i].y(), at[i].z()});
    Vec3f& was = vertices_mm[all_of[i]];
    const Vec3f normal = unit(beside[all_of[i]]), way = minus(now, was);
    moved[all_of[i]] = length(normal) > 0 ? std::abs(dot(normal, way)) : length(way);
    was = now;
  }
  return moved;
}

}  // namespace relievo::pipeline
