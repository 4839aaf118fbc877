// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
//   make_generic_head > pipeline/mesh/completion/generic_head_data.cc
//
// Learns the generic head (pipeline/mesh/completion/generic_head.h) from heads of hal/sim: each is measured
// as the cameras would see it from the front, the head frame is found on that, and the radii about the
// frame's axis are read off the head itself, all round. Their mean and principal components are written as
// source. On standard error: how much of the spread the components hold, and what is left of heads that took
// no part.
#include <Eigen/SVD>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "pipeline/mesh/completion/generic_head.h"
#include "pipeline/mesh/completion/unrolled_head.h"
#include "pipeline/mesh/landmarks/head_frame.h"
#include "pipeline/mesh/meshers/grid_mesher.h"
#include "tests/pipeline/mesh/landmarks/field_head.h"
#include "tests/support/stage_bench.h"

namespace relievo::bench {
namespace {

using namespace pipeline;  // NOLINT: one small program

constexpr std::uint32_t kFirstSeed = 5000;  // other people than in any test
constexpr int kKeptApart = 30;
constexpr int kCells = kHeadColumns * kHeadRows;

// From outside towards the axis, where the head begins.
double radius_at(const hal::sim::HeadField& field, const RigidTransform& sim_from_head, double arc,
                 double y) {
  for (double radius = 170; radius > 10;) {
    const Vec3d p = apply(sim_from_head, rolled(arc, y, radius));
    const double d = field.distance({p.x, p.y, p.z});
    if (d < 0.05) return radius;
    radius -= std::clamp(0.5 * d, 0.05, 3.0);
  }
  return 10;
}

bool learn(std::uint32_t seed, relievo::test::StageBench& room, Eigen::Ref<Eigen::RowVectorXd> radii) {
  const pipeline::test::FieldHead head(seed);
  room.output.reset();
  const PointCloud cloud = head.cloud({}, room.pool, 0);
  const auto mesh = run_stage(room.context, [&](StageContext& c) { return GridMesher({}).mesh(cloud, c); });
  if (!mesh) return false;
  const auto frame = run_stage(room.context, [&](StageContext& c) { return find_head_frame(*mesh, {}, c); });
  if (!frame) return false;
  const RigidTransform camera_from_head = inverse(frame->head_from_camera);
  const RigidTransform sim_from_camera = inverse(pipeline::test::FieldHead::camera_from_head({}));
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
        radii(r * kHeadColumns + c) = radius_at(head.field(), sim_from_head, arc, y);
      }
  });
  return true;
}

template <typename Values>
void print(const Values& values, double unit) {
  for (int i = 0; i < kCells; ++i)
    std::printf("%s%ld,", i % 24 == 0 ? "\n    " : "", std::lround(values(i) / unit));
}

int run() {
  relievo::test::StageBench room;
  Eigen::MatrixXd people(kHeadPeople + kKeptApart, kCells);
  int count = 0;
  for (std::uint32_t seed = kFirstSeed; count < people.rows(); ++seed) {
    if (seed > kFirstSeed + 2 * kHeadPeople)
      return std::fprintf(stderr, "make_generic_head: too few heads had a frame\n"), 1;
    Eigen::RowVectorXd radii(kCells);
    if (learn(seed, room, radii)) people.row(count++) = radii;
  }
  const Eigen::RowVectorXd mean = people.topRows(kHeadPeople).colwise().mean();
  const Eigen::MatrixXd spread = people.topRows(kHeadPeople).rowwise() - mean;
  const Eigen::BDCSVD<Eigen::MatrixXd> svd(spread, Eigen::ComputeThinV);
  const Eigen::VectorXd s = svd.singularValues();
  const Eigen::MatrixXd modes = svd.matrixV().leftCols(kHeadModes);
  const Eigen::MatrixXd apart = people.bottomRows(kKeptApart).rowwise() - mean;
  const Eigen::MatrixXd left = apart - apart * modes * modes.transpose();
  std::fprintf(stderr,
               "%d modes hold %.1f %% of the variance; of %d other heads %.2f mm (rms) of %.2f is left\n",
               kHeadModes, 100 * s.head(kHeadModes).squaredNorm() / s.squaredNorm(), kKeptApart,
               std::sqrt(left.squaredNorm() / static_cast<double>(left.size())),
               std::sqrt(apart.squaredNorm() / static_cast<double>(apart.size())));
  std::printf(
      "// SPDX-FileCopyrightText: 2026 The Relievo authors\n// SPDX-License-Identifier: GPL-3.0-or-later\n//\n"
      "// Written by make_generic_head; see generic_head.h.\n#include \"pipeline/mesh/completion/generic_head.h\"\n\n"
      "namespace relievo::pipeline {\n\n// clang-format off\nconst std::array<std::int16_t, kHeadColumns * kHeadRows> kHeadMean{");
  print(mean, kHeadMeanUnit);
  std::printf(
      "\n};\n\nconst std::array<std::array<std::int16_t, kHeadColumns * kHeadRows>, kHeadModes> kHeadMode{{");
  for (int k = 0; k < kHeadModes; ++k) {
    std::printf("{{");
    print((modes.col(k) * (s(k) / std::sqrt(kHeadPeople - 1.0))).eval(), kHeadModeUnit);
    std::printf("\n}},\n");
  }
  std::printf("}};\n\nconst std::array<std::int16_t, kHeadColumns * kHeadRows> kHeadLeft{");
  print((left.array().square().colwise().mean().sqrt()).eval(), kHeadMeanUnit);
  std::printf("\n};\n// clang-format on\n\n}  // namespace relievo::pipeline\n");
  return 0;
}

}  // namespace
}  // namespace relievo::bench

int main() { return relievo::bench::run(); }
