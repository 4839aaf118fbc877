// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/completion/generic_head_completion.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "pipeline/mesh/completion/generic_head.h"
#include "pipeline/mesh/completion/head_sewing.h"
#include "pipeline/mesh/completion/unrolled_head.h"

namespace relievo::pipeline {
namespace {

using Modes = Eigen::Matrix<double, kHeadModes, 1>;
using ModesSquare = Eigen::Matrix<double, kHeadModes, kHeadModes>;

constexpr double kApartMm = 5;       // between the places that the fit looks at
constexpr double kTogetherMm = 12;   // over which the misfit hangs together: that many places tell as much as one
constexpr int kRounds = 6;
constexpr double kHuber = 1.5;       // misfits beyond this many count less: hair, a tongue, a hand

struct Fit {
  Modes weight = Modes::Zero();
  ModesSquare covariance = ModesSquare::Identity();
};

Modes modes_of(const HeadPlace& place) { return Eigen::Map<const Modes>(place.mode_mm.data()); }

Fit fit_head(const UnrolledHead& head, const GenericHeadOptions& options) {
  const int step = std::max(1, static_cast<int>(std::lround(kApartMm / options.cell_mm)));
  const double apart = step * options.cell_mm;
  const double noise = options.misfit_mm * std::max(1.0, kTogetherMm / apart);
  Fit fit;
  for (int round = 0; round < kRounds; ++round) {
    ModesSquare normal = ModesSquare::Identity();
    Modes right = Modes::Zero();
    for (int r = step / 2; r < head.own.rows(); r += step)
      for (int c = step / 2; c < head.own.columns(); c += step) {
        if (!head.has_own(c, r)) continue;
        const HeadPlace place = head_place(head.own.x_mm(c), head.own.y_mm(r));
        const Modes modes = modes_of(place);
        const double seen = static_cast<double>(head.own.z(c, r)) - place.mean_mm;
        const double off = std::abs(seen - modes.dot(fit.weight)) / options.misfit_mm;
        const double weight = (round == 0 || off < kHuber ? 1 : kHuber / off) / (noise * noise);
        normal += weight * modes * modes.transpose();
        right += weight * seen * modes;
      }
    const Eigen::LLT<ModesSquare> solved(normal);
    fit.weight = solved.solve(right);
    if (round + 1 == kRounds) fit.covariance = solved.solve(ModesSquare::Identity());
  }
  return fit;
}

// The fitted head over the cells of `head`, and its sigma. It ends at the jaw: what lies below, seen from the axis, falls
// away too steeply for radii.
struct FittedHead {
  FittedHead(const UnrolledHead& head, const Fit& fit, const GenericHeadOptions& options) : radius(head.added), sigma(head.added) {
    for (int r = 0; r < radius.rows(); ++r)
      for (int c = 0; c < radius.columns(); ++c) {
        const HeadPlace place = head_place(radius.x_mm(c), radius.y_mm(r));
        const Modes modes = modes_of(place);
        radius.z(c, r) = static_cast<float>(place.mean_mm + modes.dot(fit.weight));
        sigma.z(c, r) = static_cast<float>(std::sqrt(options.misfit_mm * options.misfit_mm + place.left_mm * place.left_mm + modes.dot(fit.covariance * modes)));
      }
    for (int c = 0; c < radius.columns(); ++c) end_at_jaw(c, static_cast<float>(options.cell_mm));
  }
  FaceRelief radius, sigma;

 private:
  static constexpr double kBelowLips = -35;  // y: a jaw is looked for from here down
  static constexpr float kSteepest = 1.0F;

  void end_at_jaw(int c, float cell_mm) {
    bool ended = false;
    for (int r = radius.rows() - 2; r >= 0; --r) {
      if (radius.y_mm(r) > kBelowLips) continue;
      ended = ended || radius.z(c, r + 1) - radius.z(c, r) > kSteepest * cell_mm;
      if (ended) radius.z(c, r) = std::numeric_limits<float>::quiet_NaN();
    }
  }
};

}  // namespace

Result<void> GenericHeadOptions::check() const {
  if (!(cell_mm >= 0.5 && cell_mm <= 10)) return Error{Errc::InvalidInput, "cell_mm must lie in 0.5 .. 10"}.at("generic-head");
  if (!(longest_edge_mm >= 2 * cell_mm && longest_edge_mm <= 50))
    return Error{Errc::InvalidInput, "longest_edge_mm must lie between two cells and 50"}.at("generic-head");
  if (!(misfit_mm >= 0.1 && misfit_mm <= 20)) return Error{Errc::InvalidInput, "misfit_mm must lie in 0.1 .. 20"}.at("generic-head");
  return {};
}

Result<FaceMesh> GenericHeadCompletion::complete(FaceMesh mesh, const Vec3d& across, StageContext& context) const {
  const auto fit = [&](UnrolledHead& head) {
    FittedHead fitted(head, fit_head(head, options_), options_);
    head.add([&fitted](int c, int r) { return fitted.radius.z(c, r); }, options_.cell_mm, context.scratch);
    return SewingRules{options_.longest_edge_mm, 0, 0, std::move(fitted.sigma)};
  };
  return complete_head(std::move(mesh), across, options_.cell_mm, fit, context);
}

}  // namespace relievo::pipeline
