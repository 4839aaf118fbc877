// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How often the true error of a calibration lies inside the band it promises: many rigs, many sets of
// noisy corners, each calibrated by the product and measured with the truth.
#pragma once

#include <cmath>
#include <string>

#include <Eigen/Cholesky>

#include "pipeline/calibrate/quality/rig_geometry.h"
#include "tests/pipeline/calibrate/simulated_boards.h"

namespace relievo::tests {

struct Band {
  std::string name;
  int cases = 0;
  int within_one = 0;  // one predicted standard deviation
  int within_95 = 0;   // 1.96 of them
  void count(double error, double sigma) {
    ++cases;
    within_one += std::abs(error) <= sigma ? 1 : 0;
    within_95 += std::abs(error) <= 1.96 * sigma ? 1 : 0;
  }
  double share_one() const { return static_cast<double>(within_one) / cases; }
  double share_95() const { return static_cast<double>(within_95) / cases; }
};

class PredictedError {
 public:
  // One more rig. False where the calibration was refused as impossible (never, on good boards).
  bool add(unsigned seed, double noise_px, int views) {
    const SimulatedRig rig = random_rig(seed);
    BoardSimulator boards(rig, noise_px, seed);
    boards.add(views);
    const auto done = pipeline::calibrate(boards.input());
    if (!done) return false;
    left_out += views - done->quality.used;
    given += views;
    measure(rig, estimated(done->calibration), done->quality);
    return true;
  }

  Band near{"depth at 400 mm"};
  Band face{"depth at 550 mm"};
  Band far{"depth at 750 mm"};
  Band scale{"scale"};
  Band projection{"projection, left and right"};
  int left_out = 0;
  int given = 0;

 private:
  static pipeline::bundle::Problem estimated(const pipeline::StereoCalibration& c) {
    pipeline::bundle::Problem rig;
    rig.camera = {c.left, c.right};
    for (int i = 0; i < 9; ++i) rig.right_from_left.rotation(i / 3, i % 3) = c.right_from_left.rotation.m[i];
    const pipeline::Vec3d& t = c.right_from_left.translation_mm;
    rig.right_from_left.translation_mm = {t.x, t.y, t.z};
    return rig;
  }

  static Eigen::Vector3d measured(const SimulatedRig& truth, const pipeline::bundle::Problem& rig,
                                  const Point& p) {
    Point q = turned(truth.turn, p);
    for (std::size_t c = 0; c < 3; ++c) q[c] += truth.shift_mm[c];
    return pipeline::point_of(rig, seen_by(truth, 0, p), seen_by(truth, 1, q));
  }

  void measure(const SimulatedRig& truth, const pipeline::bundle::Problem& rig,
               const pipeline::CalibrationQuality& q) {
    for (const auto& depth : q.uncertainty.depth) {
      Band* band = depth.distance_mm == 400   ? &near
                   : depth.distance_mm == 550 ? &face
                   : depth.distance_mm == 750 ? &far
                                              : nullptr;
      for (int i = 0; band != nullptr && i < 9; ++i)
        band->count(measured(truth, rig, {(i % 3 - 1) * 80.0, (i / 3 - 1) * 80.0, depth.distance_mm}).z() -
                        depth.distance_mm,
                    depth.sigma_mm);
    }
    pipeline::Cloud found(3, 27);
    pipeline::Cloud known(3, 27);
    for (int i = 0; i < 27; ++i) {
      const Point p = {(i % 3 - 1) * 80.0, (i / 3 % 3 - 1) * 80.0,
                       q.working_distance_mm + (i / 9 - 1) * 80.0};
      found.col(i) = measured(truth, rig, p);
      known.col(i) << p[0], p[1], p[2];
    }
    scale.count(100 * (pipeline::scale_between(known, found) - 1), q.uncertainty.scale_percent);
    for (int eye = 0; eye < 2; ++eye)
      judge_projection(truth, rig, eye, q.uncertainty.projection[static_cast<std::size_t>(eye)]);
  }

  // The true picture of the rays that the estimate gives the map's pixels, a small turn set aside by
  // least squares over the whole map, as the map itself does.
  void judge_projection(const SimulatedRig& truth, const pipeline::bundle::Problem& rig, int eye,
                        const pipeline::ProjectionMap& map) {
    const pipeline::CameraIntrinsics& camera = rig.camera[static_cast<std::size_t>(eye)];
    const auto cells = static_cast<Eigen::Index>(map.sigma_px.size());
    Eigen::VectorXd off(2 * cells);
    Eigen::MatrixX3d by_turn(2 * cells, 3);
    constexpr double kTurn = 1e-5;
    for (Eigen::Index i = 0; i < cells; ++i) {
      const auto column = static_cast<double>(i % map.columns);
      const auto row = static_cast<double>(i / map.columns);
      const pipeline::Vec2d pixel{(column + 0.5) * camera.width_px / map.columns - 0.5,
                                  (row + 0.5) * camera.height_px / map.rows - 0.5};
      const Eigen::Vector3d ray = pipeline::ray_of(camera, pixel);
      const pipeline::Vec2d at = seen_by(truth, eye, {ray.x(), ray.y(), ray.z()});
      off.segment<2>(2 * i) << at.x - pixel.x, at.y - pixel.y;
      for (int axis = 0; axis < 3; ++axis) {
        Point w{};
        w[static_cast<std::size_t>(axis)] = kTurn;
        const pipeline::Vec2d turned_at = seen_by(truth, eye, turned(w, {ray.x(), ray.y(), ray.z()}));
        by_turn.col(axis).segment<2>(2 * i) << (turned_at.x - at.x) / kTurn, (turned_at.y - at.y) / kTurn;
      }
    }
    const Eigen::Matrix3d normal = by_turn.transpose() * by_turn;
    off -= by_turn * normal.ldlt().solve(by_turn.transpose() * off);
    for (Eigen::Index i = 0; i < 2 * cells; ++i)
      projection.count(off[i], map.sigma_px[static_cast<std::size_t>(i / 2)]);
  }
};

}  // namespace relievo::tests
