// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/completion/unrolled_head.h"

#include <algorithm>
#include <utility>

#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

constexpr int kRelaxRounds = 150;

void relax(const UnrolledHead& head, std::pmr::vector<float>& shift,
           const std::pmr::vector<std::uint8_t>& fixed) {
  const FaceRelief &own = head.own, &added = head.added;
  for (int round = 0; round < kRelaxRounds; ++round)
    for (int r = 0; r < own.rows(); ++r)
      for (int c = 0; c < own.columns(); ++c) {
        if (fixed[head.index(c, r)] != 0 || std::isnan(added.z(c, r))) continue;
        float sum = 0;
        int count = 0;
        for (const auto& [dc, dr] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
          if (!own.inside(c + dc, r + dr)) continue;
          if (fixed[head.index(c + dc, r + dr)] == 0 && std::isnan(added.z(c + dc, r + dr))) continue;
          sum += shift[head.index(c + dc, r + dr)];
          ++count;
        }
        if (count > 0) shift[head.index(c, r)] = sum / float(count);
      }
}

// Two sweeps.
void measure_distance(UnrolledHead& head, float cell_mm) {
  const FaceRelief& own = head.own;
  const int columns = own.columns(), rows = own.rows();
  head.distance_mm.assign(std::size_t(columns * rows), 1e6F);
  const auto step = [&](int c, int r, int dc, int dr) {
    if (head.has_own(c, r)) head.distance_mm[head.index(c, r)] = 0;
    else if (own.inside(c + dc, r + dr))
      head.distance_mm[head.index(c, r)] = std::min(head.distance_mm[head.index(c, r)],
                                                    head.distance_mm[head.index(c + dc, r + dr)] + cell_mm);
  };
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) step(c, r, -1, 0), step(c, r, 0, -1);
  for (int r = rows; r-- > 0;)
    for (int c = columns; c-- > 0;) step(c, r, 1, 0), step(c, r, 0, 1);
}

}  // namespace

Vec3f unrolled(const Vec3d& in_head) {
  const double z = in_head.z + kAxisBehind;
  return {float(kArcRadius * std::atan2(in_head.x, z)), float(in_head.y), float(std::hypot(in_head.x, z))};
}

Vec3d rolled(double arc, double y, double radius) {
  const double angle = arc / kArcRadius;
  return {radius * std::sin(angle), y, radius * std::cos(angle) - kAxisBehind};
}

UnrolledHead::UnrolledHead(const FaceMesh& mesh, const RigidTransform& head_from_camera, double cell_mm,
                           Arena& scratch)
    : flat(laid_flat(mesh, scratch,
                     [&](const Vec3f& v) { return unrolled(apply(head_from_camera, wide(v))); })),
      own({-kHalfArc, kHalfArc, -kBelow, kAbove, cell_mm}, &scratch),
      added({-kHalfArc, kHalfArc, -kBelow, kAbove, cell_mm}, &scratch),
      distance_mm(&scratch) {
  own.add(flat, {}, true);  // gaps that the mesher closed are surface here
}

void UnrolledHead::add_other_side(double cell_mm, Arena& scratch) {
  std::pmr::vector<float> shift(cells(), 0.0F, &scratch);
  std::pmr::vector<std::uint8_t> fixed(cells(), 0, &scratch);
  for (int r = 0; r < own.rows(); ++r)
    for (int c = 0; c < own.columns(); ++c) {
      const float value = own.z(own.columns() - 1 - c, r);
      if (std::isnan(value)) continue;
      if (has_own(c, r))
        shift[index(c, r)] = std::clamp(own.z(c, r) - value, -4.0F, 4.0F), fixed[index(c, r)] = 1;
      else added.z(c, r) = value;
    }
  relax(*this, shift, fixed);
  for (int r = 0; r < own.rows(); ++r)
    for (int c = 0; c < own.columns(); ++c) added.z(c, r) += shift[index(c, r)];
  measure_distance(*this, float(cell_mm));
}

}  // namespace relievo::pipeline
