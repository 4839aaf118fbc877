// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What every stage costs, on one simulated head at full size, with the peer in the same run: compare
// ratios, never times of different runs.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <cstdlib>
#include <optional>
#include <thread>

#include "hal/base/thread_pool.h"
#include "hal/sim/head/shape/head_traits.h"
#include "hal/sim/render.h"
#include "pipeline/base/workspace.h"
#include "pipeline/pipeline.h"
#include "tests/bench/peer.h"
#include "tests/support/rig_calibration.h"

namespace relievo::bench {
namespace {

using namespace pipeline;  // NOLINT: one file of benchmarks

// The pictures and every stage's product, made once; each benchmark runs its own stage again.
struct Bench : Workspace {
  Bench()
      : Workspace(static_cast<int>(std::thread::hardware_concurrency()), std::size_t{640} << 20,
                  std::size_t{768} << 20) {
    const hal::sim::SimRig rig = hal::sim::make_rig({});
    const auto head = hal::sim::make_head(hal::sim::traits_of(1), pool);
    const auto scene = hal::sim::make_head_scene(head, {}, pool);
    pictures = hal::sim::render_pair(*scene, rig, {}, 1, pool);
    auto made = Pipeline::make({}, test::true_calibration(rig));
    if (!made) fail(made.error());
    stages.emplace(*std::move(made));
    frame = {pictures.left.view(), pictures.right.view()};
    pair.emplace(need(stages->rectify(frame, context)));
    matches.emplace(need(stages->match(*pair, context)));
    cloud.emplace(need(stages->reconstruct(*pair, *matches, context)));
    mesh.emplace(need(stages->mesh(*cloud, *pair, context)));
    kept = output.used();
  }
  [[noreturn]] static void fail(const Error& error) {
    std::fprintf(stderr, "bench: %.*s\n", static_cast<int>(error.what.view().size()),
                 error.what.view().data());
    std::exit(1);
  }
  template <typename T>
  static T need(Result<T> result) {
    if (!result) fail(result.error());
    return *std::move(result);
  }

  hal::sim::PicturePair pictures;
  StereoFrame frame;
  std::optional<Pipeline> stages;
  std::optional<RectifiedPair> pair;
  std::optional<MatchSet> matches;
  std::optional<PointCloud> cloud;
  std::optional<FaceMesh> mesh;
  std::size_t kept = 0;
};

Bench& bench() {
  static Bench one;
  return one;
}

template <typename Stage>
void run(benchmark::State& state, Stage&& stage) {
  Bench& b = bench();
  for (auto _ : state) {
    Arena::Mark mark(b.output);
    benchmark::DoNotOptimize(stage(b));
  }
}

void rectify(benchmark::State& s) {
  run(s, [](Bench& b) { return b.stages->rectify(b.frame, b.context).has_value(); });
}
void match(benchmark::State& s) {
  run(s, [](Bench& b) { return b.stages->match(*b.pair, b.context).has_value(); });
}
void reconstruct(benchmark::State& s) {
  run(s, [](Bench& b) { return b.stages->reconstruct(*b.pair, *b.matches, b.context).has_value(); });
}
void mesh(benchmark::State& s) {
  run(s, [](Bench& b) { return b.stages->mesh(*b.cloud, *b.pair, b.context).has_value(); });
}
void texture(benchmark::State& s) {
  run(s, [](Bench& b) { return b.stages->texture(*b.mesh, *b.pair, b.context).has_value(); });
}
void peer_sgbm_3way(benchmark::State& s) {
  run(s, [](Bench& b) { return match_like_the_peer(*b.pair); });
}

BENCHMARK(rectify)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(match)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(reconstruct)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(mesh)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(texture)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(peer_sgbm_3way)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace relievo::bench

BENCHMARK_MAIN();
