// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
//   ripple_return [HEADS [KEY VALUE ...]]        settings of the algorithms
//
// How much detail the default algorithms keep: waves of 0.3 mm along x are added to a simulated head, and
// what is left of their height is read off the model, for waves of several lengths. The same person without
// waves is the zero:
//   share = sum(measured * true) / sum(true^2)
// over the measured vertices of the face, where measured and true are depths along a pixel's ray beyond the
// smooth head's. A share of 1 keeps all; blur that buys smooth surfaces shows as less.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "hal/sim/head/head_scene.h"
#include "hal/sim/render.h"
#include "pipeline/pipeline.h"
#include "tests/support/rig_calibration.h"
#include "tests/support/stage_fixture.h"

namespace relievo::bench {
namespace {

using namespace hal::sim;  // NOLINT: one small program
using namespace pipeline;  // NOLINT

constexpr double kHeightMm = 0.3;

struct Person {
  std::shared_ptr<const HeadModel> model;
  std::unique_ptr<Scene> scene;
};

Person person(std::uint32_t seed, double wave_mm, double shine, ThreadPool& pool) {
  HeadTraits traits = traits_of(seed);
  traits.shine = shine;
  if (wave_mm > 0) traits.ripple_mm = kHeightMm, traits.ripple_wave_mm = wave_mm;
  Person p;
  p.model = make_head(traits, pool);
  p.scene = make_head_scene(p.model, HeadPose{}, pool);
  return p;
}

Result<FaceMesh> reconstruct(const Scene& scene, const SimRig& rig, const AlgorithmSet& algorithms,
                             test::StageFixture& room) {
  room.output.reset();
  const hal::sim::PicturePair pictures = render_pair(scene, rig, {}, 1, room.pool);
  RELIEVO_TRY_ASSIGN(const Pipeline stages, Pipeline::make(algorithms, test::true_calibration(rig)));
  RELIEVO_TRY_ASSIGN(auto pair,
                     stages.rectify({pictures.left.view(), pictures.right.view(), 0, 0}, room.context));
  RELIEVO_TRY_ASSIGN(const auto matches, stages.match(pair, room.context));
  RELIEVO_TRY_ASSIGN(const auto cloud, stages.reconstruct(pair, matches, room.context));
  return stages.mesh(cloud, pair, room.context);
}

double share_kept(const FaceMesh& mesh, const Scene& rippled, const Scene& smooth) {
  double product = 0;
  double square = 0;
  for (std::size_t i = 0; i < mesh.vertices_mm.size(); ++i) {
    if (mesh.measured[i] == 0) continue;
    const Vec3f& v = mesh.vertices_mm[i];
    const Vec3 p{static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
    const double far = std::sqrt(dot(p, p));
    const Vec3 ray = p * (1 / far);
    SolidPoint with, without;
    if (!rippled.solid({}, ray, with) || !smooth.solid({}, ray, without) || !with.skin || !without.skin)
      continue;
    if (-dot(without.normal, ray) < 0.7) continue;  // steep skin turns a wave into a step
    const double true_mm =
        std::sqrt(dot(with.point, with.point)) - std::sqrt(dot(without.point, without.point));
    if (std::abs(true_mm) > 2 * kHeightMm) continue;  // another surface
    const double measured_mm = far - std::sqrt(dot(without.point, without.point));
    if (std::abs(measured_mm) > 2) continue;
    product += measured_mm * true_mm;
    square += true_mm * true_mm;
  }
  return square > 0 ? product / square : 0;
}

int run(int heads, const AlgorithmSet& algorithms) {
  test::StageFixture room;
  constexpr double kWaves[] = {4, 6, 8, 12};
  std::printf("share of a wave of %.1f mm that comes back\n%6s %9s", kHeightMm, "head", "skin");
  for (const double wave : kWaves) std::printf("%7.0f mm", wave);
  std::printf("\n");
  for (int k = 0; k < 2 * heads; ++k) {
    const auto seed = static_cast<std::uint32_t>(101 + k / 2);
    const double shine = k % 2;
    const SimRig rig = make_rig({.seed = seed});
    const Person smooth = person(seed, 0, shine, room.pool);
    std::printf("%6u %9s", seed, shine > 0 ? "glossy" : "powdered");
    for (const double wave : kWaves) {
      const Person waved = person(seed, wave, shine, room.pool);
      const auto mesh = reconstruct(*waved.scene, rig, algorithms, room);
      if (!mesh) {
        std::fprintf(stderr, "ripple_return: head %u: %.*s\n", seed,
                     static_cast<int>(mesh.error().what.view().size()), mesh.error().what.view().data());
        return 1;
      }
      std::printf("%10.2f", share_kept(*mesh, *waved.scene, *smooth.scene));
      std::fflush(stdout);
    }
    std::printf("\n");
  }
  return 0;
}

}  // namespace
}  // namespace relievo::bench

int main(int argc, char** argv) {
  relievo::pipeline::AlgorithmSet algorithms;
  for (int i = 2; i + 1 < argc; i += 2)
    if (const auto done = algorithms.set(argv[i], argv[i + 1]); !done) {
      std::fprintf(stderr, "ripple_return: %s: %.*s\n", argv[i],
                   static_cast<int>(done.error().what.view().size()), done.error().what.view().data());
      return 2;
    }
  return relievo::bench::run(argc > 1 ? std::atoi(argv[1]) : 3, algorithms);
}
