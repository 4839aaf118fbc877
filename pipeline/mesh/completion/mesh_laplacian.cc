// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/completion/mesh_laplacian.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>

namespace relievo::pipeline {
namespace {

constexpr double kMostCotangent = 20;
constexpr double kLeastPull = 0.1;  // of the tension along an edge

using Sparse = Eigen::SparseMatrix<double>;

}  // namespace

MeshLaplacian laplacian_of(std::span<const Eigen::Vector3d> at, std::span<const Triangle> triangles) {
  MeshLaplacian laplacian{std::vector<std::vector<MeshLaplacian::Neighbour>>(at.size()),
                          std::vector<double>(at.size(), 0.0)};
  const auto add = [&](std::uint32_t from, std::uint32_t to, double weight) {
    auto& its = laplacian.neighbours[from];
    const auto found = std::ranges::find_if(its, [to](const auto& n) { return n.vertex == to; });
    if (found == its.end()) its.push_back({to, weight});
    else found->weight += weight;
  };
  for (const auto& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
      const Eigen::Vector3d u = at[a] - at[c], v = at[b] - at[c];
      const double twice = u.cross(v).norm();
      const double cotangent = std::clamp(u.dot(v) / std::max(twice, 1e-12), -kMostCotangent, kMostCotangent);
      laplacian.area[c] += twice / 6;
      add(a, b, cotangent / 2), add(b, a, cotangent / 2);
    }
  for (std::size_t v = 0; v < at.size(); ++v)
    for (auto& n : laplacian.neighbours[v]) n.weight /= std::max(laplacian.area[v], 1e-12);
  return laplacian;
}

void fair(std::span<Eigen::Vector3d> at, std::span<const Triangle> triangles, std::span<const char> free,
          double tension_mm) {
  const MeshLaplacian laplacian = laplacian_of(at, triangles);
  std::vector<int> place(at.size(), -1);
  int count = 0;
  for (std::size_t v = 0; v < at.size(); ++v)  // nothing says where one of no triangle should lie
    if (free[v] != 0 && !laplacian.neighbours[v].empty()) place[v] = count++;
  if (count == 0) return;
  // A row a vertex that is free or beside one that is: its bend, from what is free and from what stays.
  std::vector<Eigen::Triplet<double>> bends;
  std::vector<Eigen::RowVector3d> stays;
  for (std::size_t v = 0; v < at.size(); ++v) {
    const auto& its = laplacian.neighbours[v];
    const auto moves = [&](const auto& n) { return free[n.vertex] != 0; };
    if (free[v] == 0 && std::ranges::none_of(its, moves)) continue;
    const double weight = std::sqrt(laplacian.area[v]);
    Eigen::RowVector3d known = Eigen::RowVector3d::Zero();
    const auto add = [&](std::size_t to, double share) {
      if (place[to] >= 0) bends.emplace_back(int(stays.size()), place[to], share);
      else known += share * at[to].transpose();
    };
    for (const auto& n : its) add(n.vertex, weight * n.weight), add(v, -weight * n.weight);
    stays.push_back(known);
    for (const auto& n : its) {
      if (tension_mm <= 0 || (free[v] == 0 && free[n.vertex] == 0)) continue;
      const double pull = std::sqrt(std::max(laplacian.area[v] * n.weight, kLeastPull) / 2) / tension_mm;
      known.setZero();
      add(n.vertex, pull), add(v, -pull);
      stays.push_back(known);
    }
  }
  Sparse bend(static_cast<Eigen::Index>(stays.size()), count);
  bend.setFromTriplets(bends.begin(), bends.end());
  Eigen::MatrixX3d right(bend.rows(), 3);
  for (Eigen::Index r = 0; r < right.rows(); ++r) right.row(r) = -stays[std::size_t(r)];
  const Eigen::SimplicialLDLT<Sparse> solver(Sparse(bend.transpose() * bend));
  const Eigen::MatrixX3d solved = solver.solve(bend.transpose() * right);
  if (solver.info() != Eigen::Success || !solved.allFinite())
    throw std::runtime_error("a surface could not be laid anew");
  for (std::size_t v = 0; v < at.size(); ++v)
    if (place[v] >= 0) at[v] = solved.row(place[v]).transpose();
}

}  // namespace relievo::pipeline
