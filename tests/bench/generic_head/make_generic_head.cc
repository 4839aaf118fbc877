// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
//   make_generic_head > pipeline/mesh/completion/generic_head.bin
//
// Learns the generic head (pipeline/mesh/completion/generic_head.h) from heads of hal/sim: the head frame is
// found on each one's front, and two sets of radii are read off the head itself: about the frame's axis, and
// about a point within it, all round, the neck cut off. Written are the mean and the principal components of
// the first, and what of the second goes with each of these components (linear regression). On standard
// error: how much of the spread the components hold, and what is left of heads that took no part.
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory_resource>
#include <span>
#include <vector>

#include "hal/sim/head/shape/form.h"
#include "hal/sim/head/shape/head_field.h"
#include "pipeline/mesh/completion/generic_head.h"
#include "pipeline/mesh/completion/globe.h"
#include "pipeline/mesh/completion/unrolled_head.h"
#include "pipeline/mesh/landmarks/head_frame.h"
#include "pipeline/mesh/surface_cleaner.h"
#include "tests/support/stage_bench.h"

namespace relievo::bench {
namespace {

using namespace pipeline;  // NOLINT: one small program

constexpr std::uint32_t kFirstSeed = 5000;  // other people than in any test
constexpr int kKeptApart = 30;
constexpr int kCells = kHeadColumns * kHeadRows;
constexpr double kNeckEnd = -125;  // y of the head's frame, rounded over 12 mm

using hal::sim::cut;
using hal::sim::HeadField;
using hal::sim::smoothstep;

// Hair hides that the back of a simulated skull is a column with a rim round the crown and another above the
// neck. A generic head has no hair: behind the ears it ends where the skull's ellipsoid does.
double bald(const HeadField& field, const Vec3d& p) {
  const double half_length = field.traits.head_length / 2;
  const hal::sim::Vec3 from{p.x, p.y - 40, p.z - 106 + half_length};
  const double ellipsoid =
      hal::sim::ellipsoid(from, {field.traits.head_breadth / 2 + 1, from.y > 0 ? 81.0 : 130.0, half_length});
  const double elsewhere = 60 * smoothstep(-70, 10, p.z) + 250 * smoothstep(-58, -85, p.y);
  return cut(field.distance({p.x, p.y, p.z}), ellipsoid - elsewhere, 30);
}

// From outside, at `from` along `way`, to where the head begins, by the line through the last two distances.
template <typename Distance>
double first_met(Distance&& distance, const Vec3d& centre, const Vec3d& way, double from) {
  double before = 1e6, at_before = from;
  for (double radius = from; radius > 10;) {
    const double d =
        distance({centre.x + radius * way.x, centre.y + radius * way.y, centre.z + radius * way.z});
    if (d < 0.05) return radius - d * (at_before - radius) / (before - d);
    before = d, at_before = radius;
    radius -= std::clamp(0.5 * d, 0.05, 3.0);
  }
  return 10;
}

// The head from the front, every 2.5 mm, in its own frame.
FaceMesh front_of(const HeadField& field, ThreadPool& pool) {
  constexpr int kAcross = 59, kUp = 75;
  constexpr float kStep = 2.5F, kMostStep = 10;  // mm; and in depth
  FaceMesh mesh(std::pmr::get_default_resource());
  mesh.vertices_mm.resize(kAcross * kUp);
  mesh.sigma_mm.assign(kAcross * kUp, 0.1F);
  mesh.measured.assign(kAcross * kUp, 1);
  pool.for_each_band(kUp, kUp, [&](int begin, int end, int) {
    for (int r = begin; r < end; ++r)
      for (int c = 0; c < kAcross; ++c) {
        const float x = kStep * static_cast<float>(c - kAcross / 2);
        const float y = kStep * static_cast<float>(r - kUp / 2) - 10;
        const double z = first_met(
            [&](const Vec3d& p) {
              return field.distance({p.x, p.y, p.z});
            },
            {static_cast<double>(x), static_cast<double>(y), 0}, {0, 0, 1}, 150);
        mesh.vertices_mm[static_cast<std::size_t>(r * kAcross + c)] = {x, y, static_cast<float>(z)};
      }
  });
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const auto [low, high] =
        std::minmax({mesh.vertices_mm[a].z, mesh.vertices_mm[b].z, mesh.vertices_mm[c].z});
    if (low > 20 && high - low < kMostStep) mesh.triangles.push_back({a, b, c});
  };
  for (std::uint32_t r = 0; r + 1 < kUp; ++r)
    for (std::uint32_t c = 0; c + 1 < kAcross; ++c) {
      const std::uint32_t k = r * kAcross + c;
      add(k, k + 1, k + kAcross + 1);
      add(k, k + kAcross + 1, k + kAcross);
    }
  compute_normals(mesh, 1, std::pmr::get_default_resource());
  return mesh;
}

// An ear is thinner than the globe's nodes lie apart: each takes the mean of what lies around it.
void take_means(const Globe& fine, std::span<const double> radius, Eigen::Ref<Eigen::RowVectorXd> means) {
  std::vector<double> sum(radius.size()), count(radius.size(), 2);
  for (std::size_t v = 0; v < radius.size(); ++v) sum[v] = 2 * radius[v];
  for (const auto& t : fine.triangles)  // each edge runs once in either direction
    for (std::size_t k = 0; k < 3; ++k) sum[t[k]] += radius[t[(k + 1) % 3]], count[t[k]] += 1;
  for (Eigen::Index v = 0; v < means.size(); ++v)
    means(v) = sum[static_cast<std::size_t>(v)] / count[static_cast<std::size_t>(v)];
}

// `fine`: the globe, quartered once more.
bool learn(std::uint32_t seed, relievo::test::StageBench& room, const Globe& fine,
           Eigen::Ref<Eigen::RowVectorXd> radii) {
  const HeadField field(hal::sim::traits_of(seed));
  const FaceMesh front = front_of(field, room.pool);
  const auto frame = run_stage(room.context, [&](StageContext& c) { return find_head_frame(front, c); });
  if (!frame) return false;
  const RigidTransform sim_from_head = inverse(frame->head_from_camera);
  room.pool.for_each_band(kHeadRows, kHeadRows, [&](int begin, int end, int) {
    for (int r = begin; r < end; ++r)
      for (int c = 0; c < kHeadColumns; ++c) {
        const double arc = -kHalfArc + 2 * kHalfArc * c / (kHeadColumns - 1);
        const double y = -kBelow + (kBelow + kAbove) * r / (kHeadRows - 1);
        radii(r * kHeadColumns + c) = first_met(
            [&](const Vec3d& at) {
              const Vec3d p = apply(sim_from_head, at);
              return field.distance({p.x, p.y, p.z});
            },
            {0, y, -kAxisBehind}, {std::sin(arc / kArcRadius), 0, std::cos(arc / kArcRadius)}, 170);
      }
  });
  std::vector<double> globe(fine.direction.size());
  const int nodes = static_cast<int>(globe.size());
  room.pool.for_each_band(nodes, nodes, [&](int begin, int end, int) {
    for (int k = begin; k < end; ++k)
      globe[static_cast<std::size_t>(k)] = first_met(
          [&](const Vec3d& at) { return cut(bald(field, apply(sim_from_head, at)), kNeckEnd - at.y, 12); },
          kGlobeCentre, fine.direction[static_cast<std::size_t>(k)], 200);
  });
  take_means(fine, globe, radii.tail(kGlobeNodes));
  return true;
}

template <typename Values>
void write(const Values& values, double unit) {
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    const auto count = static_cast<std::int16_t>(std::lround(values(i) / unit));
    std::fwrite(&count, sizeof(count), 1, stdout);
  }
}

// What is left of `apart` when `modes`, weighted by the rows of `weight`, are taken away.
Eigen::MatrixXd left_of(const Eigen::MatrixXd& apart, const Eigen::MatrixXd& weight,
                        const Eigen::MatrixXd& modes) {
  return apart - weight * modes.transpose();
}

// Mean, modes and what is left of one set of radii.
void write_part(const Eigen::RowVectorXd& mean, const Eigen::MatrixXd& modes, const Eigen::MatrixXd& left) {
  write(mean, kHeadMeanUnit);
  write(modes, kHeadModeUnit);
  write(left.array().square().colwise().mean().sqrt().eval(), kHeadMeanUnit);
}

int run() {
  relievo::test::StageBench room;
  const Globe fine(kGlobeTimes + 1, std::pmr::get_default_resource());
  Eigen::MatrixXd people(kHeadPeople + kKeptApart, kCells + kGlobeNodes);
  int count = 0;
  for (std::uint32_t seed = kFirstSeed; count < people.rows(); ++seed) {
    if (seed > kFirstSeed + 2 * kHeadPeople)
      return std::fprintf(stderr, "make_generic_head: too few heads had a frame\n"), 1;
    Eigen::RowVectorXd radii(people.cols());
    if (learn(seed, room, fine, radii)) people.row(count++) = radii;
  }
  const Eigen::RowVectorXd mean = people.topRows(kHeadPeople).colwise().mean();
  const Eigen::MatrixXd spread = people.topRows(kHeadPeople).rowwise() - mean;
  const Eigen::MatrixXd apart = people.bottomRows(kKeptApart).rowwise() - mean;
  const Eigen::BDCSVD<Eigen::MatrixXd> svd(spread.leftCols(kCells),
                                           Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::VectorXd s = svd.singularValues() / std::sqrt(kHeadPeople - 1.0);
  const Eigen::MatrixXd modes = svd.matrixV().leftCols(kHeadModes) * s.head(kHeadModes).asDiagonal();
  const Eigen::MatrixXd weight = apart.leftCols(kCells) * svd.matrixV().leftCols(kHeadModes) *
                                 s.head(kHeadModes).cwiseInverse().asDiagonal();
  const Eigen::MatrixXd globe_modes = spread.rightCols(kGlobeNodes).transpose() *
                                      svd.matrixU().leftCols(kHeadModes) / std::sqrt(kHeadPeople - 1.0);
  const Eigen::MatrixXd left = left_of(apart.leftCols(kCells), weight, modes);
  const Eigen::MatrixXd globe_left = left_of(apart.rightCols(kGlobeNodes), weight, globe_modes);
  const auto rms = [](const Eigen::MatrixXd& m) {
    return std::sqrt(m.squaredNorm() / static_cast<double>(m.size()));
  };
  std::fprintf(
      stderr,
      "%d modes hold %.1f %% of the variance; of %d other heads %.2f mm (rms) of %.2f is left, all round "
      "%.2f of %.2f\n",
      kHeadModes, 100 * s.head(kHeadModes).squaredNorm() / s.squaredNorm(), kKeptApart, rms(left),
      rms(apart.leftCols(kCells)), rms(globe_left), rms(apart.rightCols(kGlobeNodes)));
  std::fwrite(&kGenericHeadHeader, sizeof(kGenericHeadHeader), 1, stdout);
  write_part(mean.head(kCells), modes, left);
  write_part(mean.tail(kGlobeNodes), globe_modes, globe_left);
  return std::fflush(stdout) == 0 ? 0 : 1;
}

}  // namespace
}  // namespace relievo::bench

int main() { return relievo::bench::run(); }
