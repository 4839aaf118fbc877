// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/completion/generic_head.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

#include "hal/base/assert.h"
#include "pipeline/model/vector3.h"

// The file becomes part of the library: nothing is looked for when it runs.
asm(R"(.pushsection .rodata
.global relievo_generic_head, relievo_generic_head_end
.hidden relievo_generic_head, relievo_generic_head_end
.balign 8
relievo_generic_head:
.incbin ")" RELIEVO_GENERIC_HEAD_FILE R"("
relievo_generic_head_end:
.popsection)");
extern "C" const std::byte relievo_generic_head[], relievo_generic_head_end[];

namespace relievo::pipeline {
namespace {

// Where a coordinate lies among the cells, and what the four around it count (Catmull and Rom 1974): a head
// has no creases where its cells meet.
struct Taps {
  std::array<std::size_t, 4> cell{};
  std::array<double, 4> weight{};
};

Taps taps_at(double share, int cells) {
  const double at = std::clamp(share, 0.0, 1.0) * (cells - 1);
  const int first = std::min(int(at), cells - 2);
  const double t = at - first;
  Taps taps;
  for (int k = 0; k < 4; ++k)
    taps.cell[std::size_t(k)] = std::size_t(std::clamp(first - 1 + k, 0, cells - 1));
  taps.weight = {0.5 * t * (t * (2 - t) - 1), 0.5 * (t * t * (3 * t - 5) + 2),
                 0.5 * t * (t * (4 - 3 * t) + 1), 0.5 * t * t * (t - 1)};
  return taps;
}

constexpr std::size_t kCells = std::size_t{kHeadColumns} * kHeadRows;

constexpr int kRelaxRounds = 150;

ReliefBox box_of(double cell_mm) { return {-kHalfArc, kHalfArc, -kBelow, kAbove, cell_mm}; }

// What was added takes the mean of its neighbours' shifts, where these have one.
void relax(const FaceRelief& added, FaceRelief& shift) {
  for (int round = 0; round < kRelaxRounds; ++round)
    for (int r = 0; r < shift.rows(); ++r)
      for (int c = 0; c < shift.columns(); ++c) {
        if (std::isnan(added.z(c, r))) continue;
        float sum = 0;
        int count = 0;
        for (const auto& [dc, dr] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
          if (!shift.inside(c + dc, r + dr) || std::isnan(shift.z(c + dc, r + dr))) continue;
          sum += shift.z(c + dc, r + dr);
          ++count;
        }
        if (count > 0) shift.z(c, r) = sum / float(count);
      }
}

// Two sweeps.
void measure_distance(UnrolledHead& head) {
  FaceRelief& away = head.away;
  const auto step = [&](int c, int r, int dc, int dr) {
    if (head.has_own(c, r)) away.z(c, r) = 0;
    else if (away.inside(c + dc, r + dr))  // of what is not known yet fmin() takes the other
      away.z(c, r) = std::fmin(away.z(c, r), away.z(c + dc, r + dr) + float(head.cell_mm));
  };
  for (int r = 0; r < away.rows(); ++r)
    for (int c = 0; c < away.columns(); ++c) step(c, r, -1, 0), step(c, r, 0, -1);
  for (int r = away.rows(); r-- > 0;)
    for (int c = away.columns(); c-- > 0;) step(c, r, 1, 0), step(c, r, 0, 1);
}

// Arc, height and radius about the head's axis.
Vec3f unrolled(const Vec3d& in_head) {
  const double z = in_head.z + kAxisBehind;
  return {float(kArcRadius * std::atan2(in_head.x, z)), float(in_head.y), float(std::hypot(in_head.x, z))};
}

const GenericHead& generic_head() {
  static const GenericHead head = [] {
    const Result<GenericHead> read = read_generic_head(generic_head_file());
    RELIEVO_ASSERT(read);
    return *read;
  }();
  return head;
}

using Modes = Eigen::Matrix<double, kHeadModes, 1>;
using ModesSquare = Eigen::Matrix<double, kHeadModes, kHeadModes>;

// The mean and every mode at one place, smooth between the cells.
struct HeadPlace {
  double mean_mm = 0;
  double left_mm = 0;
  Modes mode_mm = Modes::Zero();
};

void add_to(HeadPlace& place, const HeadRadii& radii, std::size_t cell, double weight) {
  const std::size_t cells = radii.mean.size();
  place.mean_mm += weight * kHeadMeanUnit * radii.mean[cell];
  place.left_mm += weight * kHeadMeanUnit * radii.left[cell];
  for (int k = 0; k < kHeadModes; ++k)
    place.mode_mm[k] += weight * kHeadModeUnit * radii.mode[std::size_t(k) * cells + cell];
}

HeadPlace head_place(double arc_mm, double y_mm) {
  const Taps across = taps_at((arc_mm + kHalfArc) / (2 * kHalfArc), kHeadColumns);
  const Taps up = taps_at((y_mm + kBelow) / (kBelow + kAbove), kHeadRows);
  HeadPlace place;
  for (std::size_t j = 0; j < 4; ++j)
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t cell = up.cell[j] * kHeadColumns + across.cell[i];
      add_to(place, generic_head().face, cell, up.weight[j] * across.weight[i]);
    }
  return place;
}

constexpr double kApartMm = 5;      // between the places that the fit looks at
constexpr double kTogetherMm = 12;  // over which the misfit hangs together, and tells as much as one place
constexpr int kRounds = 6;
constexpr double kHuber = 1.5;  // misfits beyond this many count less: hair, a tongue, a hand

struct Fit {
  Modes weight = Modes::Zero();
  ModesSquare covariance = ModesSquare::Identity();
};

Fit fit_modes(const UnrolledHead& head, double misfit_mm) {
  const int step = std::max(1, int(std::lround(kApartMm / head.cell_mm)));
  const double apart = step * head.cell_mm;
  const double noise = misfit_mm * std::max(1.0, kTogetherMm / apart);
  Fit fit;
  for (int round = 0; round < kRounds; ++round) {
    ModesSquare normal = ModesSquare::Identity();
    Modes right = Modes::Zero();
    for (int r = step / 2; r < head.own.rows(); r += step)
      for (int c = step / 2; c < head.own.columns(); c += step) {
        if (!head.has_own(c, r)) continue;
        const HeadPlace place = head_place(head.own.x_mm(c), head.own.y_mm(r));
        const Modes& modes = place.mode_mm;
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

}  // namespace

Result<GenericHead> read_generic_head(std::span<const std::byte> file) {
  const Error none{
      Errc::InvalidInput,
      "generic_head.bin is no generic head of this program's size: make it anew (make_generic_head)"};
  constexpr std::size_t kCounts = (kHeadModes + 2) * (kCells + kGlobeNodes);
  GenericHeadHeader header{};
  if (file.size() != sizeof(header) + kCounts * sizeof(std::int16_t)) return none;
  std::memcpy(&header, file.data(), sizeof(header));
  if (header != kGenericHeadHeader) return none;
  const auto* next = reinterpret_cast<const std::int16_t*>(file.data() + sizeof(header));
  const auto take = [&](std::size_t count) { return std::span(std::exchange(next, next + count), count); };
  const auto radii = [&](std::size_t cells) {
    return HeadRadii{take(cells), take(kHeadModes * cells), take(cells)};
  };
  const HeadRadii face = radii(kCells);
  return GenericHead{face, radii(kGlobeNodes)};
}

std::span<const std::byte> generic_head_file() { return {relievo_generic_head, relievo_generic_head_end}; }

Vec3d rolled(double arc, double y, double radius) {
  const double angle = arc / kArcRadius;
  return {radius * std::sin(angle), y, radius * std::cos(angle) - kAxisBehind};
}

UnrolledHead::UnrolledHead(const FaceMesh& mesh, const RigidTransform& head_from_camera, double cell,
                           Arena& scratch)
    : cell_mm(cell),
      flat(laid_flat(mesh, scratch,
                     [&](const Vec3f& v) { return unrolled(apply(head_from_camera, wide(v))); })),
      own(box_of(cell), &scratch),
      added(box_of(cell), &scratch),
      away(box_of(cell), &scratch) {
  own.add(flat, {}, true);  // gaps that the mesher closed are surface here
}

void UnrolledHead::add_other_side(Arena& scratch) {
  FaceRelief shift(box_of(cell_mm), &scratch);
  for (int r = 0; r < own.rows(); ++r)
    for (int c = 0; c < own.columns(); ++c) {
      const float value = own.z(own.columns() - 1 - c, r);
      if (std::isnan(value)) continue;
      if (has_own(c, r)) shift.z(c, r) = std::clamp(own.z(c, r) - value, -4.0F, 4.0F);
      else added.z(c, r) = value, shift.z(c, r) = 0;
    }
  relax(added, shift);
  for (int r = 0; r < own.rows(); ++r)
    for (int c = 0; c < own.columns(); ++c) added.z(c, r) += shift.z(c, r);
  measure_distance(*this);
}

void fit_generic_face(UnrolledHead& head, double misfit_mm) {
  const Fit fit = fit_modes(head, misfit_mm);
  FaceRelief& radius = head.added;
  for (int r = 0; r < radius.rows(); ++r)
    for (int c = 0; c < radius.columns(); ++c) {
      const HeadPlace place = head_place(radius.x_mm(c), radius.y_mm(r));
      radius.z(c, r) = float(place.mean_mm + place.mode_mm.dot(fit.weight));
    }
  // What lies below the jaw, seen from the axis, falls away too steeply for radii.
  for (int c = 0; c < radius.columns(); ++c) {
    bool ended = false;
    for (int r = radius.rows() - 2; r >= 0; --r) {
      if (radius.y_mm(r) > kBelowLips) continue;
      ended = ended || radius.z(c, r + 1) - radius.z(c, r) > kSteepest * float(head.cell_mm);
      if (ended) radius.z(c, r) = std::numeric_limits<float>::quiet_NaN();
    }
  }
}

std::array<std::pmr::vector<double>, 2> fit_generic_globe(const UnrolledHead& head, double misfit_mm,
                                                          std::pmr::memory_resource* memory) {
  const Fit fit = fit_modes(head, misfit_mm);
  std::pmr::vector<double> radius(memory), sigma(memory);
  for (std::size_t node = 0; node < kGlobeNodes; ++node) {
    HeadPlace place;
    add_to(place, generic_head().globe, node, 1);
    const Modes& modes = place.mode_mm;
    radius.push_back(place.mean_mm + modes.dot(fit.weight));
    sigma.push_back(
        std::sqrt(misfit_mm * misfit_mm + place.left_mm * place.left_mm + modes.dot(fit.covariance * modes)));
  }
  return {std::move(radius), std::move(sigma)};
}

}  // namespace relievo::pipeline
