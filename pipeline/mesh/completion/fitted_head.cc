// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/completion/generic_head.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>

namespace relievo::pipeline {
namespace {

using Modes = Eigen::Matrix<double, kHeadModes, 1>;
using ModesSquare = Eigen::Matrix<double, kHeadModes, kHeadModes>;

constexpr double kApartMm = 5;      // between the places that the fit looks at
constexpr double kTogetherMm = 12;  // over which the misfit hangs together, and tells as much as one place
constexpr int kRounds = 6;
constexpr double kHuber = 1.5;  // misfits beyond this many count less: hair, a tongue, a hand

struct Fit {
  Modes weight = Modes::Zero();
  ModesSquare covariance = ModesSquare::Identity();
};

Modes modes_of(const HeadPlace& place) { return Eigen::Map<const Modes>(place.mode_mm.data()); }

Fit fit_modes(const UnrolledHead& head, double cell_mm, double misfit_mm) {
  const int step = std::max(1, int(std::lround(kApartMm / cell_mm)));
  const double apart = step * cell_mm;
  const double noise = misfit_mm * std::max(1.0, kTogetherMm / apart);
  Fit fit;
  for (int round = 0; round < kRounds; ++round) {
    ModesSquare normal = ModesSquare::Identity();
    Modes right = Modes::Zero();
    for (int r = step / 2; r < head.own.rows(); r += step)
      for (int c = step / 2; c < head.own.columns(); c += step) {
        if (!head.has_own(c, r)) continue;
        const HeadPlace place = head_place(head.own.x_mm(c), head.own.y_mm(r));
        const Modes modes = modes_of(place);
        const double seen = double(head.own.z(c, r)) - place.mean_mm;
        const double off = std::abs(seen - modes.dot(fit.weight)) / misfit_mm;
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

constexpr double kBelowLips = -35;  // y: a jaw is looked for from here down
constexpr float kSteepest = 1.0F;

// What lies below the jaw, seen from the axis, falls away too steeply for radii.
void end_at_jaw(FaceRelief& radius, int c, float cell_mm) {
  bool ended = false;
  for (int r = radius.rows() - 2; r >= 0; --r) {
    if (radius.y_mm(r) > kBelowLips) continue;
    ended = ended || radius.z(c, r + 1) - radius.z(c, r) > kSteepest * cell_mm;
    if (ended) radius.z(c, r) = std::numeric_limits<float>::quiet_NaN();
  }
}

}  // namespace

FaceRelief fit_generic_face(const UnrolledHead& head, double cell_mm, double misfit_mm) {
  const Fit fit = fit_modes(head, cell_mm, misfit_mm);
  FaceRelief radius = head.added;
  for (int r = 0; r < radius.rows(); ++r)
    for (int c = 0; c < radius.columns(); ++c) {
      const HeadPlace place = head_place(radius.x_mm(c), radius.y_mm(r));
      radius.z(c, r) = float(place.mean_mm + modes_of(place).dot(fit.weight));
    }
  for (int c = 0; c < radius.columns(); ++c) end_at_jaw(radius, c, float(cell_mm));
  return radius;
}

FittedGlobe fit_generic_globe(const UnrolledHead& head, double cell_mm, double misfit_mm,
                              std::pmr::memory_resource* memory) {
  const Fit fit = fit_modes(head, cell_mm, misfit_mm);
  FittedGlobe fitted{std::pmr::vector<double>(memory), std::pmr::vector<double>(memory)};
  for (std::size_t node = 0; node < kGlobeNodes; ++node) {
    const HeadPlace place = globe_place(node);
    const Modes modes = modes_of(place);
    fitted.radius_mm.push_back(place.mean_mm + modes.dot(fit.weight));
    fitted.sigma_mm.push_back(
        std::sqrt(misfit_mm * misfit_mm + place.left_mm * place.left_mm + modes.dot(fit.covariance * modes)));
  }
  return fitted;
}

}  // namespace relievo::pipeline
