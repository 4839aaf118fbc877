// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/gate/head/beside_head.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace relievo::pipeline {
namespace {

constexpr double kUpMm = 95, kDownMm = 35;  // of the tip of the nose: brows to mouth, no shoulders
constexpr double kOwnMm = 60;               // a surface with so much aside of the tip is the head's,
constexpr double kOwnMm2 = 300;             // where it covers so much there
constexpr double kOwnShare = 0.6;    // of a field, for wide hair, a hat, the back of a head turned by 25
                                     // degrees (a third): fuller is what touches the head
constexpr double kLeastSeen = 0.25;  // of a field: the rest is out of the picture
constexpr std::size_t kOwnSurfaces = 256;

// The pixels of a rectangle before the head, `right` to the picture's right of the tip.
struct Field {
  int x0, x1, y0, y1;
  int pixels() const { return std::max(0, x1 - x0 + 1) * std::max(0, y1 - y0 + 1); }
};

Field field(const Relief& relief, const Vec3d& tip, double right0, double right1, double z) {
  const Vec2d a = relief.pixel({tip.x + right0, tip.y - kUpMm, z}),
              b = relief.pixel({tip.x + right1, tip.y + kDownMm, z});
  return {static_cast<int>(std::ceil(a.x)), static_cast<int>(std::floor(b.x)),
          static_cast<int>(std::ceil(a.y)), static_cast<int>(std::floor(b.y))};
}

Field within(const Relief& relief, const Field& f) {
  return {std::max(f.x0, 0), std::min(f.x1, relief.width_px - 1), std::max(f.y0, 0),
          std::min(f.y1, relief.height_px - 1)};
}

bool level_with(const Vec3d& tip, float depth_mm) {
  const double z = static_cast<double>(depth_mm);
  return z > tip.z - kBesideBeforeMm && z < tip.z + kBesideBehindMm;
}

// Surfaces by the area they cover of the head itself.
std::array<bool, kOwnSurfaces> own_surfaces(const Relief& relief, const Vec3d& tip) {
  std::array<int, kOwnSurfaces> pixels{};
  const Field head = within(relief, field(relief, tip, -kOwnMm, kOwnMm, tip.z));
  for (int y = head.y0; y <= head.y1; ++y)
    for (int x = head.x0; x <= head.x1; ++x) {
      const std::size_t i = relief.index(x, y);
      if (relief.surface[i] != 0 && relief.surface[i] < kOwnSurfaces && level_with(tip, relief.depth_mm[i]))
        ++pixels[relief.surface[i]];
    }
  std::array<bool, kOwnSurfaces> own{};
  const double pixel_mm = tip.z / relief.focal_px;
  for (std::size_t i = 0; i < kOwnSurfaces; ++i) own[i] = pixels[i] * pixel_mm * pixel_mm > kOwnMm2;
  return own;
}

}  // namespace

double beside_share(const Relief& relief, const HeadMeasurement& head) {
  if (!head.known || relief.surface.empty()) return 0;
  const Vec3d& tip = head.tip_mm;
  const std::array<bool, kOwnSurfaces> own = own_surfaces(relief, tip);
  double most = 0;
  for (const double side : {-1.0, 1.0}) {
    // Seen at the depth of the ears.
    const double a = side * kBesideInnerMm, b = side * kBesideOuterMm;
    const Field whole = field(relief, tip, std::min(a, b), std::max(a, b), tip.z + 60),
                seen = within(relief, whole);
    if (seen.pixels() < kLeastSeen * whole.pixels()) continue;
    int foreign = 0, owned = 0;
    for (int y = seen.y0; y <= seen.y1; ++y)
      for (int x = seen.x0; x <= seen.x1; ++x) {
        const std::size_t i = relief.index(x, y);
        if (relief.surface[i] == 0 || !level_with(tip, relief.depth_mm[i])) continue;
        ++(relief.surface[i] < kOwnSurfaces && own[relief.surface[i]] ? owned : foreign);
      }
    const double all = std::max(1, seen.pixels());
    most = std::max(most, foreign / all + std::max(0.0, owned / all - kOwnShare));
  }
  return most;
}

}  // namespace relievo::pipeline
