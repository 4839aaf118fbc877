// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/eyes/eyeballs.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "hal/base/statistics.h"
#include "pipeline/base/solving.h"
#include "pipeline/mesh/landmarks/landmark_finder.h"
#include "pipeline/mesh/surface_cleaner.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

constexpr double kRadiusMm = 12.2;
constexpr double kErrorMm = 0.3;    // of what a matcher measures on a ball
constexpr double kLikeOthers = 12;  // vertices whose errors are one and the same: so many tell as much as one
constexpr double kAsideSigmaMm = 2,
                 kAboveSigmaMm = 1.5;  // of a ball's middle, from that of what is seen of it
constexpr double kUnlikeSigmaMm = 1;   // of one ball's middle, from the other's mirrored
constexpr double kMarginMm = 0.8;      // from the lids' margins, which are smeared
// A ball lies that far behind what spans from lid to lid, at most, and before it, by the millimetre from the
// margins: beyond that corners of eyes are filled with flesh, and lids lie before a ball.
constexpr double kBehind = 2, kMostBehindMm = 3, kBefore = 1, kSoftMm = 0.3;
constexpr double kNearMm = 0.05;
constexpr float kSigmaMm = 0.3F;                  // where a ball fits; towards the lids it is worse
constexpr std::size_t kFewest = 60, kMost = 400;  // vertices that a ball is fitted to
constexpr int kRounds = 12, kPasses = 400;

using Points = std::pmr::vector<Eigen::Vector3d>;

struct Eye {
  explicit Eye(std::pmr::memory_resource* memory) : within(memory), seen(memory) {}
  std::optional<Lids> lids;
  std::pmr::vector<std::uint32_t> within;  // vertices between the lids
  Points seen;                             // some that were measured, in the head's frame
  Eigen::Vector3d middle{0, 0, 0};         // of those
  double weight() const { return double(seen.size()) / kLikeOthers; }
};

struct Settled {
  std::array<Eigen::Vector3d, 2> middles;
  double cost = 0;
};

// Cauchy's weights, Gauss-Newton's steps.
Settled settle(const std::array<Eye, 2>& eyes, const Eigen::Vector3d& off) {
  std::array<Eigen::Vector3d, 2> at;
  for (std::size_t i = 0; i < 2; ++i)
    at[i] = eyes[i].middle + Eigen::Vector3d(i == 0 ? -off.x() : off.x(), off.y(), off.z());
  double cost = 0;
  for (int round = 0; round < kRounds; ++round) {
    Eigen::Matrix<double, 6, 6> normal = 1e-9 * Eigen::Matrix<double, 6, 6>::Identity();
    Eigen::Matrix<double, 6, 1> right = Eigen::Matrix<double, 6, 1>::Zero();
    cost = 0;
    const auto expect = [&](const Eigen::Matrix<double, 6, 1>& slope, double error, double weight) {
      normal += weight * slope * slope.transpose();
      right -= weight * error * slope;
      cost += weight * error * error;
    };
    for (std::size_t i = 0; i < 2; ++i) {
      const std::ptrdiff_t first = std::ptrdiff_t(3 * i);
      for (const Eigen::Vector3d& p : eyes[i].seen) {
        const Eigen::Vector3d from = p - at[i];
        const double distance = from.norm(), error = (distance - kRadiusMm) / kErrorMm,
                     weight = 1 / (1 + error * error);
        const Eigen::Vector3d slope = -from / (distance * kErrorMm);
        normal.block<3, 3>(first, first) += weight * slope * slope.transpose();
        right.segment<3>(first) -= weight * error * slope;
        cost += std::log1p(error * error);
      }
      const double sigmas[] = {kAsideSigmaMm, kAboveSigmaMm};
      for (std::ptrdiff_t k = 0; k < 2; ++k)
        expect(Eigen::Matrix<double, 6, 1>::Unit(first + k) / sigmas[k],
               (at[i][k] - eyes[i].middle[k]) / sigmas[k], eyes[i].weight());
    }
    for (std::ptrdiff_t k = 0; k < 3; ++k) {
      const double mirrored = k == 0 ? 1 : -1;
      Eigen::Matrix<double, 6, 1> slope = Eigen::Matrix<double, 6, 1>::Zero();
      slope[k] = 1 / kUnlikeSigmaMm;
      slope[3 + k] = mirrored / kUnlikeSigmaMm;
      expect(slope, (at[0][k] + mirrored * at[1][k]) / kUnlikeSigmaMm,
             std::min(eyes[0].weight(), eyes[1].weight()));
    }
    const Eigen::Matrix<double, 6, 1> step = solved<6>(normal, right);
    at[0] += step.head<3>();
    at[1] += step.tail<3>();
  }
  return {at, cost};
}

void collect(Eye& eye, const FaceMesh& mesh, const std::pmr::vector<Vec3d>& in_head) {
  std::pmr::vector<std::uint32_t> measured(eye.within.get_allocator());
  for (std::uint32_t v = 0; v < in_head.size(); ++v) {
    const double depth = eye.lids->depth({in_head[v].x, in_head[v].y});
    if (depth > 0) eye.within.push_back(v);
    if (depth > kMarginMm && mesh.measured[v] != 0) measured.push_back(v);
  }
  if (measured.size() < kFewest) return;
  const std::size_t every = measured.size() / kMost + 1;
  std::pmr::vector<double> depths(eye.within.get_allocator());
  for (std::size_t k = 0; k < measured.size(); k += every) {
    const Vec3d& p = in_head[measured[k]];
    eye.seen.emplace_back(p.x, p.y, p.z);
    eye.middle += eye.seen.back();
    depths.push_back(p.z);
  }
  eye.middle /= double(eye.seen.size());
  eye.middle.z() = median(depths);
}

struct Edge {
  std::uint32_t from, to;
  double weight;
};

// Around the vertices whose `eye_of` is `eye`, by vertex; the nearer the more weight.
std::pmr::vector<Edge> edges_of(std::uint8_t eye, const FaceMesh& mesh,
                                const std::pmr::vector<std::uint8_t>& eye_of,
                                const std::pmr::vector<Vec3d>& in_head, Arena& scratch) {
  std::pmr::vector<Edge> edges(&scratch);
  const auto add = [&](std::uint32_t a, std::uint32_t b) {
    edges.push_back(
        {a, b, 1 / (kNearMm + std::hypot(in_head[a].x - in_head[b].x, in_head[a].y - in_head[b].y))});
  };
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      if (eye_of[t[k]] == eye) add(t[k], t[(k + 1) % 3]), add(t[k], t[(k + 2) % 3]);
  std::ranges::sort(
      edges, [](const Edge& a, const Edge& b) { return a.from != b.from ? a.from < b.from : a.to < b.to; });
  return edges;
}

// What spans from lid to lid: every vertex lies as high as its neighbours do in the mean.
void span(const std::pmr::vector<Edge>& edges, std::pmr::vector<Vec3d>& in_head) {
  for (int pass = 0; pass < kPasses; ++pass)
    for (std::size_t k = 0; k < edges.size();) {
      const std::uint32_t v = edges[k].from;
      double sum = 0, weights = 0;
      for (; k < edges.size() && edges[k].from == v; ++k)
        sum += edges[k].weight * in_head[edges[k].to].z, weights += edges[k].weight;
      in_head[v].z = sum / weights;
    }
}

// The larger one, without an edge where both are equal.
double soft_larger(double a, double b) { return (a + b + std::hypot(a - b, kSoftMm)) / 2; }

}  // namespace

void lay_eyeballs(FaceMesh& mesh, const RigidTransform& head_from_camera, const RectifiedPair& pair,
                  StageContext& context) {
  Arena& scratch = context.scratch;
  const Arena::Mark mark(scratch);
  const auto lids = find_lids(mesh, head_from_camera, pair, context);
  if ((!lids[0] && !lids[1]) || context.stop()) return;
  std::pmr::vector<Vec3d> in_head(&scratch);
  in_head.reserve(mesh.vertices_mm.size());
  for (const Vec3f& p : mesh.vertices_mm) in_head.push_back(apply(head_from_camera, wide(p)));
  std::array<Eye, 2> eyes{Eye(&scratch), Eye(&scratch)};
  for (std::size_t i = 0; i < 2; ++i) {
    eyes[i].lids = lids[i];
    if (lids[i]) collect(eyes[i], mesh, in_head);
  }
  // Both balls' middles, the right eye's before the left one's; an eye that is not found follows the other.
  constexpr int kStarts = 18;
  std::array<Settled, kStarts> ends;
  context.pool.for_each(kStarts, kStarts, [&](int k) {
    ends[std::size_t(k)] =
        settle(eyes, {3.0 * (k / 3 % 3) - 3, 2.0 * (k % 3) - 2, -kRadiusMm - (k < kStarts / 2 ? -1.0 : 1.0)});
  });
  const auto balls = std::ranges::min_element(ends, {}, &Settled::cost)->middles;
  std::pmr::vector<std::uint8_t> moved(in_head.size(), 0, &scratch);  // the eye, from 1
  for (std::uint8_t i = 0; i < 2; ++i)
    if (!eyes[i].seen.empty())
      for (const std::uint32_t v : eyes[i].within) moved[v] = i + 1;
  const std::array edges{edges_of(1, mesh, moved, in_head, scratch),
                         edges_of(2, mesh, moved, in_head, scratch)};
  context.pool.for_each(2, 2, [&](int i) { span(edges[std::size_t(i)], in_head); });
  for (std::size_t i = 0; i < 2; ++i)
    for (const std::uint32_t v : eyes[i].within) {
      if (moved[v] == 0) continue;
      Vec3d& p = in_head[v];
      const Eigen::Vector3d& ball = balls[i];
      const double depth = lids[i]->depth({p.x, p.y}), x = p.x - ball.x(), y = p.y - ball.y();
      const double on_ball = ball.z() + std::sqrt(std::max(0.0, kRadiusMm * kRadiusMm - x * x - y * y));
      p.z = -soft_larger(-soft_larger(on_ball, p.z - std::min(kMostBehindMm, kBehind * depth)),
                         -p.z - kBefore * depth);
    }
  const RigidTransform camera_from_head = inverse(head_from_camera);
  for (std::uint32_t v = 0; v < moved.size(); ++v) {
    if (moved[v] == 0) continue;
    mesh.vertices_mm[v] = narrow(apply(camera_from_head, in_head[v]));
    mesh.measured[v] = 0;
    mesh.sigma_mm[v] = std::max(mesh.sigma_mm[v], kSigmaMm);
    mesh.normals[v] = {};
  }
  for (const auto& t : mesh.triangles) {
    if ((moved[t[0]] | moved[t[1]] | moved[t[2]]) == 0) continue;
    const Vec3f across = area_normal(mesh.vertices_mm, t);
    for (const std::uint32_t v : t)
      if (moved[v] != 0) mesh.normals[v] = plus(mesh.normals[v], across);
  }
  for (std::uint32_t v = 0; v < moved.size(); ++v)
    if (moved[v] != 0) mesh.normals[v] = unit(mesh.normals[v]);
}

}  // namespace relievo::pipeline
