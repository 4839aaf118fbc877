// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/epipolar/row_aligner.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory_resource>
#include <vector>

#include <Eigen/Dense>

#include "hal/base/statistics.h"
#include "pipeline/base/solving.h"
#include "pipeline/match/bending/bending_system.h"

namespace relievo::pipeline {
namespace {

constexpr std::size_t kLeastLocals = 12;
constexpr int kLeastBlocks = 8;
constexpr int kReweightings = 8;
constexpr double kTukey = 4.685;  // 95 % efficient where errors are normal
constexpr double kMedianOfAbsolute = 0.6745;
constexpr double kLeastScalePx = 1e-6;  // perfect measurements divide nothing by zero

using Numbers = std::pmr::vector<double>;

// The face's points: middle, spread and correlation, by weight.
void describe_face(std::span<const LocalShift> locals, const Numbers& weight, EpipolarShift& face) {
  double sum = 0, x = 0, y = 0, xx = 0, yy = 0, xy = 0;
  for (std::size_t k = 0; k < locals.size(); ++k) {
    sum += weight[k];
    x += weight[k] * locals[k].x_px;
    y += weight[k] * locals[k].y_px;
  }
  face.middle_x_px = x / sum;
  face.middle_y_px = y / sum;
  for (std::size_t k = 0; k < locals.size(); ++k) {
    const double dx = locals[k].x_px - face.middle_x_px, dy = locals[k].y_px - face.middle_y_px;
    xx += weight[k] * dx * dx;
    yy += weight[k] * dy * dy;
    xy += weight[k] * dx * dy;
  }
  face.spread_x_px = std::max(1.0, std::sqrt(xx / sum));
  face.spread_y_px = std::max(1.0, std::sqrt(yy / sum));
  face.correlation = std::clamp(xy / sum / (face.spread_x_px * face.spread_y_px), -0.99, 0.99);
}

Eigen::Vector3d basis(const EpipolarShift& face, const LocalShift& at, bool slopes) {
  if (!slopes) return {1, 0, 0};
  return {1, (at.x_px - face.middle_x_px) / face.spread_x_px,
          (at.y_px - face.middle_y_px) / face.spread_y_px};
}

Eigen::Matrix3d moments(const EpipolarShift& face) {
  Eigen::Matrix3d m = Eigen::Matrix3d::Identity();
  m(1, 2) = m(2, 1) = face.correlation;
  return m;
}

struct Fit {
  Eigen::Vector3d field;
  Eigen::Matrix3d slope;  // of the equations that it solves: what an error of a measurement moves it by
};

Fit reweighted(std::span<const LocalShift> locals, bool slopes, const EpipolarShift& face,
               const Numbers& prior, Numbers& weight, Numbers& room) {
  // The median starts it: least squares could be pulled out of the reach of the biweight.
  for (std::size_t k = 0; k < locals.size(); ++k) room[k] = locals[k].shift_px;
  Fit fit{{median(room), 0, 0}, {}};
  const Eigen::Matrix3d unused =
      slopes ? Eigen::Matrix3d::Zero() : Eigen::Matrix3d(Eigen::Vector3d(0, 1, 1).asDiagonal());
  for (int round = 0; round < kReweightings; ++round) {
    const auto off = [&](std::size_t k) {
      return (locals[k].shift_px - fit.field.dot(basis(face, locals[k], slopes))) * std::sqrt(prior[k]);
    };
    for (std::size_t k = 0; k < locals.size(); ++k) room[k] = std::abs(off(k));
    const double limit = kTukey * std::max(median(room) / kMedianOfAbsolute, kLeastScalePx);
    Eigen::Matrix3d information = fit.slope = unused;
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < locals.size(); ++k) {
      const double u = off(k) / limit;
      const double inside = std::max(0.0, 1 - u * u);
      weight[k] = prior[k] * inside * inside;
      const Eigen::Vector3d b = basis(face, locals[k], slopes);
      information += weight[k] * b * b.transpose();
      fit.slope += prior[k] * inside * (1 - 5 * u * u) * b * b.transpose();
      right += weight[k] * locals[k].shift_px * b;
    }
    fit.field = solved<3>(information, right);
  }
  return fit;
}

// False where too few blocks speak.
bool sandwich(std::span<const LocalShift> locals, bool slopes, const EpipolarShift& face, const Fit& fit,
              const Numbers& weight, Eigen::Matrix3d& covariance) {
  std::array<Eigen::Vector3d, kShiftBlocks> scores;
  scores.fill(Eigen::Vector3d::Zero());
  std::array<bool, kShiftBlocks> spoke{};
  for (std::size_t k = 0; k < locals.size(); ++k) {
    const Eigen::Vector3d b = basis(face, locals[k], slopes);
    const auto block = std::size_t(locals[k].block);
    scores[block] += weight[k] * (locals[k].shift_px - fit.field.dot(b)) * b;
    spoke[block] = spoke[block] || weight[k] > 0;
  }
  const auto blocks = std::ranges::count(spoke, true);
  if (blocks < kLeastBlocks) return false;
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& score : scores) scatter += score * score.transpose();
  const Eigen::Matrix3d inverse = fit.slope.inverse();
  covariance = double(blocks) / double(blocks - 3) * inverse * scatter * inverse;
  return covariance.allFinite() && fit.field.allFinite();
}

constexpr int kNeighbours = 2;  // nodes: patches up to here are a patch's surroundings
constexpr std::size_t kLeastAround = 8;
constexpr std::size_t kLeastMotionLocals = 40;
constexpr int kMotionReweightings = 4;
constexpr int kSolverSteps = 200;
constexpr double kMedianVariance = 1.57;  // of a median over that of a mean
// Patches that err together (an edge of the lips, a highlight) look like motion of a few tenths of their
// scatter: less than this share of it is not believed.
constexpr double kLeastShare = 0.5;
constexpr double kReach = 1.0 / 6;  // of the face's width

struct Node {
  int x, y;
};

Node node_of(const LocalShift& local) {
  return {int(std::lround(local.x_px / kMotionStepPx)), int(std::lround(local.y_px / kMotionStepPx))};
}

// The locals beyond the linear shift, which of them stand at which node, and how sure they are.
struct Beyond {
  Beyond(std::span<const LocalShift> all, const EpipolarShift& linear, const RowMotion& motion,
         Arena& scratch)
      : locals(all), memory(&scratch), at(memory, motion.shift_px.width, motion.shift_px.height, -1) {
    Numbers room(&scratch);
    for (const LocalShift& local : all) room.push_back(local.information);
    const double usual = median(room);
    for (std::size_t k = 0; k < all.size(); ++k) {
      shift.push_back(all[k].shift_px - linear.at(all[k].x_px, all[k].y_px));
      prior.push_back(all[k].information / (all[k].information + usual));
      const Node node = node_of(all[k]);
      if (node.x < 1 || node.y < 1 || node.x >= at.width - 1 || node.y >= at.height - 1) continue;
      next[k] = at.row(node.y)[node.x];
      at.row(node.y)[node.x] = int(k);
    }
    around.reserve(64);
  }

  template <typename Visit>
  void neighbours(const Node& node, Visit&& visit) const {
    for (int y = std::max(0, node.y - kNeighbours); y <= std::min(at.height - 1, node.y + kNeighbours); ++y)
      for (int x = std::max(0, node.x - kNeighbours); x <= std::min(at.width - 1, node.x + kNeighbours); ++x)
        for (int k = at.row(y)[x]; k >= 0; k = next[std::size_t(k)]) visit(std::size_t(k));
  }

  std::span<const LocalShift> locals;
  std::pmr::memory_resource* memory;
  Numbers shift{memory}, prior{memory}, around{memory};
  Plane<int> at;                                          // the first local at a node, -1: none
  std::pmr::vector<int> next{locals.size(), -1, memory};  // the next local at the same node
};

struct Surroundings {
  Numbers middle;     // the median of the shifts around a local; its own where there are too few
  double amplitude2;  // variance of the medians, beyond what their own uncertainty explains
  double scatter;     // of a local with prior 1 about its surroundings
};

Surroundings look_around(Beyond& beyond, Arena& scratch) {
  const std::size_t n = beyond.locals.size();
  Surroundings s{Numbers(n, &scratch), 0, 0};
  Numbers off(&scratch);
  off.reserve(n);
  Numbers shares(n, 0.0, &scratch);
  for (std::size_t k = 0; k < n; ++k) {
    beyond.around.clear();
    double told = 0;
    beyond.neighbours(node_of(beyond.locals[k]), [&](std::size_t other) {
      beyond.around.push_back(beyond.shift[other]);
      told += beyond.prior[other];
    });
    s.middle[k] = 0;
    if (beyond.around.size() < kLeastAround) continue;
    s.middle[k] = median(beyond.around);
    shares[k] = kMedianVariance / told;
    off.push_back(std::abs(beyond.shift[k] - s.middle[k]) * std::sqrt(beyond.prior[k]));
  }
  if (off.size() < kLeastMotionLocals) return s;
  s.scatter = std::max(median(off) / kMedianOfAbsolute, 1e-3);
  double seen = 0;
  double explained = 0;
  for (std::size_t k = 0; k < n; ++k) {
    if (shares[k] == 0) continue;
    seen += s.middle[k] * s.middle[k];
    explained += shares[k] * s.scatter * s.scatter;
  }
  s.amplitude2 = std::max(0.0, (seen - explained) / double(off.size()));
  return s;
}

}  // namespace

EpipolarShift fit_shift_field(std::span<const LocalShift> locals, bool slopes, Arena& scratch) {
  if (locals.size() < kLeastLocals) return {};
  Arena::Mark mark(scratch);
  Numbers prior(locals.size(), &scratch), weight(locals.size(), &scratch), room(locals.size(), &scratch);
  for (std::size_t k = 0; k < locals.size(); ++k) room[k] = locals[k].information;
  const double usual = median(room);
  for (std::size_t k = 0; k < locals.size(); ++k)
    weight[k] = prior[k] = locals[k].information / (locals[k].information + usual);
  EpipolarShift shift;
  describe_face(locals, prior, shift);
  const Fit fit = reweighted(locals, slopes, shift, prior, weight, room);
  Eigen::Matrix3d c;
  if (!sandwich(locals, slopes, shift, fit, weight, c)) return {};
  shift.offset_px = fit.field(0);
  shift.slope_x = fit.field(1) / shift.spread_x_px;
  shift.slope_y = fit.field(2) / shift.spread_y_px;
  shift.covariance_px2 = {c(0, 0), c(0, 1), c(0, 2), c(1, 1), c(1, 2), c(2, 2)};
  shift.residual_px = std::sqrt(fit.field.dot(moments(shift) * fit.field));
  shift.sigma_px = std::sqrt(std::max((c * moments(shift)).trace(), kLeastScalePx * kLeastScalePx));
  return shift;
}

EpipolarShift sum_of(const EpipolarShift& first, const EpipolarShift& second) {
  EpipolarShift sum = second;
  sum.offset_px += first.at(second.middle_x_px, second.middle_y_px);
  sum.slope_x += first.slope_x;
  sum.slope_y += first.slope_y;
  const Eigen::Vector3d field(sum.offset_px, sum.slope_x * sum.spread_x_px, sum.slope_y * sum.spread_y_px);
  sum.residual_px = std::sqrt(field.dot(moments(sum) * field));
  return sum;
}

RowMotion::RowMotion(std::pmr::memory_resource* memory, int width_px, int height_px)
    : shift_px(memory, width_px / kMotionStepPx + 3, height_px / kMotionStepPx + 3) {}

double RowMotion::at(double x_px, double y_px) const {
  if (!seen) return 0;
  const double x = std::clamp(x_px / kMotionStepPx, 0.0, shift_px.width - 1.001);
  const double y = std::clamp(y_px / kMotionStepPx, 0.0, shift_px.height - 1.001);
  const int i = int(x);
  const int j = int(y);
  const double tx = x - i;
  const double ty = y - j;
  const auto value = [&](int dx, int dy) { return double(shift_px.row(j + dy)[i + dx]); };
  const double top = value(0, 0) + tx * (value(1, 0) - value(0, 0));
  return top + ty * (value(0, 1) + tx * (value(1, 1) - value(0, 1)) - top);
}

void fit_row_motion(std::span<const LocalShift> locals, const EpipolarShift& linear, double face_width_px,
                    StageContext& context, RowMotion& motion) {
  if (locals.size() < kLeastMotionLocals) return;
  Arena::Mark mark(context.scratch);
  Beyond beyond(locals, linear, motion, context.scratch);
  const Surroundings around = look_around(beyond, context.scratch);
  if (!(around.amplitude2 > kLeastShare * kLeastShare * around.scatter * around.scatter)) return;
  // The variance of a field with the energy ridge v^2 + bend |second differences|^2 a node is
  // 1 / (8 sqrt(ridge bend)), its reach (bend / ridge)^(1/4).
  Plane<float>& field = motion.shift_px;
  const double reach =
      kReach * (face_width_px > 0 ? face_width_px : field.width * kMotionStepPx / 2.0) / kMotionStepPx;
  const double ridge = 1 / (8 * reach * reach * around.amplitude2);
  const auto bend = float(ridge * reach * reach * reach * reach);
  BendingSystem system(&context.scratch, field.width, field.height);
  for (int y = 1; y < field.height - 1; ++y)
    for (int x = 1; x < field.width - 1; ++x) {
      system.bend_xx.row(y)[x] = x > 1 && x < field.width - 2 ? bend : 0;
      system.bend_yy.row(y)[x] = y > 1 && y < field.height - 2 ? bend : 0;
      system.bend_xy.row(y)[x] = x < field.width - 2 && y < field.height - 2 ? 2 * bend : 0;
    }
  for (int round = 0; round < kMotionReweightings; ++round) {
    for (float& a : system.data.values) a = float(ridge);
    std::ranges::fill(system.rhs.values, 0.0F);
    for (std::size_t k = 0; k < locals.size(); ++k) {
      const Node node = node_of(locals[k]);
      if (node.x < 1 || node.y < 1 || node.x >= field.width - 1 || node.y >= field.height - 1) continue;
      const double here = round == 0 ? around.middle[k] : double(field.row(node.y)[node.x]);
      const double u = (beyond.shift[k] - here) * std::sqrt(beyond.prior[k]) / (kTukey * around.scatter);
      const double inside = std::max(0.0, 1 - u * u);
      const double weight = beyond.prior[k] * inside * inside / (around.scatter * around.scatter);
      system.data.row(node.y)[node.x] += float(weight);
      system.rhs.row(node.y)[node.x] += float(weight * beyond.shift[k]);
    }
    solve(system, kSolverSteps, kToTheEnd, context.pool, context.scratch, field);
  }
  motion.seen = true;
  double sum = 0;
  for (const LocalShift& local : locals) {
    const double v = motion.at(local.x_px, local.y_px);
    sum += v * v;
  }
  motion.rms_px = std::sqrt(sum / double(locals.size()));
}

}  // namespace relievo::pipeline
