// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "pipeline/fuse/rim.h"
#include "pipeline/mesh/completion/mesh_laplacian.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

constexpr float kStepCosine = 0.93F;  // 21 degrees
constexpr float kFoldCosine = 0.77F;  // 40 degrees
constexpr float kSameWayCosine = 0.8F;
constexpr std::uint8_t kStepRings = 6;  // of vertices that are laid anew at a step
constexpr std::uint8_t kFoldRings = 4;  // and at a fold
constexpr int kNormalRounds = 4;        // how far around a fold the surface is looked at
constexpr double kTensionMm = 15;
constexpr std::uint8_t kHeldRings = 2;  // around those, what says how the surface goes on

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

std::pmr::vector<Vec3f> area_normals(std::span<const Vec3f> vertices_mm, std::span<const Triangle> triangles,
                                     std::pmr::memory_resource* memory) {
  std::pmr::vector<Vec3f> normals(vertices_mm.size(), Vec3f{}, memory);
  for (const Triangle& t : triangles) {
    const Vec3f n = area_normal(vertices_mm, t);
    for (const std::uint32_t v : t) normals[v] = plus(normals[v], n);
  }
  return normals;
}

void add_steps(std::span<const Vec3f> vertices_mm, std::span<const Triangle> triangles,
               std::span<const std::uint8_t> label, std::span<std::uint8_t> part,
               std::pmr::memory_resource* memory) {
  const auto is_between = [&](const Triangle& t) {
    return std::none_of(t.begin(), t.end(), [&](std::uint32_t v) { return label[v] == kBetweenNothing; }) &&
           (label[t[0]] != label[t[1]] || label[t[0]] != label[t[2]]);
  };
  std::pmr::vector<Vec3f> beside(vertices_mm.size(), Vec3f{}, memory);
  for (const Triangle& t : triangles) {
    if (is_between(t)) continue;
    const Vec3f n = area_normal(vertices_mm, t);
    for (const std::uint32_t v : t) beside[v] = plus(beside[v], n);
  }
  for (const Triangle& t : triangles)
    if (is_between(t) && is_step(vertices_mm, beside, t))
      for (const std::uint32_t v : t) part[v] = std::max(part[v], kStepRings);
}

void add_folds(std::span<const Vec3f> vertices_mm, std::span<const Triangle> triangles,
               std::span<const std::uint8_t> unsure, std::span<std::uint8_t> part,
               std::pmr::memory_resource* memory) {
  std::pmr::vector<Vec3f> normal = area_normals(vertices_mm, triangles, memory), around(memory);
  for (int round = 0; round < kNormalRounds; ++round) {
    around.assign(normal.size(), Vec3f{});
    for (const Triangle& t : triangles)
      for (const std::uint32_t v : t)
        for (const std::uint32_t w : t) around[v] = plus(around[v], normal[w]);
    for (std::size_t v = 0; v < normal.size(); ++v) normal[v] = unit(around[v]);
  }
  for (const Triangle& t : triangles) {
    if (std::any_of(t.begin(), t.end(), [&](std::uint32_t v) { return unsure[v] == 0; })) continue;
    const Vec3f beside = plus(plus(normal[t[0]], normal[t[1]]), normal[t[2]]);
    if (length(beside) > 0 && dot(unit(area_normal(vertices_mm, t)), unit(beside)) < kFoldCosine)
      for (const std::uint32_t v : t) part[v] = std::max(part[v], kFoldRings);
  }
}

void spread_rings(std::span<const Triangle> triangles, std::span<std::uint8_t> rings) {
  const std::uint8_t most = rings.empty() ? std::uint8_t{0} : *std::max_element(rings.begin(), rings.end());
  for (std::uint8_t ring = most; ring > 1; --ring)
    for (const Triangle& t : triangles)
      if (rings[t[0]] == ring || rings[t[1]] == ring || rings[t[2]] == ring)
        for (const std::uint32_t v : t) rings[v] = std::max(rings[v], std::uint8_t(ring - 1));
}

std::pmr::vector<float> fair_part(std::span<Vec3f> vertices_mm, std::span<const Triangle> triangles,
                                  std::span<const std::uint8_t> part, std::span<const std::uint8_t> stays,
                                  std::pmr::memory_resource* memory) {
  std::pmr::vector<float> moved(vertices_mm.size(), 0.0F, memory);
  // How many rings more follow; those from kHeldRings down are held, 0 is far away.
  std::pmr::vector<std::uint8_t> rings(vertices_mm.size(), 0, memory);
  for (std::size_t v = 0; v < rings.size(); ++v)
    if (part[v] > 0) rings[v] = std::uint8_t(part[v] + kHeldRings);
  spread_rings(triangles, rings);

  std::pmr::vector<std::uint32_t> place(vertices_mm.size(), 0, memory), all(memory);
  std::vector<Eigen::Vector3d> at;
  std::vector<char> free;
  for (std::uint32_t v = 0; v < rings.size(); ++v) {
    if (rings[v] == 0) continue;
    place[v] = std::uint32_t(all.size());
    all.push_back(v);
    const Vec3d p = wide(vertices_mm[v]);
    at.emplace_back(p.x, p.y, p.z);
    free.push_back(rings[v] > kHeldRings && stays[v] == 0 ? 1 : 0);
  }
  std::vector<Triangle> around;
  std::pmr::vector<Vec3f> normals(all.size(), Vec3f{}, memory);
  for (const Triangle& t : triangles) {
    if (rings[t[0]] == 0 || rings[t[1]] == 0 || rings[t[2]] == 0) continue;
    around.push_back({place[t[0]], place[t[1]], place[t[2]]});
    const Vec3f n = area_normal(vertices_mm, t);
    for (const std::uint32_t v : around.back()) normals[v] = plus(normals[v], n);
  }
  fair(at, around, free, kTensionMm);
  // Two vertices on one place would join the sheets there.
  constexpr float kApartMm = 0.001F;
  std::pmr::set<std::array<float, 3>> taken(memory);
  const auto take = [&](const Vec3f& p) { return taken.insert({p.x, p.y, p.z}).second; };
  for (std::size_t i = 0; i < all.size(); ++i)
    if (free[i] == 0) take(vertices_mm[all[i]]);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (free[i] == 0) continue;
    Vec3f now = narrow(Vec3d{at[i].x(), at[i].y(), at[i].z()});
    while (!take(now)) now.z += kApartMm;
    Vec3f& was = vertices_mm[all[i]];
    const Vec3f normal = unit(normals[i]), way = minus(now, was);
    moved[all[i]] = length(normal) > 0 ? std::abs(dot(normal, way)) : length(way);
    was = now;
  }
  return moved;
}

void unfold(std::span<Vec3f> vertices_mm, std::span<const Triangle> triangles,
            std::pmr::memory_resource* memory) {
  constexpr int kUnfoldingRounds = 24, kAlone = 4;  // rounds in which the neighbours do not move
  std::pmr::vector<std::uint8_t> turned(memory), stays(vertices_mm.size(), 0, memory);
  for (const BorderEdge& e : border_edges(triangles, memory)) stays[e[0]] = 1;
  std::pmr::vector<Vec3f> sum(memory);
  std::pmr::vector<float> count(memory);
  for (int round = 0; round < kUnfoldingRounds; ++round) {
    const auto normal = area_normals(vertices_mm, triangles, memory);
    turned.assign(vertices_mm.size(), 0);
    bool any = false;
    for (const Triangle& t : triangles) {
      const Vec3f around = plus(plus(normal[t[0]], normal[t[1]]), normal[t[2]]);
      if (dot(area_normal(vertices_mm, t), around) >= 0) continue;
      any = true;
      for (const std::uint32_t v : t) turned[v] = round < kAlone ? 1 : 2;
    }
    if (!any) return;
    spread_rings(triangles, turned);
    for (std::size_t v = 0; v < stays.size(); ++v)
      if (stays[v] != 0) turned[v] = 0;
    sum.assign(vertices_mm.size(), Vec3f{});
    count.assign(vertices_mm.size(), 0);
    for (const Triangle& t : triangles)
      for (std::size_t k = 0; k < 3; ++k) {
        if (turned[t[k]] == 0) continue;
        sum[t[k]] = plus(sum[t[k]], plus(vertices_mm[t[(k + 1) % 3]], vertices_mm[t[(k + 2) % 3]]));
        count[t[k]] += 2;
      }
    for (std::size_t v = 0; v < vertices_mm.size(); ++v)
      if (turned[v] != 0) vertices_mm[v] = times(sum[v], 1 / count[v]);
  }
}

}  // namespace relievo::pipeline
