// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/epipolar/row_motion.h"

#include <algorithm>
#include <cmath>

#include "pipeline/match/bending/bending_system.h"

namespace relievo::pipeline {
namespace {

constexpr int kNeighbours = 2;  // nodes: patches up to here are a patch's surroundings
constexpr std::size_t kLeastAround = 8;
constexpr std::size_t kLeastLocals = 40;
constexpr int kReweightings = 4;
constexpr int kSolverSteps = 200;
constexpr double kTukey = 4.685;
constexpr double kMedianOfAbsolute = 0.6745;
constexpr double kMedianVariance = 1.57;  // of a median over that of a mean
// Patches that err together (an edge of the lips, a highlight) look like motion of a few tenths of their
// scatter: less than this share of it is not believed.
constexpr double kLeastShare = 0.5;
constexpr double kReach = 1.0 / 6;  // of the face's width

using Numbers = std::pmr::vector<double>;

double median(Numbers& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

struct Node {
  int x, y;
};

Node node_of(const LocalShift& local) {
  return {static_cast<int>(std::lround(local.x_px / kMotionStepPx)),
          static_cast<int>(std::lround(local.y_px / kMotionStepPx))};
}

// The locals beyond the linear shift, which of them stand at which node, and how sure they are.
struct Beyond {
  Beyond(std::span<const LocalShift> all, const EpipolarShift& linear, const RowMotion& motion,
         Arena& scratch)
      : shift(&scratch),
        prior(&scratch),
        around(&scratch),
        at(&scratch, motion.shift_px.width, motion.shift_px.height, -1),
        next(all.size(), -1, &scratch),
        locals(all) {
    Numbers room(&scratch);
    for (const LocalShift& local : all) room.push_back(local.information);
    const double usual = median(room);
    for (std::size_t k = 0; k < all.size(); ++k) {
      shift.push_back(all[k].shift_px - linear.at(all[k].x_px, all[k].y_px));
      prior.push_back(all[k].information / (all[k].information + usual));
      const Node node = node_of(all[k]);
      if (node.x < 1 || node.y < 1 || node.x >= at.width - 1 || node.y >= at.height - 1) continue;
      next[k] = at.row(node.y)[node.x];
      at.row(node.y)[node.x] = static_cast<int>(k);
    }
    around.reserve(64);
  }

  template <typename Visit>
  void neighbours(const Node& node, Visit&& visit) const {
    for (int y = std::max(0, node.y - kNeighbours); y <= std::min(at.height - 1, node.y + kNeighbours); ++y)
      for (int x = std::max(0, node.x - kNeighbours); x <= std::min(at.width - 1, node.x + kNeighbours); ++x)
        for (int k = at.row(y)[x]; k >= 0; k = next[static_cast<std::size_t>(k)])
          visit(static_cast<std::size_t>(k));
  }

  Numbers shift, prior, around;
  Plane<int> at;               // the first local at a node, -1: none
  std::pmr::vector<int> next;  // the next local at the same node
  std::span<const LocalShift> locals;
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
  if (off.size() < kLeastLocals) return s;
  s.scatter = std::max(median(off) / kMedianOfAbsolute, 1e-3);
  double seen = 0;
  double explained = 0;
  for (std::size_t k = 0; k < n; ++k) {
    if (shares[k] == 0) continue;
    seen += s.middle[k] * s.middle[k];
    explained += shares[k] * s.scatter * s.scatter;
  }
  s.amplitude2 = std::max(0.0, (seen - explained) / static_cast<double>(off.size()));
  return s;
}

}  // namespace

RowMotion::RowMotion(std::pmr::memory_resource* memory, int width_px, int height_px)
    : shift_px(memory, width_px / kMotionStepPx + 3, height_px / kMotionStepPx + 3) {}

double RowMotion::at(double x_px, double y_px) const {
  if (!seen) return 0;
  const double x = std::clamp(x_px / kMotionStepPx, 0.0, shift_px.width - 1.001);
  const double y = std::clamp(y_px / kMotionStepPx, 0.0, shift_px.height - 1.001);
  const int i = static_cast<int>(x);
  const int j = static_cast<int>(y);
  const double tx = x - i;
  const double ty = y - j;
  const auto value = [&](int dx, int dy) { return static_cast<double>(shift_px.row(j + dy)[i + dx]); };
  const double top = value(0, 0) + tx * (value(1, 0) - value(0, 0));
  return top + ty * (value(0, 1) + tx * (value(1, 1) - value(0, 1)) - top);
}

void fit_row_motion(std::span<const LocalShift> locals, const EpipolarShift& linear, double face_width_px,
                    StageContext& context, RowMotion& motion) {
  if (locals.size() < kLeastLocals) return;
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
  const auto bend = static_cast<float>(ridge * reach * reach * reach * reach);
  BendingSystem system(&context.scratch, field.width, field.height);
  for (int y = 1; y < field.height - 1; ++y)
    for (int x = 1; x < field.width - 1; ++x) {
      system.bend_xx.row(y)[x] = x > 1 && x < field.width - 2 ? bend : 0;
      system.bend_yy.row(y)[x] = y > 1 && y < field.height - 2 ? bend : 0;
      system.bend_xy.row(y)[x] = x < field.width - 2 && y < field.height - 2 ? 2 * bend : 0;
    }
  for (int round = 0; round < kReweightings; ++round) {
    for (float& a : system.data.values) a = static_cast<float>(ridge);
    std::fill(system.rhs.values.begin(), system.rhs.values.end(), 0.0F);
    for (std::size_t k = 0; k < locals.size(); ++k) {
      const Node node = node_of(locals[k]);
      if (node.x < 1 || node.y < 1 || node.x >= field.width - 1 || node.y >= field.height - 1) continue;
      const double here = round == 0 ? around.middle[k] : static_cast<double>(field.row(node.y)[node.x]);
      const double u = (beyond.shift[k] - here) * std::sqrt(beyond.prior[k]) / (kTukey * around.scatter);
      const double inside = std::max(0.0, 1 - u * u);
      const double weight = beyond.prior[k] * inside * inside / (around.scatter * around.scatter);
      system.data.row(node.y)[node.x] += static_cast<float>(weight);
      system.rhs.row(node.y)[node.x] += static_cast<float>(weight * beyond.shift[k]);
    }
    solve(system, kSolverSteps, kToTheEnd, context.pool, context.scratch, field);
  }
  motion.seen = true;
  double sum = 0;
  for (const LocalShift& local : locals) {
    const double v = motion.at(local.x_px, local.y_px);
    sum += v * v;
  }
  motion.rms_px = std::sqrt(sum / static_cast<double>(locals.size()));
}

}  // namespace relievo::pipeline
