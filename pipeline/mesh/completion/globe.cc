// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/completion/globe.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace relievo::pipeline {
namespace {

using Edge = std::array<std::uint32_t, 2>;

Edge edge_of(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

// Of a node's neighbours, each, in Loop's mean.
double neighbour_share(int neighbours) {
  const double c = 0.375 + 0.25 * std::cos(2 * std::numbers::pi / neighbours);
  return (0.625 - c * c) / neighbours;
}

double sum(double a, double share, double b) { return a + share * b; }
Vec3d sum(const Vec3d& a, double share, const Vec3d& b) {
  return {a.x + share * b.x, a.y + share * b.y, a.z + share * b.z};
}

}  // namespace

Globe::Globe(int times, std::pmr::memory_resource* memory) : direction(memory), triangles(memory) {
  const double height = 1 / std::sqrt(5.0), across = 2 / std::sqrt(5.0);
  direction.push_back({0, 0, -1});
  for (int k = 0; k < 10; ++k) {  // two rings of five, turned against each other
    const double angle = std::numbers::pi * (k % 5 * 2 + k / 5) / 5;
    direction.push_back({across * std::cos(angle), across * std::sin(angle), k < 5 ? -height : height});
  }
  direction.push_back({0, 0, 1});
  for (std::uint32_t k = 0; k < 5; ++k) {
    const std::uint32_t next = (k + 1) % 5;
    triangles.push_back({0, 1 + next, 1 + k});
    triangles.push_back({1 + k, 1 + next, 6 + k});
    triangles.push_back({1 + next, 6 + next, 6 + k});
    triangles.push_back({11, 6 + k, 6 + next});
  }
  for (int k = 0; k < times; ++k) quarter({});
}

void Globe::quarter(std::span<std::pmr::vector<double>> fields) {
  std::pmr::memory_resource* const memory = direction.get_allocator().resource();
  const std::size_t before = direction.size();
  std::pmr::vector<Edge> edges(memory);
  edges.reserve(3 * triangles.size());
  for (const auto& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) edges.push_back(edge_of(t[k], t[(k + 1) % 3]));
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto at = std::lower_bound(edges.begin(), edges.end(), edge_of(a, b));
    return static_cast<std::uint32_t>(before) + static_cast<std::uint32_t>(at - edges.begin());
  };
  std::pmr::vector<int> neighbours(before, 0, memory);
  for (const Edge& e : edges) ++neighbours[e[0]], ++neighbours[e[1]];
  const auto smoothed = [&](const auto& field, auto fine) {
    fine.resize(before + edges.size());
    const auto add = [&fine](std::uint32_t to, double share, const auto& value) {
      fine[to] = sum(fine[to], share, value);
    };
    for (std::uint32_t v = 0; v < before; ++v)
      add(v, 1 - neighbours[v] * neighbour_share(neighbours[v]), field[v]);
    for (const Edge& e : edges) {
      add(e[0], neighbour_share(neighbours[e[0]]), field[e[1]]);
      add(e[1], neighbour_share(neighbours[e[1]]), field[e[0]]);
    }
    for (const auto& t : triangles)  // an edge has two of them
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = t[k], b = t[(k + 1) % 3], at = middle(a, b);
        add(at, 3.0 / 16, field[a]), add(at, 3.0 / 16, field[b]), add(at, 2.0 / 16, field[t[(k + 2) % 3]]);
      }
    return fine;
  };
  for (auto& field : fields) field = smoothed(field, std::pmr::vector<double>(memory));
  if (fields.empty()) {
    direction.resize(before + edges.size());
    for (std::size_t k = 0; k < edges.size(); ++k)
      direction[before + k] = sum(direction[edges[k][0]], 1, direction[edges[k][1]]);
  } else {
    direction = smoothed(direction, std::pmr::vector<Vec3d>(memory));
  }
  for (Vec3d& d : direction) d = sum({}, 1 / std::hypot(d.x, d.y, d.z), d);
  std::pmr::vector<std::array<std::uint32_t, 3>> fine(memory);
  fine.reserve(4 * triangles.size());
  for (const auto& [a, b, c] : triangles) {
    const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    fine.insert(fine.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
  }
  triangles = std::move(fine);
}

}  // namespace relievo::pipeline
