// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/gate/head/beside_head.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace relievo::pipeline {
namespace {

// The face about the hint's middle, in widths of the hint (150 mm).
constexpr double kHalfWidth = 0.42, kUp = 0.55, kDown = 0.5;
constexpr double kGap = 0.3;  // beside something near, one of the cameras does not see what is behind
constexpr double kLeastFront = 0.04, kLeastBehind = 0.10;  // share of the face
constexpr double kMostStepMm = 160;                        // what is further behind is not the face
// Where the middle of the covered face may lie: a neck is lower, an ear further aside.
constexpr double kAside = 0.3, kBelow = 0.36;
constexpr std::size_t kSurfaces = 8;

struct Piece {
  int name = 0, pixels = 0;
  double sum_x = 0, sum_y = 0;          // from the hint's middle, widths
  std::array<int, kSurfaces> before{};  // meetings with each other piece that lies behind it
};

struct Face {
  const Relief& relief;
  const HeadHint& hint;
  std::array<Piece, kSurfaces> piece{};
  int all = 0;

  bool inside(int x, int y) const {
    const double u = (x - hint.centre_px.x) / hint.width_px, v = (y - hint.centre_px.y) / hint.width_px;
    const double a = u / kHalfWidth, b = v / (v < 0 ? kUp : kDown);
    return relief.inside(x, y) && a * a + b * b < 1;
  }
  Piece* named(int name) {
    for (Piece& p : piece) {
      if (p.pixels == 0) p.name = name;
      if (p.name == name) return &p;
    }
    return nullptr;
  }
  void count(int x, int y) {
    ++all;
    const int name = relief.surface[relief.index(x, y)];
    Piece* p = name != 0 ? named(name) : nullptr;
    if (p == nullptr) return;
    ++p->pixels;
    p->sum_x += (x - hint.centre_px.x) / hint.width_px;
    p->sum_y += (y - hint.centre_px.y) / hint.width_px;
  }
  // One line of the picture: what follows what on it, over gaps of which nothing is known.
  void walk(int x, int y, int dx, int dy, int steps) {
    std::size_t last = 0;
    int since = 0;
    bool any = false;
    for (int i = 0; i < steps; ++i, x += dx, y += dy, ++since) {
      if (!inside(x, y) || !relief.known(x, y)) continue;
      const std::size_t here = relief.index(x, y);
      if (any && relief.surface[here] != relief.surface[last] && since <= kGap * hint.width_px)
        meet(last, here);
      last = here;
      since = 0;
      any = true;
    }
  }
  void meet(std::size_t a, std::size_t b) {
    if (relief.depth_mm[a] > relief.depth_mm[b]) std::swap(a, b);
    const auto step = static_cast<double>(relief.depth_mm[b] - relief.depth_mm[a]);
    if (step < kStepMm || step > kMostStepMm) return;
    Piece* front = named(relief.surface[a]);
    const Piece* behind = named(relief.surface[b]);
    if (front != nullptr && behind != nullptr)
      ++front->before[static_cast<std::size_t>(behind - piece.data())];
  }
  bool of_face(const Piece& p) const {
    return p.pixels > kLeastBehind * all && std::abs(p.sum_x) < kAside * p.pixels &&
           p.sum_y < kBelow * p.pixels;
  }
};

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

double covered_share(const Relief& relief, const HeadHint& hint) {
  if (!(hint.width_px > 4) || !std::isfinite(hint.centre_px.x + hint.centre_px.y + hint.width_px)) return 0;
  Face face{relief, hint};
  const int x0 = static_cast<int>(hint.centre_px.x - kHalfWidth * hint.width_px),
            x1 = static_cast<int>(hint.centre_px.x + kHalfWidth * hint.width_px);
  const int y0 = static_cast<int>(hint.centre_px.y - kUp * hint.width_px),
            y1 = static_cast<int>(hint.centre_px.y + kDown * hint.width_px);
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x)
      if (face.inside(x, y)) face.count(x, y);
  for (int y = y0; y <= y1; ++y) face.walk(x0, y, 1, 0, x1 - x0 + 1);
  for (int x = x0; x <= x1; ++x) face.walk(x, y0, 0, 1, y1 - y0 + 1);
  const double least_px = kLeastMeetingMm / 150 * hint.width_px;
  int covered = 0;
  for (const Piece& front : face.piece) {
    if (front.pixels < kLeastFront * face.all) continue;
    bool before = false;
    for (std::size_t i = 0; i < kSurfaces; ++i)
      before |= front.before[i] >= least_px && face.of_face(face.piece[i]);
    covered += before ? front.pixels : 0;
  }
  return face.all > 0 ? static_cast<double>(covered) / face.all : 0;
}

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
