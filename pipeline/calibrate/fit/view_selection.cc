// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/fit/stereo_fit.h"

#include <algorithm>
#include <numeric>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "pipeline/base/solving.h"

namespace relievo::pipeline {
namespace {

constexpr std::size_t kMaxStarts = 24;
constexpr int kConcentrations = 4;
constexpr double kDegrees = 6;
// Normal deviates: below this a view is let in unasked, above that it is left out, one good view in some
// 30,000.
constexpr double kPlain = 1.5;
constexpr double kSurprise = 4.0;

using bundle::cross;
using bundle::Matrix6d;
using bundle::Pose;
using bundle::Vector6d;

// P(chi-square of `degrees` <= x), degrees even: a finite sum.
double chi_square(double x, int degrees) {
  double term = 1;
  double sum = 1;
  for (int k = 1; k < degrees / 2; ++k) sum += term *= x / 2 / k;
  return 1 - std::exp(-x / 2) * sum;
}

// Paulson's normal deviate of an F ratio.
double surprise(double f, double degrees_up, double degrees_down) {
  const double a = 2 / (9 * degrees_up);
  const double b = 2 / (9 * degrees_down);
  const double root = std::cbrt(std::max(f, 0.0));
  return ((1 - b) * root - (1 - a)) / std::sqrt(b * root * root + a);
}

std::vector<std::size_t> calmest(const std::vector<double>& cost, std::size_t count) {
  std::vector<std::size_t> order(cost.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return cost[a] < cost[b]; });
  order.resize(std::min(count, order.size()));
  std::ranges::sort(order);
  return order;
}

std::vector<int> pairs_at(std::span<const int> pairs, std::span<const std::size_t> places) {
  std::vector<int> chosen;
  for (const std::size_t place : places) chosen.push_back(pairs[place]);
  return chosen;
}

double excess_of(const CameraFits& cameras, const StereoFit& fit) {
  double sum = fit.paired_squared_px;
  for (const int view : fit.paired) sum -= cameras.squared_px(view);
  return sum;
}

// Variance of one degree of freedom of the disagreement.
double spread_of(const CameraFits& cameras, const StereoFit& fit, std::size_t pairs) {
  const double used = double(fit.paired.size()), share = used / double(pairs);
  // The best share of a normal sample looks calmer than the sample is: the factor that mends it
  // (Croux and Haesbroeck 1999).
  double low = 0, high = 100;
  for (int i = 0; i < 60; ++i) (chi_square((low + high) / 2, 6) < share ? low : high) = (low + high) / 2;
  const double mended = share >= 0.999 ? 1 : share / chi_square(low, 8);
  return std::max(cameras.noise_px2(), mended * excess_of(cameras, fit) / (kDegrees * (used - 1)));
}

// What a pair of pictures alone says about where the right camera stands, to second order: enough to try many
// subsets of the pairs without a single bundle adjustment.
struct Miss {
  Vector6d off;      // of the right camera's board, as a step from where it sees it
  Matrix6d by_step;  // of `off` by a step of the relation
  Matrix6d weight;   // of `off`, the left camera's freedom taken out
};

Miss miss_of(const CameraFits& cameras, int pair, const Pose& relation) {
  const Eigen::Matrix3d& r = relation.rotation;
  const Pose& left = cameras.left.pose(pair);
  const Pose& right = cameras.right.pose(pair);  // from the right camera itself
  const Matrix6d& right_information = cameras.right.view(pair).information;
  const Eigen::Vector3d turned = r * left.translation_mm;
  Miss miss;
  miss.off.head<3>() = bundle::turn_of(r * left.rotation * right.rotation.transpose());
  miss.off.tail<3>() = turned + relation.translation_mm - right.translation_mm;
  miss.by_step.setIdentity();
  miss.by_step.bottomLeftCorner<3, 3>() = -cross(turned);
  Matrix6d carry = Matrix6d::Zero();  // a step of the left board, as one of the right
  carry.topLeftCorner<3, 3>() = r;
  carry.bottomRightCorner<3, 3>() = r;
  const Matrix6d pull = right_information * carry;
  const Matrix6d both = cameras.left.view(pair).information + carry.transpose() * pull;
  miss.weight = right_information - eliminated<6, 6>(both, pull);
  return miss;
}

// What the pair's sum of squares grows by when the right camera stands at `right_from_left` (px²).
double misfit_px2(const CameraFits& cameras, int pair, const Pose& right_from_left) {
  const Miss miss = miss_of(cameras, pair, right_from_left);
  return miss.off.dot(miss.weight * miss.off);
}

// The relation under which the misfits of `chosen` (places in `pairs`) sum to the least, from a start.
Pose fit_relation(const CameraFits& cameras, std::span<const int> pairs, std::span<const std::size_t> chosen,
                  Pose right_from_left) {
  constexpr int kSteps = 3;
  for (int i = 0; i < kSteps; ++i) {
    Matrix6d sum = Matrix6d::Zero();
    Vector6d pull = Vector6d::Zero();
    for (const std::size_t place : chosen) {
      const Miss miss = miss_of(cameras, pairs[place], right_from_left);
      const Matrix6d weighted = miss.by_step.transpose() * miss.weight;
      sum.noalias() += weighted * miss.by_step;
      pull.noalias() -= weighted * miss.off;
    }
    right_from_left.step(solved<6>(sum, pull));
  }
  return right_from_left;
}

struct Half {
  std::vector<std::size_t> places;
  Pose relation;
  double misfit_px2 = 0;
};

// From one view's own relation to the half that agrees best with what it leads to.
Half concentrate(const CameraFits& cameras, std::span<const int> pairs, Pose relation, std::size_t half) {
  Half found;
  std::vector<double> cost(pairs.size());
  for (int round = 0; round < kConcentrations; ++round) {
    for (std::size_t i = 0; i < pairs.size(); ++i) cost[i] = misfit_px2(cameras, pairs[i], relation);
    std::vector<std::size_t> places = calmest(cost, round == 0 ? std::max<std::size_t>(3, half / 2) : half);
    if (places == found.places) break;
    found.places = std::move(places);
    relation = fit_relation(cameras, pairs, found.places, relation);
  }
  found.relation = relation;
  for (const std::size_t place : found.places)
    found.misfit_px2 += misfit_px2(cameras, pairs[place], relation);
  return found;
}

// The misses take each camera's lens as its own boards gave it; the last word has the whole fit.
bool best_half(const CameraFits& cameras, std::span<const int> pairs, StereoFit& best) {
  constexpr std::size_t kFinalists = 3;
  const std::size_t half = pairs.size() / 2 + 1;
  const std::size_t stride = (pairs.size() + kMaxStarts - 1) / kMaxStarts;
  std::vector<Half> halves;
  for (std::size_t s = 0; s < pairs.size(); s += stride) {
    Half one = concentrate(cameras, pairs, relation_of(cameras, pairs[s]), half);
    const bool known = std::ranges::any_of(halves, [&](const Half& h) { return h.places == one.places; });
    if (!known) halves.push_back(std::move(one));
  }
  std::ranges::stable_sort(halves, {}, &Half::misfit_px2);
  halves.resize(std::min(halves.size(), kFinalists));
  double least_excess = 0;
  bool found = false;
  for (const Half& one : halves) {
    std::vector<int> chosen = pairs_at(pairs, one.places);
    StereoFit fit;
    if (!fit_stereo(cameras, chosen, one.relation, 1, nullptr, fit)) continue;
    for (int round = 0; round < kConcentrations; ++round) {
      chosen = pairs_at(pairs, calmest(judge_pairs(cameras, fit, pairs), half));
      if (chosen == fit.paired) break;
      StereoFit calmer;
      if (!fit_stereo(cameras, chosen, fit.problem.right_from_left, 1, &fit, calmer)) break;
      fit = std::move(calmer);
    }
    const double excess = excess_of(cameras, fit);
    if (found && excess >= least_excess) continue;
    found = true;
    least_excess = excess;
    best = std::move(fit);
  }
  return found;
}

// Lets in every view outside that is plainly no surprise, else the cheapest if it is not too great a
// one; false when none is let in.
bool admit(const CameraFits& cameras, std::span<const int> pairs, StereoFit& fit) {
  constexpr std::size_t kCandidates = 3;
  std::vector<int> outside;
  for (const int view : pairs)
    if (!std::ranges::binary_search(fit.paired, view)) outside.push_back(view);
  if (outside.empty()) return false;
  const std::vector<double> cost = judge_pairs(cameras, fit, outside);
  const double spread = spread_of(cameras, fit, pairs.size());
  const double used = double(fit.paired.size());
  // A scale from a part of the views is known only as well as that part is large.
  const double degrees = kDegrees * (used - 1) * used / double(pairs.size());
  const auto deviate = [&](double added) { return surprise(added / kDegrees / spread, kDegrees, degrees); };
  const auto let_in = [&](std::span<const int> views, StereoFit& wider) {
    std::vector<int> with = fit.paired;
    for (const int view : views) with.insert(std::lower_bound(with.begin(), with.end(), view), view);
    return fit_stereo(cameras, with, fit.problem.right_from_left, 1, &fit, wider);
  };
  // Judged under a fit that had no regard to it a view costs more than it would add: a safe side.
  std::vector<int> plain;
  for (std::size_t i = 0; i < outside.size(); ++i)
    if (deviate(cost[i]) < kPlain) plain.push_back(outside[i]);
  if (!plain.empty()) return let_in(plain, fit);
  StereoFit best;
  double least_cost = 0;
  for (const int view : pairs_at(outside, calmest(cost, kCandidates))) {
    StereoFit wider;
    const int one[] = {view};
    if (!let_in(one, wider)) continue;
    const double added = excess_of(cameras, wider) - excess_of(cameras, fit);
    if (best.paired.empty() || added < least_cost) {
      best = std::move(wider);
      least_cost = added;
    }
  }
  if (best.paired.empty() || deviate(least_cost) > kSurprise) return false;
  fit = std::move(best);
  return true;
}

ChangePoint change_point(std::span<const double> excess, double spread_px2) {
  constexpr std::size_t kMinRun = 3;
  constexpr double kCertain = 30;
  constexpr double kOpen = 9.21;  // chi-square of 2 at 1 %
  const std::size_t n = excess.size();
  if (n < 2 * kMinRun) return {};
  // Twice the log likelihood gained by two spreads instead of one, 6 degrees of freedom a view.
  const auto cost = [&](std::size_t begin, std::size_t end) {
    double mean = 0;
    for (std::size_t i = begin; i < end; ++i) mean += excess[i] / kDegrees;
    mean = std::max(mean / double(end - begin), 0.25 * spread_px2 + 1e-12);
    return kDegrees * double(end - begin) * std::log(mean);
  };
  const auto gain = [&](std::size_t split) { return cost(0, n) - cost(0, split) - cost(split, n); };
  std::size_t at = kMinRun;
  for (std::size_t split = kMinRun; split + kMinRun <= n; ++split)
    if (gain(split) > gain(at)) at = split;
  // Most of one side must stand out of the agreed spread, or it is a single bad view, no move.
  const auto loud = [&](std::size_t begin, std::size_t end) {
    std::size_t count = 0;
    for (std::size_t i = begin; i < end; ++i) count += excess[i] > 4 * kDegrees * spread_px2 ? 1U : 0U;
    return 2 * count > end - begin;
  };
  if (gain(at) < kCertain || loud(0, at) == loud(at, n)) return {};
  std::size_t first = at;
  std::size_t last = at;
  while (first > kMinRun && gain(first - 1) > gain(at) - kOpen) --first;
  while (last + kMinRun < n && gain(last + 1) > gain(at) - kOpen) ++last;
  return {int(at) - 1, int(first) - 1, int(last) - 1};
}

using Direction = Eigen::Matrix<double, 6, 3>;

// The least misfit with a turn of the camera, or else a shift of the board, free in every pair.
double misfit_but(const CameraFits& cameras, std::span<const int> pairs, Pose relation, bool camera_turned) {
  constexpr int kSteps = 4;
  constexpr double kFirm = 1e-9;  // what the story leaves open of the relation stays as it is
  double cost = 0;
  for (int i = 0; i <= kSteps; ++i) {
    Direction turned, carried;
    turned << Eigen::Matrix3d::Identity(), -cross(relation.translation_mm);
    carried << Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Identity();
    Matrix6d sum = Matrix6d::Zero();
    Vector6d pull = Vector6d::Zero();
    cost = 0;
    for (const int pair : pairs) {
      const Miss miss = miss_of(cameras, pair, relation);
      const Direction excused = camera_turned ? Direction(miss.by_step * turned) : carried;
      const Direction weighted = miss.weight * excused;
      const Eigen::Matrix3d inner = excused.transpose() * weighted;
      const Matrix6d weight = miss.weight - weighted * inner.ldlt().solve(weighted.transpose());
      const Matrix6d by = miss.by_step.transpose() * weight;
      sum += by * miss.by_step;
      pull -= by * miss.off;
      cost += miss.off.dot(weight * miss.off);
    }
    sum.diagonal() *= 1 + kFirm;
    sum.diagonal().array() += kFirm * sum.trace();
    if (i < kSteps) relation.step(solved<6>(sum, pull));
  }
  return cost;
}

}  // namespace

bool select_views(const CameraFits& cameras, std::span<const int> pairs, Selection& out) {
  StereoFit chosen;
  if (!best_half(cameras, pairs, chosen)) return false;
  while (admit(cameras, pairs, chosen)) {
  }
  std::vector<int> used = chosen.paired;
  out.excess = judge_pairs(cameras, chosen, pairs);
  for (double& excess : out.excess) excess = std::max(0.0, excess);
  out.spread_px2 = std::max(0.0, excess_of(cameras, chosen)) / (kDegrees * double(used.size() - 1));
  const double spread = std::max(out.spread_px2, cameras.noise_px2());
  out.moved = change_point(out.excess, spread);
  if (out.moved.likeliest >= 0) {
    // Views on the other side of a camera's move belong to another rig, even if some seem to agree.
    const auto split = std::ranges::upper_bound(used, pairs[std::size_t(out.moved.likeliest)]);
    if (split - used.begin() >= used.end() - split) used.erase(split, used.end());
    else used.erase(used.begin(), split);
  }
  // Chosen with the lenses free to follow the pairs, so that a poor lens is not taken for a slip; the last
  // word has the slip's weight, so that a slip does not bend a lens.
  return fit_stereo(cameras, used, chosen.problem.right_from_left, spread / cameras.noise_px2(), &chosen,
                    out.fit);
}

bool board_carried_on(const CameraFits& cameras, std::span<const int> pairs, const Pose& right_from_left) {
  return misfit_but(cameras, pairs, right_from_left, false) <
         misfit_but(cameras, pairs, right_from_left, true);
}

}  // namespace relievo::pipeline
