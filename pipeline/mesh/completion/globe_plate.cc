// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/completion/globe_plate.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/SparseCholesky>

#include "pipeline/mesh/completion/mesh_laplacian.h"

namespace relievo::pipeline {
namespace {

constexpr double kBandMm = 12;    // of known values: what lies further inside cannot tell how they go on
constexpr double kReturnMm = 40;  // to zero
constexpr double kNearMm = 1;     // over which the plate smooths what is known
constexpr double kBentMm = 50;    // from the known part the shape bends as its own does, not on the way there

// Sharing one sphere, all nodes count alike: h h / 4 times the Laplacian, which in a lattice of equal
// triangles with sides of h is what a node's neighbours' mean is off.
MeshLaplacian bends_of(const Globe& globe) {
  std::vector<Eigen::Vector3d> at;
  for (const Vec3d& d : globe.direction) at.emplace_back(d.x, d.y, d.z);
  MeshLaplacian laplacian = laplacian_of(at, globe.triangles);
  const double share = 4 * std::numbers::pi / static_cast<double>(at.size()) / (2 * std::sqrt(3.0));
  for (auto& its : laplacian.neighbours)
    for (auto& n : its) n.weight *= share;
  return laplacian;
}

// How many steps a node lies from those whose value is known, or from those whose is not; at most `most`.
std::vector<int> steps_from(bool known, const MeshLaplacian& bends, std::span<const double> value, int most) {
  std::vector<int> steps(value.size(), most);
  std::vector<int> front;
  for (std::size_t v = 0; v < value.size(); ++v)
    if (std::isnan(value[v]) != known) steps[v] = 0, front.push_back(static_cast<int>(v));
  for (std::size_t next = 0; next < front.size(); ++next) {
    const auto v = static_cast<std::size_t>(front[next]);
    for (const auto& n : bends.neighbours[v])
      if (steps[n.vertex] > steps[v] + 1)
        steps[n.vertex] = steps[v] + 1, front.push_back(static_cast<int>(n.vertex));
  }
  return steps;
}

// From 0 to 1 without a bend at either end.
double risen(double share) { return share * share * (3 - 2 * share); }

// A term (h / 2 l)^4 beside squared means of neighbours less the node itself acts over the length l.
double weight_of(double step_mm, double length_mm) { return std::pow(step_mm / (2 * length_mm), 4); }

}  // namespace

void continue_over_globe(const Globe& globe, double step_mm, std::span<const double> shape,
                         std::span<double> value) {
  const MeshLaplacian laplacian = bends_of(globe);
  const int band = std::max(2, static_cast<int>(std::lround(kBandMm / step_mm)));
  const std::vector<int> depth = steps_from(false, laplacian, value, band + 1);
  const int bent = std::max(1, static_cast<int>(kBentMm / step_mm));
  const std::vector<int> away = steps_from(true, laplacian, value, bent);
  std::vector<int> place(value.size(), -1);
  int count = 0;
  for (std::size_t v = 0; v < value.size(); ++v)
    if (depth[v] <= band) place[v] = count++;
  std::vector<Eigen::Triplet<double>> bends, weights;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(count), own_bend = Eigen::VectorXd::Zero(count);
  for (std::size_t v = 0; v < value.size(); ++v) {
    if (place[v] < 0) continue;
    const double weight = weight_of(step_mm, depth[v] > 0 ? kNearMm : kReturnMm);
    weights.emplace_back(place[v], place[v], weight);
    if (depth[v] > 0) right[place[v]] = weight * value[v];
    if (depth[v] == band) continue;  // some of its neighbours take no part
    double its_bend = 0;
    for (const auto& [n, share] : laplacian.neighbours[v]) {
      bends.emplace_back(place[v], place[v], -share);
      bends.emplace_back(place[v], place[n], share);
      its_bend += share * (shape[n] - shape[v]);
    }
    own_bend[place[v]] = (1 - risen(static_cast<double>(away[v]) / bent)) * its_bend;
  }
  using Sparse = Eigen::SparseMatrix<double>;
  Sparse bend(count, count), near(count, count);
  bend.setFromTriplets(bends.begin(), bends.end());
  near.setFromTriplets(weights.begin(), weights.end());
  const Sparse normal = Sparse(bend.transpose() * bend) + near;
  const Eigen::VectorXd solved =
      Eigen::SimplicialLDLT<Sparse>(normal).solve(right - bend.transpose() * own_bend);
  for (std::size_t v = 0; v < value.size(); ++v)
    if (depth[v] == 0) value[v] = solved[place[v]];
}

}  // namespace relievo::pipeline
