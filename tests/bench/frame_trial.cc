// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/frame_trial.h"

#include <numbers>

#include "firmware/measure/measurement.h"
#include "firmware/reconstruct/reconstruction.h"
#include "pipeline/pipeline.h"

namespace relievo::bench {
namespace {

using namespace pipeline;  // NOLINT: a bench of the pipeline
namespace measure = firmware::measure;

RigidTransform chained(const RigidTransform& outer, const RigidTransform& inner) {
  return {product(outer.rotation, inner.rotation), apply(outer, inner.translation_mm)};
}

}  // namespace

std::string person_of(const std::filesystem::path& folder) {
  const std::string name = folder.filename().string();
  return name.substr(0, name.rfind('_'));
}

std::string pose_of(const std::filesystem::path& folder) {
  const std::string name = folder.filename().string();
  return name.substr(name.rfind('_') + 1);
}

Result<FaceMesh> reconstruct_folder(const std::filesystem::path& folder, test::StageFixture& room,
                                    Vec3d& across) {
  room.output.reset();
  RELIEVO_TRY_ASSIGN(const auto pictures, firmware::read_pair(folder / "left.png", folder / "right.png"));
  RELIEVO_TRY_ASSIGN(const auto calibration,
                     firmware::read_calibration_for(pictures, folder / "rig.yml", folder / "left.png"));
  RELIEVO_TRY_ASSIGN(const Pipeline stages, Pipeline::make({}, calibration));
  RELIEVO_TRY_ASSIGN(auto pair, stages.rectify(pictures.frame(), room.context));
  RELIEVO_TRY_ASSIGN(const auto matches, stages.match(pair, room.context));
  RELIEVO_TRY_ASSIGN(const auto cloud, stages.reconstruct(pair, matches, room.context));
  const double* x = pair.rectified_from_left.m;
  across = {x[0], x[1], x[2]};
  return stages.mesh(cloud, pair, room.context);
}

RigidTransform a_from_b(const Photograph& a, const Photograph& b) {
  const RigidTransform guess = chained(inverse(a.frame.head_from_camera), b.frame.head_from_camera);
  const Vec3d tip = apply(inverse(b.frame.head_from_camera), Vec3d{});
  std::vector<Vec3d> points;
  const auto& vertices = b.true_surface.vertices_mm;
  for (std::size_t i = 0; i < vertices.size(); i += 1 + vertices.size() / 40'000) {
    const Vec3d p = pipeline::wide(vertices[i]);
    if (pipeline::distance(p, tip) < 90) points.push_back(apply(guess, p));
  }
  const measure::TriangleGrid grid(a.true_surface);
  return chained(measure::fit_rigidly(points, grid).surface_from_points, guess);
}

Apart between(const Photograph& a, const Photograph& b, const RigidTransform& a_from_b) {
  const RigidTransform a_head_from_b_head =
      chained(a.frame.head_from_camera, chained(a_from_b, inverse(b.frame.head_from_camera)));
  const double* m = a_head_from_b_head.rotation.m;
  constexpr double kDeg = 180 / std::numbers::pi;
  Apart apart;
  apart.turns_deg = {0.5 * (m[7] - m[5]) * kDeg, 0.5 * (m[2] - m[6]) * kDeg, 0.5 * (m[3] - m[1]) * kDeg};
  apart.turned_deg = pipeline::length(apart.turns_deg);
  apart.origin_mm = a_head_from_b_head.translation_mm;
  return apart;
}

}  // namespace relievo::bench
