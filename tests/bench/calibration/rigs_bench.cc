// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Calibration against the peer on the same pictures: N simulated rigs (default 20), boards blurred by
// 1.5 px with a lamp on one side; 14, 8 and 6 views, and each of these with two more of a board that was
// bumped between the two exposures. What counts is the worst depth error over the face volume (450 to
// 680 mm, +-80 mm; the truth projected with the true rig, triangulated with the estimated one), in mm.
// Exit code 1 where ours is on average worse than the peer's, or more than half of it with bumped views,
// or more than a tenth of the good corners is rejected.
//   rigs_bench [N]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "hal/sim/render.h"
#include "pipeline/calibrate/calibrator.h"
#include "pipeline/calibrate/quality/rig_geometry.h"
#include "tests/bench/calibration/rig_peer.h"

namespace relievo::bench {
namespace {

constexpr int kGood = 14;
constexpr int kBumped = 2;

struct Sets {
  std::vector<pipeline::BoardCorners> left, right;  // the good ones, then the bumped ones
};

struct Rendered {
  hal::sim::SimRig rig;
  Sets ours;
  Sets peers;
};

const pipeline::BoardPattern kPattern{10, 7, 20};

hal::sim::SimulationOptions options_of(std::uint32_t seed) {
  hal::sim::SimulationOptions o;
  o.scene = hal::sim::SceneKind::Board;
  o.rig.seed = seed;
  o.rig.baseline_mm = 90 + 10.0 * (seed % 8);
  o.rig.focal_px = 2300 + 150.0 * (seed % 6);
  o.rig.perturbation = 1.5;
  o.board_look.lamp = 0.6;
  o.sensor.defocus_px = 1.5;
  return o;
}

bool photograph(std::uint32_t seed, ThreadPool& pool, Rendered& out) {
  const hal::sim::SimulationOptions o = options_of(seed);
  out.rig = hal::sim::make_rig(o.rig);
  const auto poses = hal::sim::good_board_poses(out.rig, o.board, kGood + kBumped, seed);
  if (!poses) return false;
  for (int v = 0; v < kGood + kBumped; ++v) {
    hal::sim::BodyPose pose = (*poses)[static_cast<std::size_t>(v)];
    const auto photo = [&](const hal::sim::SimView& view, std::uint64_t noise_seed) {
      const hal::sim::BoardScene scene(o.board, pose, o.board_look);
      return hal::sim::read_sensor(hal::sim::expose(scene, view, o.sensor, pool), o.sensor, noise_seed);
    };
    const auto noise_seed = static_cast<std::uint64_t>(seed) * 1000 + static_cast<std::uint64_t>(v) * 2;
    const hal::Picture left = photo(out.rig.left, noise_seed);
    if (v >= kGood) {
      pose.origin_mm.x += 1.2;
      pose.origin_mm.y -= 0.8;
      pose.origin_mm.z += v % 2 == 0 ? 1.5 : -1.5;
    }
    const hal::Picture right = photo(out.rig.right, noise_seed + 1);
    const auto found = [](const hal::Picture& picture) {
      auto corners = pipeline::find_board(picture.view(), kPattern);
      return corners ? std::move(*corners) : pipeline::BoardCorners{};
    };
    out.ours.left.push_back(found(left));
    out.ours.right.push_back(found(right));
    out.peers.left.push_back(peer_corners(left.view(), kPattern));
    out.peers.right.push_back(peer_corners(right.view(), kPattern));
  }
  return true;
}

pipeline::bundle::Problem as_problem(const pipeline::StereoCalibration& c) {
  pipeline::bundle::Problem p;
  p.camera = {c.left, c.right};
  for (int i = 0; i < 9; ++i) p.right_from_left.rotation(i / 3, i % 3) = c.right_from_left.rotation.m[i];
  const pipeline::Vec3d& t = c.right_from_left.translation_mm;
  p.right_from_left.translation_mm = {t.x, t.y, t.z};
  return p;
}

double worst_depth_mm(const hal::sim::SimRig& truth, const pipeline::StereoCalibration& estimate) {
  const auto rig = as_problem(estimate);
  double worst = 0;
  for (const double z : {450.0, 560.0, 680.0})
    for (const double x : {-80.0, 0.0, 80.0})
      for (const double y : {-80.0, 0.0, 80.0}) {
        const hal::sim::Pixel l = truth.left.project({x, y, z});
        const hal::sim::Pixel r = truth.right.project({x, y, z});
        worst = std::max(worst, std::abs(pipeline::point_of(rig, {l.x, l.y}, {r.x, r.y}).z() - z));
      }
  return worst;
}

// Places of the views of one trial: the first `good`, and the bumped ones among them.
std::vector<std::size_t> places(int good, bool bumped) {
  std::vector<std::size_t> chosen;
  for (int v = 0; v < good; ++v) {
    if (bumped && (v == good / 3 || v == 2 * good / 3))
      chosen.push_back(static_cast<std::size_t>(v == good / 3 ? kGood : kGood + 1));
    chosen.push_back(static_cast<std::size_t>(v));
  }
  return chosen;
}

struct Tally {
  double ours_mm = 0, peer_mm = 0;
  int trials = 0, ours_failed = 0, peer_failed = 0;
  long corners = 0, rejected = 0;
};

void judge(const Rendered& set, int good, bool bumped, Tally& tally) {
  const hal::sim::SimulationOptions o = options_of(1);
  pipeline::CalibratorInput input{kPattern, o.rig.width_px, o.rig.height_px, {}};
  PeerViews peers{kPattern, o.rig.width_px, o.rig.height_px, {}, {}};
  for (const std::size_t v : places(good, bumped)) {
    input.views.push_back({std::to_string(v), set.ours.left[v], set.ours.right[v]});
    peers.left.push_back(set.peers.left[v]);
    peers.right.push_back(set.peers.right[v]);
  }
  ++tally.trials;
  const auto ours = pipeline::calibrate(input);
  if (!ours) ++tally.ours_failed;
  else tally.ours_mm += worst_depth_mm(set.rig, ours->calibration);
  double best = -1;
  for (const bool refine : {true, false})
    if (const auto peer = peer_calibration(peers, refine)) {
      const double worst = worst_depth_mm(set.rig, *peer);
      best = best < 0 ? worst : std::min(best, worst);
    }
  if (best < 0) ++tally.peer_failed;
  else tally.peer_mm += best;
  if (!ours) return;
  for (std::size_t k = 0; k < input.views.size(); ++k) {
    if (std::stoul(input.views[k].name) >= kGood) continue;
    tally.corners += 2L * kPattern.corners();
    const pipeline::ViewQuality& view = ours->quality.views[k];
    tally.rejected += view.used ? view.corners_dropped : 2L * kPattern.corners();
  }
}

}  // namespace
}  // namespace relievo::bench

int main(int argc, char** argv) {
  using namespace relievo::bench;  // NOLINT(google-build-using-namespace)
  const int rigs = argc > 1 ? std::atoi(argv[1]) : 20;
  relievo::ThreadPool pool(2);
  constexpr int kViews[] = {14, 8, 6};
  Tally tally[3][2];
  for (int seed = 1; seed <= rigs; ++seed) {
    Rendered set;
    if (!photograph(static_cast<std::uint32_t>(seed), pool, set)) {
      std::printf("rig %d cannot see the board\n", seed);
      continue;
    }
    for (int i = 0; i < 3; ++i)
      for (const bool bumped : {false, true}) judge(set, kViews[i], bumped, tally[i][bumped ? 1 : 0]);
    std::fprintf(stderr, "rig %d of %d\n", seed, rigs);
  }
  bool held = true;
  std::printf("%-26s %14s %22s %8s %18s\n", "views", "ours, mm", "peer (better of two)", "ratio",
              "corners rejected");
  for (int i = 0; i < 3; ++i)
    for (const int bumped : {0, 1}) {
      const Tally& t = tally[i][bumped];
      const double ours = t.ours_mm / std::max(1, t.trials - t.ours_failed);
      const double peer = t.peer_mm / std::max(1, t.trials - t.peer_failed);
      const double rejected = static_cast<double>(t.rejected) / static_cast<double>(std::max(1L, t.corners));
      std::printf("%2d%-24s %11.4f %22.4f %8.2f %15.1f %%   failed: ours %d, peer %d of %d\n", kViews[i],
                  bumped != 0 ? " and two bumped" : "", ours, peer, ours / peer, 100 * rejected,
                  t.ours_failed, t.peer_failed, t.trials);
      held = held && t.ours_failed == 0 && ours <= peer * (bumped != 0 ? 0.5 : 1.0) && rejected <= 0.1;
    }
  return held ? 0 : 1;
}
