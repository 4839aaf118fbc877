// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What one live relief and one whole look of the gate cost, with OpenCV's semi-global matcher (three-way
// mode) on the same quarter-size pair in the same run. Compare processor times and their ratio; wall times on
// a busy machine say little.
//   live_relief_bench LEFT RIGHT RIG.yml [ROUNDS] [OUT.png]
// OUT.png: the depth as grey values, near is bright, black is unknown.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "hal/picture_file.h"
#include "pipeline/base/workspace.h"
#include "pipeline/calibrate/file/calibration_file.h"
#include "pipeline/gate/capture_gate.h"
#include "pipeline/gate/relief/live_relief.h"
#include "pipeline/match/rectify/rectifier.h"
#include "tests/bench/peer.h"

namespace relievo::bench {
namespace {

template <typename T>
T need(Result<T> result) {
  if (result) return *std::move(result);
  std::fprintf(stderr, "live_relief_bench: %s\n", std::string(result.error().what.view()).c_str());
  std::exit(1);
}

struct Time {
  double cpu_ms, wall_ms;
};

template <typename Work>
Time median_of(int rounds, Work&& work) {
  std::vector<double> cpu, wall;
  for (int i = 0; i < rounds; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    std::timespec a{}, b{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &a);
    work();
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &b);
    cpu.push_back(1e3 * static_cast<double>(b.tv_sec - a.tv_sec) +
                  1e-6 * static_cast<double>(b.tv_nsec - a.tv_nsec));
    wall.push_back(
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
  }
  std::sort(cpu.begin(), cpu.end());
  std::sort(wall.begin(), wall.end());
  return {cpu[cpu.size() / 2], wall[wall.size() / 2]};
}

void draw(const pipeline::Relief& relief, const std::string& file) {
  std::vector<std::byte> grey(relief.depth_mm.size());
  pipeline::draw_relief(relief, 400, 1100, reinterpret_cast<std::uint8_t*>(grey.data()));
  if (!hal::write_picture(
          file, {grey.data(), relief.width_px, relief.height_px, relief.width_px, PixelFormat::Grey8}))
    std::exit(1);
}

int run(int argc, char** argv) {
  if (argc < 4) {
    std::fprintf(stderr, "usage: live_relief_bench LEFT RIGHT RIG.yml [ROUNDS] [OUT.png]\n");
    return 2;
  }
  const hal::Picture left = need(hal::read_picture(argv[1])), right = need(hal::read_picture(argv[2]));
  const auto calibration = need(pipeline::read_calibration(argv[3]));
  const int rounds = argc > 4 ? std::max(1, std::atoi(argv[4])) : 15;
  pipeline::Workspace work(2);
  const pipeline::LiveRelief live;
  const pipeline::StereoFrame frame{left.view(), right.view()};
  const auto look = [&] {
    work.output.reset();
    return need(pipeline::run_stage(work.context,
                                    [&](auto& context) { return live.look(frame, calibration, context); }));
  };
  const Time ours = median_of(rounds, [&] { look(); });
  std::printf(
      "live relief   %6.1f ms processor, %6.1f ms wall: %.1f a second on two free cores or more; scratch %.1f MB, output %.1f MB\n",
      ours.cpu_ms, ours.wall_ms, 2000 / ours.cpu_ms, 1e-6 * static_cast<double>(work.scratch.high_water()),
      1e-6 * static_cast<double>(work.output.high_water()));
  auto gate = need(pipeline::CaptureGate::open());
  pipeline::GateHistory history;
  pipeline::GateTime now{};
  const Time whole = median_of(2 * rounds, [&] {
    work.output.reset();
    now += std::chrono::milliseconds(66);
    need(pipeline::run_stage(
        work.context, [&](auto& context) { return gate.look(frame, calibration, now, history, context); }));
  });
  std::printf("whole look    %6.1f ms processor, %6.1f ms wall: %.1f a second on one core\n", whole.cpu_ms,
              whole.wall_ms, 1000 / whole.cpu_ms);
  if (argc > 5) draw(look(), argv[5]);
  work.output.reset();
  pipeline::StageContext& c = work.context;
  pipeline::RectifierOptions volume;
  volume.near_mm = live.kNearMm, volume.far_mm = live.kFarMm;
  const pipeline::StereoFrame small{pipeline::reduced(frame.left, 4, c),
                                    pipeline::reduced(frame.right, 4, c)};
  const auto pair = need(volume.rectify(small, pipeline::reduced(calibration, 4), c));
  const Time peer = median_of(rounds, [&] { match_like_the_peer(pair); });
  std::printf("peer, matching alone %6.1f ms processor, %6.1f ms wall; ratio %.2f\n", peer.cpu_ms,
              peer.wall_ms, ours.cpu_ms / peer.cpu_ms);
  return 0;
}

}  // namespace
}  // namespace relievo::bench

int main(int argc, char** argv) { return relievo::bench::run(argc, argv); }
