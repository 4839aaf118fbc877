// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How many simulated boards each finder finds, how far its corners are from the truth, and how long it
// takes, condition by condition.
//   bench_boards [BOARDS_A_CONDITION] [classic] [ours] [WORDS OF ONE CONDITION]
// Default: 12 boards; `ours` leaves the peers out, `classic` takes OpenCV's oldest finder in, which may
// search for minutes. Times are of the processor, all threads together.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

#include "hal/sim/base/noise.h"
#include "hal/sim/board_scene.h"
#include "hal/sim/optics/exposure.h"
#include "pipeline/calibrate/board/board_finder.h"
#include "tests/bench/calibration/board_peers.h"

namespace relievo::bench {
namespace {

namespace sim = hal::sim;
using pipeline::BoardCorners;
using Finder = std::function<BoardCorners(const ImageView&, const pipeline::BoardPattern&)>;

struct Range {
  double from, to;
};

// What is drawn afresh for each board of a condition.
struct Condition {
  const char* name;
  Range tilt_deg{0, 45};
  Range distance_mm{350, 900};
  Range blur_px{0.4, 0.8};
  Range noise{1, 1};
  sim::BoardLook look{};
  int corners_x = 10, corners_y = 7;
  Range size{0.45, 0.95};  // of the largest that the picture holds
};

struct Photograph {
  sim::BoardPattern pattern;
  hal::Picture picture;
  BoardCorners truth;  // not-a-number outside the picture
};

sim::BodyPose pose_of(const sim::BoardPattern& b, const sim::SimView& view, const Condition& c,
                      sim::Random& random) {
  const double tilt = sim::radians(random.uniform(c.tilt_deg.from, c.tilt_deg.to)),
               compass = random.uniform(0, 6.2832);
  sim::BodyPose pose;
  pose.world_from_body =
      sim::rotation(tilt * std::sin(compass), tilt * std::cos(compass), random.uniform(-0.5, 0.5));
  const sim::Vec3 middle{(b.corners_x - 1) * b.square_mm / 2, (b.corners_y - 1) * b.square_mm / 2, 0};
  const sim::Vec3 aim =
      view.ray(view.width_px * random.uniform(0.35, 0.65), view.height_px * random.uniform(0.4, 0.6));
  pose.origin_mm = view.centre() + aim * random.uniform(c.distance_mm.from, c.distance_mm.to) -
                   pose.world_from_body * middle;
  return pose;
}

bool whole(const sim::BoardPattern& b, const sim::SimView& view, const sim::BodyPose& pose) {
  for (const double x : {-1.2, b.corners_x + 0.2})
    for (const double y : {-1.2, b.corners_y + 0.2}) {
      const sim::Vec3 p = pose.to_world({x * b.square_mm, y * b.square_mm, 0});
      const sim::Pixel q = view.project(p);
      if (view.depth_mm(p) < 50 || q.x < 0 || q.y < 0 || q.x > view.width_px - 1 || q.y > view.height_px - 1)
        return false;
    }
  return true;
}

Photograph photograph(const Condition& c, sim::BoardKind kind, bool cut_off, std::uint32_t seed,
                      ThreadPool& pool) {
  sim::Random random(seed);
  sim::RigOptions rig_options;
  rig_options.seed = seed;
  const sim::SimView view = sim::make_rig(rig_options).left;
  Photograph out;
  out.pattern.kind = kind;
  out.pattern.corners_x = c.corners_x;
  out.pattern.corners_y = c.corners_y;
  sim::BodyPose pose = pose_of(out.pattern, view, c, random);
  // The largest board that is seen whole in this pose, then a share of it.
  double low = 1, high = 120;
  const sim::Vec3 middle = pose.to_world({(c.corners_x - 1) * 10.0, (c.corners_y - 1) * 10.0, 0});
  const auto sized = [&](double square_mm) {
    out.pattern.square_mm = square_mm;
    const sim::Vec3 half{(c.corners_x - 1) * square_mm / 2, (c.corners_y - 1) * square_mm / 2, 0};
    pose.origin_mm = middle - pose.world_from_body * half;
    return whole(out.pattern, view, pose);
  };
  for (int i = 0; i < 30; ++i) (sized((low + high) / 2) ? low : high) = (low + high) / 2;
  sized(low * (cut_off ? random.uniform(1.3, 1.8) : random.uniform(c.size.from, c.size.to)));
  out.pattern.margin_mm = 0.8 * out.pattern.square_mm;
  sim::SensorOptions sensor;
  sensor.grey = true;
  sensor.noise = random.uniform(c.noise.from, c.noise.to);
  sensor.defocus_px = random.uniform(c.blur_px.from, c.blur_px.to);
  const sim::BoardScene scene(out.pattern, pose, c.look, 1 / view.fx_px);
  out.picture = sim::read_sensor(sim::expose(scene, view, sensor, pool), sensor, seed);
  for (int row = 0; row < c.corners_y; ++row)
    for (int column = 0; column < c.corners_x; ++column) {
      const sim::Pixel at =
          view.project(pose.to_world({column * out.pattern.square_mm, row * out.pattern.square_mm, 0}));
      const bool inside = at.x > 0 && at.y > 0 && at.x < view.width_px - 1 && at.y < view.height_px - 1;
      out.truth.push_back(inside ? pipeline::Vec2d{at.x, at.y} : pipeline::Vec2d{std::nan(""), std::nan("")});
    }
  return out;
}

struct Score {
  int boards = 0, found = 0;
  long corners_seen = 0;
  std::vector<pipeline::Vec2d> off;  // of every corner found, px
  double ms = 0;

  void add(const BoardCorners& corners, const BoardCorners& truth, bool any_turn) {
    ++boards;
    for (const auto& at : truth) corners_seen += pipeline::seen(at) ? 1 : 0;
    if (corners.size() != truth.size()) return;
    ++found;
    std::vector<pipeline::Vec2d> best = off_from(corners, truth);
    // A chessboard's first corner may be open; the nearest order is meant.
    if (BoardCorners turned(corners.rbegin(), corners.rend());
        any_turn && sum(off_from(turned, truth)) < sum(best))
      best = off_from(turned, truth);
    off.insert(off.end(), best.begin(), best.end());
  }
  void print(const char* finder) const {
    const double count = std::max(1.0, static_cast<double>(off.size()));
    double worst = 0;
    pipeline::Vec2d mean;
    for (const auto& d : off) {
      worst = std::max(worst, std::hypot(d.x, d.y));
      mean = {mean.x + d.x / count, mean.y + d.y / count};
    }
    const double squares = sum(off) / count;
    std::printf(
        "  %-20s found %3d of %3d, corners %5zu of %5ld, rms %.4f px, without its mean %.4f, worst %.3f, %6.1f ms\n",
        finder, found, boards, off.size(), corners_seen, std::sqrt(squares),
        std::sqrt(std::max(0.0, squares - mean.x * mean.x - mean.y * mean.y)), worst,
        ms / std::max(boards, 1));
  }

 private:
  static std::vector<pipeline::Vec2d> off_from(const BoardCorners& corners, const BoardCorners& truth) {
    std::vector<pipeline::Vec2d> gap;
    for (std::size_t i = 0; i < truth.size(); ++i)
      if (pipeline::seen(corners[i]))
        gap.push_back(pipeline::seen(truth[i])
                          ? pipeline::Vec2d{corners[i].x - truth[i].x, corners[i].y - truth[i].y}
                          : pipeline::Vec2d{99, 99});
    return gap;
  }
  static double sum(const std::vector<pipeline::Vec2d>& all) {
    double squares = 0;
    for (const auto& d : all) squares += d.x * d.x + d.y * d.y;
    return squares;
  }
};

struct Contender {
  const char* name;
  Finder find;
  Score score;
};

struct RunOptions {
  int boards = 12;
  bool peers = true, classic = false;
  std::string only;
};

void run(const Condition& condition, sim::BoardKind kind, bool cut_off, const RunOptions& options,
         ThreadPool& pool) {
  std::vector<Contender> contenders;
  contenders.push_back({"ours",
                        [](const ImageView& picture, const pipeline::BoardPattern& pattern) {
                          auto found = pipeline::find_board(picture, pattern);
                          return found ? *found : BoardCorners{};
                        },
                        {}});
  const bool chessboard = kind == sim::BoardKind::Chessboard;
  if (options.peers && chessboard) contenders.push_back({"OpenCV sector-based", sector_based_board, {}});
  if (options.classic && chessboard) contenders.push_back({"OpenCV classic", classic_board, {}});
  if (options.peers && !chessboard) contenders.push_back({"OpenCV aruco", aruco_board, {}});
  for (int i = 0; i < options.boards; ++i) {
    const Photograph shot = photograph(condition, kind, cut_off, static_cast<std::uint32_t>(i + 1), pool);
    pipeline::BoardPattern pattern{shot.pattern.corners_x, shot.pattern.corners_y, shot.pattern.square_mm};
    if (kind == sim::BoardKind::Charuco) pattern.kind = pipeline::BoardKind::Charuco;
    for (Contender& one : contenders) {
      const std::clock_t start = std::clock();
      const BoardCorners corners = one.find(shot.picture.view(), pattern);
      one.score.ms += 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
      one.score.add(corners, shot.truth, chessboard);
    }
  }
  std::printf("%s: %s%s\n", chessboard ? "chessboard" : "ChArUco", condition.name,
              cut_off ? ", partly outside" : "");
  for (Contender& one : contenders) one.score.print(one.name);
  std::fflush(stdout);
}

std::vector<Condition> conditions() {
  std::vector<Condition> all{{"10x7, good light"}};
  const auto with = [&](const char* name, auto change) {
    Condition c = all.front();
    c.name = name;
    change(c);
    all.push_back(c);
  };
  with("no blur at all", [](Condition& c) { c.blur_px = {0, 0}; });
  with("blur 1.5 px", [](Condition& c) { c.blur_px = {1.5, 1.5}; });
  with("blur 2 px", [](Condition& c) { c.blur_px = {2, 2}; });
  with("noise x 4", [](Condition& c) { c.noise = {4, 4}; });
  with("blur 1.5 px, noise x 4", [](Condition& c) { c.blur_px = {1.5, 1.5}, c.noise = {4, 4}; });
  with("lamp on one side, 80 % lost", [](Condition& c) { c.look.lamp = 0.8; });
  with("lamp, noise x 4, blur 1.5", [](Condition& c) {
    c.look.lamp = 0.8, c.noise = {4, 4}, c.blur_px = {1.5, 1.5};
  });
  with("a third in a shadow, 80 % lost", [](Condition& c) { c.look.shadow = 0.8; });
  with("a highlight", [](Condition& c) { c.look.highlight = 8; });
  with("tilted 50 to 55 degrees", [](Condition& c) { c.tilt_deg = {50, 55}; });
  with("5x4", [](Condition& c) { c.corners_x = 5, c.corners_y = 4; });
  with("20x15", [](Condition& c) { c.corners_x = 20, c.corners_y = 15; });
  with("20x15, small, blur 1.5 px, noise x 2", [](Condition& c) {
    c.corners_x = 20, c.corners_y = 15, c.size = {0.35, 0.5}, c.blur_px = {1.5, 1.5}, c.noise = {2, 2};
  });
  with("8x8", [](Condition& c) { c.corners_x = 8, c.corners_y = 8; });
  with("far: a fifth to a third of the picture", [](Condition& c) { c.size = {0.2, 0.33}; });
  return all;
}

}  // namespace
}  // namespace relievo::bench

int main(int argc, char** argv) {
  namespace bench = relievo::bench;
  using relievo::hal::sim::BoardKind;
  bench::RunOptions options;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (const int number = std::atoi(argv[i]); number > 0 && word.find('x') == std::string::npos)
      options.boards = number;
    else if (word == "ours") options.peers = false;
    else if (word == "classic") options.classic = true;
    else options.only = word;
  }
  relievo::ThreadPool pool(2);
  const auto wanted = [&options](const char* kind, const char* name) {
    return (std::string(kind) + " " + name).find(options.only) != std::string::npos;
  };
  for (const auto& condition : bench::conditions()) {
    if (wanted("chessboard", condition.name))
      bench::run(condition, BoardKind::Chessboard, false, options, pool);
  }
  for (const auto& condition : bench::conditions()) {
    if (!wanted("charuco", condition.name)) continue;
    bench::run(condition, BoardKind::Charuco, false, options, pool);
    bench::run(condition, BoardKind::Charuco, true, options, pool);
  }
  return 0;
}
