// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/completion/globe_plate.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/SparseCholesky>

namespace relievo::pipeline {
namespace {

constexpr double kBandMm = 12;    // of known values: what lies further inside cannot tell how they go on
constexpr double kReturnMm = 40;  // to zero
constexpr double kNearMm = 1;     // over which the plate smooths what is known
constexpr double kBentMm = 50;    // from the known part the shape bends as its own does, not on the way there

using Neighbours = std::vector<std::vector<int>>;

Neighbours neighbours_of(const Globe& globe) {
  Neighbours all(globe.direction.size());
  for (const auto& t : globe.triangles)  // each edge runs once in either direction
    for (std::size_t k = 0; k < 3; ++k) all[t[k]].push_back(static_cast<int>(t[(k + 1) % 3]));
  return all;
}

// How many steps a node lies from those whose value is known, or from those whose is not; at most `most`.
std::vector<int> steps_from(bool known, const Neighbours& neighbours, std::span<const double> value,
                            int most) {
  std::vector<int> steps(value.size(), most);
  std::vector<int> front;
  for (std::size_t v = 0; v < value.size(); ++v)
    if (std::isnan(value[v]) != known) steps[v] = 0, front.push_back(static_cast<int>(v));
  for (std::size_t next = 0; next < front.size(); ++next) {
    const auto v = static_cast<std::size_t>(front[next]);
    for (const int n : neighbours[v])
      if (steps[static_cast<std::size_t>(n)] > steps[v] + 1)
        steps[static_cast<std::size_t>(n)] = steps[v] + 1, front.push_back(n);
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
  const Neighbours neighbours = neighbours_of(globe);
  const int band = std::max(2, static_cast<int>(std::lround(kBandMm / step_mm)));
  const std::vector<int> depth = steps_from(false, neighbours, value, band + 1);
  const int bent = std::max(1, static_cast<int>(kBentMm / step_mm));
  const std::vector<int> away = steps_from(true, neighbours, value, bent);
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
    bends.emplace_back(place[v], place[v], -1);
    double its_bend = -shape[v];
    for (const int n : neighbours[v]) {
      const double share = 1.0 / static_cast<double>(neighbours[v].size());
      bends.emplace_back(place[v], place[static_cast<std::size_t>(n)], share);
      its_bend += share * shape[static_cast<std::size_t>(n)];
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
