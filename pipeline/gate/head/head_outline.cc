// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/gate/head/head_outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace relievo::pipeline {
namespace {

constexpr double kFaceWidthMm = 150, kHeadMm = 200;  // from the crown to the chin
constexpr double kForeheadMm = 70;                   // from the crown: below it the face begins
constexpr double kBrowsMm = 75, kMouthMm = 25;       // from the tip of the nose
constexpr double kAsideMm = 170, kBehindMm = 150;    // of the tip: the head and its hair
constexpr double kBeforeMm = 40;                     // of the tip: brow, chin
constexpr double kNoseBeforeAxisMm = 105;
constexpr double kForemostShare = 0.05;  // specks are fewer

// Counts by millimetres, to say below which a share of them lies.
class Histogram {
 public:
  explicit Histogram(double from_mm) : from_mm_(from_mm) {}
  void add(double mm) {
    const auto bin = std::ptrdiff_t((mm - from_mm_) / kBinMm);
    ++count_[std::size_t(std::clamp<std::ptrdiff_t>(bin, 0, kBins - 1))];
    ++all_;
  }
  double below(double share) const {
    int seen = 0;
    for (std::size_t i = 0; i < kBins; ++i)
      if ((seen += count_[i]) > share * all_) return from_mm_ + (double(i) + 0.5) * kBinMm;
    return from_mm_;
  }
  int all() const { return all_; }

 private:
  static constexpr double kBinMm = 8;
  static constexpr std::ptrdiff_t kBins = 256;
  double from_mm_;
  std::array<int, kBins> count_{};
  int all_ = 0;
};

struct Rows {
  int from, to;  // not with it
};

// Of what is so near, its foremost place in each row: the line of brow, nose, lips and chin.
HeadHint head_in(const Relief& relief, const Rows& rows, double reach_mm, bool crown_seen) {
  Histogram depth(0);
  for (int y = rows.from; y < rows.to; ++y)
    for (int x = 0; x < relief.width_px; ++x)
      if (relief.known(x, y) && double(relief.depth_mm[relief.index(x, y)]) < reach_mm)
        depth.add(double(relief.depth_mm[relief.index(x, y)]));
  if (depth.all() == 0) return {};
  const double near = depth.below(kForemostShare), per_mm = relief.focal_px / near;
  const Rows face{crown_seen ? rows.from + int(kForeheadMm * per_mm) : rows.from,
                  crown_seen ? std::min(rows.to, rows.from + int(kHeadMm * per_mm)) : rows.to};
  const auto of_head = [&](int x, int y) {
    return relief.known(x, y) && double(relief.depth_mm[relief.index(x, y)]) < near + kBehindMm;
  };
  Histogram aside(-1024);
  for (int y = face.from; y < face.to; ++y)
    for (int x = 0; x < relief.width_px; ++x)
      if (of_head(x, y)) aside.add(relief.point(x, y).x);
  if (aside.all() == 0) return {};
  const double middle = aside.below(0.5);
  double sum = 0;
  int seen = 0;
  for (int y = face.from; y < face.to; ++y) {
    double foremost = 1e9, at = 0;
    for (int x = 0; x < relief.width_px; ++x) {
      if (!of_head(x, y)) continue;
      const Vec3d p = relief.point(x, y);
      if (std::abs(p.x - middle) < kFaceWidthMm / 2 && p.z < foremost) foremost = p.z, at = x;
    }
    if (foremost < 1e9) sum += at, ++seen;
  }
  if (seen == 0) return {};
  return {{sum / seen, 0.5 * (face.from + face.to)}, kFaceWidthMm * per_mm};
}

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
    const auto step = double(relief.depth_mm[b] - relief.depth_mm[a]);
    if (step < kStepMm || step > kMostStepMm) return;
    Piece* front = named(relief.surface[a]);
    const Piece* behind = named(relief.surface[b]);
    if (front != nullptr && behind != nullptr) ++front->before[std::size_t(behind - piece.data())];
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
  return {int(std::ceil(a.x)), int(std::floor(b.x)), int(std::ceil(a.y)), int(std::floor(b.y))};
}

Field within(const Relief& relief, const Field& f) {
  return {std::max(f.x0, 0), std::min(f.x1, relief.width_px - 1), std::max(f.y0, 0),
          std::min(f.y1, relief.height_px - 1)};
}

bool level_with(const Vec3d& tip, float depth_mm) {
  const double z = double(depth_mm);
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

// The middle of all that is near says on which side somebody stands; its upper end whether they are too low,
// the neck whether they are too high. That it reaches the upper edge says nothing: most heads do.
Somebody find_somebody(const Relief& relief, double farthest_mm) {
  constexpr double kReach = 1.2, kLeastShare = 0.03, kClearly = 0.12, kNeckOfHead = 0.72, kHighNeck = 0.6,
                   kUsualNeck = 0.85;
  const int w = relief.width_px, h = relief.height_px;
  double count = 0, right = 0;
  int top = h, neck = h, widest = 0;
  for (int y = 0; y < h; ++y) {
    int in_row = 0;
    for (int x = 0; x < w; ++x) {
      if (!relief.known(x, y) || double(relief.depth_mm[relief.index(x, y)]) > kReach * farthest_mm) continue;
      ++in_row;
      right += x;
    }
    count += in_row;
    if (top == h && in_row > w / 12) top = y;
    widest = std::max(widest, in_row);
    if (neck == h && widest > w / 6 && in_row < kNeckOfHead * widest) neck = y;
  }
  Somebody somebody;
  if (count < kLeastShare * w * h) return somebody;
  const double off = right / count / w - 0.5, low = double(top) / h - 0.5;
  if (std::abs(off) > kClearly) somebody.right = off;
  if (low > 0) somebody.down = low + kClearly;
  else if (neck < kHighNeck * h) somebody.down = double(neck) / h - kUsualNeck;
  somebody.head = head_in(relief, {top, neck}, kReach * farthest_mm, top > 2);
  return somebody;
}

double outline_yaw_deg(const Relief& relief, const Vec3d& tip_mm) {
  const Vec2d above = relief.pixel({tip_mm.x, tip_mm.y - kBrowsMm, tip_mm.z}),
              below = relief.pixel({tip_mm.x, tip_mm.y + kMouthMm, tip_mm.z});
  double sum = 0;
  int count = 0;
  for (int y = std::max(0, int(above.y)); y <= std::min(relief.height_px - 1, int(below.y)); ++y)
    for (int x = 0; x < relief.width_px; ++x) {
      if (!relief.known(x, y)) continue;
      const Vec3d p = relief.point(x, y);
      if (p.z < tip_mm.z - kBeforeMm || p.z > tip_mm.z + kBehindMm || std::abs(p.x - tip_mm.x) > kAsideMm)
        continue;
      sum += p.x, ++count;
    }
  if (count == 0) return 0;
  const double sine = std::clamp((tip_mm.x - sum / count) / kNoseBeforeAxisMm, -0.9, 0.9);
  return std::asin(sine) * 180 / std::numbers::pi;
}

double covered_share(const Relief& relief, const HeadHint& hint) {
  if (!(hint.width_px > 4) || !std::isfinite(hint.centre_px.x + hint.centre_px.y + hint.width_px)) return 0;
  Face face{relief, hint};
  const int x0 = int(hint.centre_px.x - kHalfWidth * hint.width_px),
            x1 = int(hint.centre_px.x + kHalfWidth * hint.width_px);
  const int y0 = int(hint.centre_px.y - kUp * hint.width_px),
            y1 = int(hint.centre_px.y + kDown * hint.width_px);
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
  return face.all > 0 ? double(covered) / face.all : 0;
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
