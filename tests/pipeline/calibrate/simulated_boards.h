// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Corners of a board as a known rig sees them. The projection is written out here on its own, so that
// it judges the calibrator's.
#pragma once

#include <array>
#include <cmath>
#include <random>
#include <string>

#include "pipeline/calibrate/calibrator.h"

namespace relievo::tests {

struct SimulatedRig {
  double focal[2] = {1600, 1585};
  double centre[2][2] = {{520, 500}, {505, 522}};
  double distortion[2][5] = {{-0.18, 0.12, 0.0006, -0.0004, 0}, {-0.17, 0.10, -0.0003, 0.0008, 0}};
  std::array<double, 3> turn = {0.004, 0.22, 0.006};  // right from left, rotation vector
  std::array<double, 3> shift_mm = {-112, 1.2, 25};
  int width_px = 1024;
  int height_px = 1024;
};

// Another rig for every seed: two cameras that look at a point some 400 to 700 mm away.
inline SimulatedRig random_rig(unsigned seed) {
  std::mt19937 random(seed * 7919U);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  SimulatedRig rig;
  for (int eye = 0; eye < 2; ++eye) {
    rig.focal[eye] = uniform(1300, 2400);
    for (double& c : rig.centre[eye]) c = 511.5 + uniform(-30, 30);
    double* k = rig.distortion[eye];
    k[0] = uniform(-0.3, 0.1);
    k[1] = uniform(-0.2, 0.3);
    k[2] = uniform(-0.002, 0.002);
    k[3] = uniform(-0.002, 0.002);
    k[4] = uniform(-0.2, 0.2);
  }
  const double baseline = uniform(70, 160);
  rig.turn = {uniform(-0.02, 0.02), baseline / 500 * uniform(0.7, 1.2), uniform(-0.02, 0.02)};
  rig.shift_mm = {-baseline * std::cos(rig.turn[1]), uniform(-3, 3), baseline * std::sin(rig.turn[1])};
  return rig;
}

using Point = std::array<double, 3>;

// Rodrigues' formula.
inline Point turned(const Point& w, const Point& p) {
  const double angle = std::sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
  if (angle == 0) return p;
  const Point k = {w[0] / angle, w[1] / angle, w[2] / angle};
  const double dot = k[0] * p[0] + k[1] * p[1] + k[2] * p[2];
  const Point cross = {k[1] * p[2] - k[2] * p[1], k[2] * p[0] - k[0] * p[2], k[0] * p[1] - k[1] * p[0]};
  Point out{};
  for (std::size_t i = 0; i < 3; ++i)
    out[i] = p[i] * std::cos(angle) + cross[i] * std::sin(angle) + k[i] * dot * (1 - std::cos(angle));
  return out;
}

inline pipeline::Vec2d seen_by(const SimulatedRig& rig, int eye, const Point& p) {
  const double x = p[0] / p[2];
  const double y = p[1] / p[2];
  const double* k = rig.distortion[eye];
  const double r2 = x * x + y * y;
  const double radial = 1 + k[0] * r2 + k[1] * r2 * r2 + k[4] * r2 * r2 * r2;
  return {rig.focal[eye] * (x * radial + 2 * k[2] * x * y + k[3] * (r2 + 2 * x * x)) + rig.centre[eye][0],
          rig.focal[eye] * (y * radial + k[2] * (r2 + 2 * y * y) + 2 * k[3] * x * y) + rig.centre[eye][1]};
}

// What is wrong in one view: how far the right camera is from where it belongs, and how far the board
// went on before the right picture was taken.
struct Slip {
  Point turn{};
  Point shift_mm{};
  Point carried_mm{};
};

class BoardSimulator {
 public:
  BoardSimulator(const SimulatedRig& rig, double noise_px, unsigned seed)
      : rig_(rig), noise_px_(noise_px), random_(seed) {
    input_.pattern = {9, 6, 10};
    input_.width_px = rig.width_px;
    input_.height_px = rig.height_px;
  }

  void add(const Slip& slip = {}) {
    pipeline::BoardView view;
    view.name = std::to_string(input_.views.size());
    // A photographer's patience: the whole board in both pictures, or as it comes.
    for (int tries = 0; tries < 200 && !photograph(slip, view); ++tries) {
    }
    input_.views.push_back(std::move(view));
  }
  void add(int count) {
    for (int i = 0; i < count; ++i) add();
  }
  // A slip of random direction that moves the picture by a few pixels.
  Slip random_slip(double turn_rad, double shift_mm) {
    return {{sign() * turn_rad, uniform(-turn_rad, turn_rad), uniform(-turn_rad, turn_rad)},
            {uniform(-shift_mm, shift_mm), sign() * shift_mm, uniform(-shift_mm, shift_mm)}};
  }
  double normal(double sigma) { return std::normal_distribution<double>(0, sigma)(random_); }

  double bend_mm = 0;  // height of the board's short edges over its middle
  double variety = 1;  // 0: every view alike

  pipeline::CalibratorInput& input() { return input_; }

 private:
  // Tilted up to 35 degrees, somewhere in the common field at 400 to 560 mm. False when a corner is out.
  bool photograph(const Slip& slip, pipeline::BoardView& view) {
    const Point turn = {variety * uniform(-0.6, 0.6), variety * uniform(-0.6, 0.6),
                        variety * uniform(-0.5, 0.5)};
    const Point middle = {variety * uniform(-60, 60), variety * uniform(-65, 65),
                          480 + variety * uniform(-80, 80)};
    view.left.clear();
    view.right.clear();
    bool whole = true;
    for (int i = 0; i < input_.pattern.corners(); ++i) {
      const double u = (i % 9 - 4) / 4.0;
      Point p = turned(turn, {(i % 9 - 4) * 10.0, (i / 9 - 2.5) * 10.0, bend_mm * u * u});
      for (std::size_t c = 0; c < 3; ++c) p[c] += middle[c];
      Point later = p;
      for (std::size_t c = 0; c < 3; ++c) later[c] += slip.carried_mm[c];
      Point q = turned(slip.turn, turned(rig_.turn, later));
      for (std::size_t c = 0; c < 3; ++c) q[c] += rig_.shift_mm[c] + slip.shift_mm[c];
      view.left.push_back(noisy(seen_by(rig_, 0, p)));
      view.right.push_back(noisy(seen_by(rig_, 1, q)));
      whole = whole && inside(view.left.back()) && inside(view.right.back());
    }
    return whole;
  }
  bool inside(const pipeline::Vec2d& at) const {
    return at.x > 5 && at.y > 5 && at.x < rig_.width_px - 5 && at.y < rig_.height_px - 5;
  }
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  double sign() { return uniform(-1, 1) < 0 ? -1 : 1; }
  pipeline::Vec2d noisy(pipeline::Vec2d at) {
    if (noise_px_ > 0) at = {at.x + normal(noise_px_), at.y + normal(noise_px_)};
    return at;
  }

  SimulatedRig rig_;
  double noise_px_;
  std::mt19937 random_;
  pipeline::CalibratorInput input_;
};

}  // namespace relievo::tests
