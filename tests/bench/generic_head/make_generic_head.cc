// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
//   make_generic_head > pipeline/mesh/completion/generic_head.bin
//
// Learns the generic head (pipeline/mesh/completion/generic_head.h) from heads of hal/sim: each is measured
// as the cameras would see it from the front, the head frame is found on that, and two sets of radii are read
// off the head itself: about the frame's axis, and about a point within it, all round, the neck cut off.
// Written are the mean and the principal components of the first, and what of the second goes with each of
// these components (linear regression). On standard error: how much of the spread the components hold, and
// what is left of heads that took no part.
#include <Eigen/SVD>

#include "hal/sim/head/shape/head_field.h"

#include <cmath>
#include <cstdio>
#include <memory_resource>

#include "pipeline/mesh/completion/completions.h"
#include "pipeline/mesh/completion/generic_head.h"
#include "pipeline/mesh/landmarks/head_frame.h"
#include "pipeline/mesh/meshers/grid_mesher.h"
#include "tests/pipeline/mesh/landmarks/field_head.h"
#include "tests/support/stage_fixture.h"

namespace relievo::bench {
namespace {

using namespace pipeline;  // NOLINT: one small program

constexpr std::uint32_t kFirstSeed = 5000;  // other people than in any test
constexpr int kHeadPeople = 300;
constexpr int kKeptApart = 30;
constexpr int kCells = kHeadColumns * kHeadRows;
constexpr double kNeckEnd = -125;  // y of the head's frame, rounded over 12 mm

// Both about the head's frame: from outside, at `from` along `way`, to where the head begins.
double first_met(const hal::sim::HeadField& field, const RigidTransform& sim_from_head, const Vec3d& centre,
                 const Vec3d& way, double from, bool neck_ends) {
  for (double radius = from; radius > 10;) {
    const Vec3d at{centre.x + radius * way.x, centre.y + radius * way.y, centre.z + radius * way.z};
    const Vec3d p = apply(sim_from_head, at);
    double d = field.distance({p.x, p.y, p.z});
    if (neck_ends) d = hal::sim::cut(d, kNeckEnd - at.y, 12);
    if (d < 0.05) return radius;
    radius -= std::clamp(0.5 * d, 0.05, 3.0);
  }
  return 10;
}

bool learn(std::uint32_t seed, relievo::test::StageFixture& room, const Globe& globe,
           Eigen::Ref<Eigen::RowVectorXd> radii) {
  const pipeline::FieldHead head(seed);
  room.output.reset();
  const PointCloud cloud = head.cloud({}, room.pool, 0);
  const auto mesh = run_stage(room.context, [&](StageContext& c) { return GridMesher({}).mesh(cloud, c); });
  if (!mesh) return false;
  const auto frame = run_stage(room.context, [&](StageContext& c) { return find_head_frame(*mesh, c); });
  if (!frame) return false;
  const RigidTransform camera_from_head = inverse(frame->head_from_camera);
  const RigidTransform sim_from_camera = inverse(pipeline::FieldHead::camera_from_head({}));
  RigidTransform sim_from_head;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) {
      double sum = 0;
      for (int m = 0; m < 3; ++m)
        sum += sim_from_camera.rotation.m[3 * i + m] * camera_from_head.rotation.m[3 * m + k];
      sim_from_head.rotation.m[3 * i + k] = sum;
    }
  sim_from_head.translation_mm = apply(sim_from_camera, camera_from_head.translation_mm);
  room.pool.for_each_band(kHeadRows, kHeadRows, [&](int begin, int end, int) {
    for (int r = begin; r < end; ++r)
      for (int c = 0; c < kHeadColumns; ++c) {
        const double arc = -kHalfArc + 2 * kHalfArc * c / (kHeadColumns - 1);
        const double y = -kBelow + (kBelow + kAbove) * r / (kHeadRows - 1);
        radii(r * kHeadColumns + c) =
            first_met(head.field(), sim_from_head, {0, y, -kAxisBehind},
                      {std::sin(arc / kArcRadius), 0, std::cos(arc / kArcRadius)}, 170, false);
      }
  });
  room.pool.for_each_band(kGlobeNodes, kGlobeNodes, [&](int begin, int end, int) {
    for (int k = begin; k < end; ++k)
      radii(kCells + k) = first_met(head.field(), sim_from_head, kGlobeCentre,
                                    globe.direction[static_cast<std::size_t>(k)], 250, true);
  });
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
  relievo::test::StageFixture room;
  const Globe globe(kGlobeTimes, std::pmr::get_default_resource());
  Eigen::MatrixXd people(kHeadPeople + kKeptApart, kCells + kGlobeNodes);
  int count = 0;
  for (std::uint32_t seed = kFirstSeed; count < people.rows(); ++seed) {
    if (seed > kFirstSeed + 2 * kHeadPeople)
      return std::fprintf(stderr, "make_generic_head: too few heads had a frame\n"), 1;
    Eigen::RowVectorXd radii(people.cols());
    if (learn(seed, room, globe, radii)) people.row(count++) = radii;
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
