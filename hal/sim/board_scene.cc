// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/sim/board_scene.h"

#include <algorithm>
#include <cmath>

#include "hal/sim/base/noise.h"
#include "hal/sim/optics/ray_caster.h"

namespace relievo::hal::sim {
namespace {

constexpr int kMostMarkers = 1000;  // of a dictionary
constexpr std::int64_t kCellsASquare = 128;

int marker_count(const BoardPattern& b) { return (b.corners_x + 1) * (b.corners_y + 1) / 2; }

bool seen_whole(const SimView& view, const BoardPattern& b, const BodyPose& pose) {
  for (const double x : {-1.0, double(b.corners_x)})
    for (const double y : {-1.0, double(b.corners_y)}) {
      const Vec3 p = pose.to_world({x * b.square_mm, y * b.square_mm, 0});
      if (view.depth_mm(p) < 50) return false;
      const Pixel q = view.project(p);
      if (q.x < 6 || q.y < 6 || q.x > view.width_px - 7 || q.y > view.height_px - 7) return false;
    }
  return true;
}

constexpr double kWhite = 0.62, kBlack = 0.035, kRoom = 0.10, kHand = 0.33;
constexpr int kSamples = 128;  // of a pixel that sees an edge
constexpr double kGolden = 0.6180339887498949;

Vec3 across(Vec3 direction) { return normalised(Vec3{direction.z, 0, -direction.x}); }

}  // namespace

Result<void> BoardPattern::check() const {
  if (corners_x < 3 || corners_y < 3 || corners_x > 60 || corners_y > 60)
    return invalid("a board has between 3 and 60 inner corners a side");
  if (!(square_mm >= 1) || !(square_mm <= 500))
    return invalid("the squares of a board measure between 1 and 500 mm");
  if (kind == BoardKind::Chessboard) return {};
  if (!(marker_side_mm() >= 0.3 * square_mm) || !(marker_side_mm() <= 0.9 * square_mm))
    return invalid("a marker measures between 0.3 and 0.9 of its square");
  if (marker_bits < 4 || marker_bits > 7) return invalid("a marker has between 4 and 7 bits a side");
  if (marker_count(*this) > kMostMarkers)
    return invalid("a ChArUco board has at most 1000 markers; choose fewer corners");
  return {};
}

BoardPrint::BoardPrint(const BoardPattern& pattern) : pattern_(pattern) {
  if (pattern.kind == BoardKind::Chessboard) return;
  modules_ = pattern.marker_bits + 2;
  markers_ = marker_modules(pattern.marker_bits, marker_count(pattern));
}

BoardPrint::Spot BoardPrint::at(double x_mm, double y_mm) const {
  const double sx = x_mm / pattern_.square_mm + 1,
               sy = y_mm / pattern_.square_mm + 1;  // from the top left of the print
  const int across = pattern_.corners_x + 1, down = pattern_.corners_y + 1;
  if (!(sx >= 0 && sy >= 0 && sx < across && sy < down)) return {false, -1};
  const int column = int(sx), row = int(sy);
  const std::int64_t cell = (std::int64_t(row) * across + column) * kCellsASquare;
  if ((column + row) % 2 == 0) return {true, cell};
  if (pattern_.kind == BoardKind::Chessboard) return {false, cell};
  const double side = pattern_.marker_side_mm() / pattern_.square_mm / modules_;
  const double low = 0.5 - 0.5 * modules_ * side;
  const int u = std::clamp(int(std::floor((sx - column - low) / side)), -1, modules_);
  const int v = std::clamp(int(std::floor((sy - row - low) / side)), -1, modules_);
  const auto spot = [&](bool dark) { return Spot{dark, cell + (v + 1) * (modules_ + 2) + u + 1}; };
  if (u < 0 || v < 0 || u == modules_ || v == modules_) return spot(false);
  if (u == 0 || v == 0 || u == modules_ - 1 || v == modules_ - 1) return spot(true);
  // Numbers run over the white squares, row by row.
  const int id = (row * across + column) / 2, bit = (v - 1) * (modules_ - 2) + u - 1;
  return spot((markers_[std::size_t(id)] >> bit & 1) == 0);
}

BodyPose with_middle_at(Vec3 middle_mm, const Mat3& world_from_body, const BoardPattern& b) {
  const Vec3 middle{(b.corners_x - 1) * b.square_mm / 2, (b.corners_y - 1) * b.square_mm / 2, 0};
  return {world_from_body, middle_mm - world_from_body * middle};
}

Result<std::vector<BodyPose>> good_board_poses(const SimRig& rig, const BoardPattern& b, int count,
                                               std::uint32_t seed, double distance_mm) {
  RELIEVO_TRY(b.check());
  Random random(seed + 0xb0a4dULL);
  std::vector<BodyPose> poses;
  const Vec3 aim = rig.left.ray((rig.left.width_px - 1) / 2.0, (rig.left.height_px - 1) / 2.0);
  for (int tries = 0; int(poses.size()) < count && tries < 20000; ++tries) {
    const auto k = int(poses.size());
    // Tilts go round the compass, so that no direction is left out by chance.
    const double compass = 6.283185307 * k / std::max(count, 1) * 3 + random.uniform(-0.3, 0.3),
                 tilt = k == 0 ? 0.03 : random.uniform(0.25, 0.6);
    const double spread = 1.0 - 0.9 * std::min(1.0, tries / 15000.0);
    const Mat3 turn =
        rotation(tilt * std::sin(compass), tilt * std::cos(compass), random.uniform(-0.35, 0.35));
    const Vec3 centre = aim * (distance_mm + random.uniform(-60, 110) + 4e-3 * tries) +
                        Vec3{random.uniform(-70, 70), random.uniform(-42, 42), 0} * spread;
    const BodyPose pose = with_middle_at(centre, turn, b);
    if (seen_whole(rig.left, b, pose) && seen_whole(rig.right, b, pose)) poses.push_back(pose);
  }
  if (int(poses.size()) < count)
    return Error{Errc::PoorGeometry,
                 "this rig does not see the whole board; choose fewer or smaller squares"};
  return poses;
}

Result<void> BoardLook::check() const {
  for (const double share : {lamp, shadow, cover})
    if (!(share >= 0) || !(share <= 0.98)) return invalid("lamp, shadow and cover are shares from 0 to 0.98");
  if (!(highlight >= 0) || !(highlight <= 20))
    return invalid("a highlight is 0 to 20 times as bright as paper");
  return {};
}

BoardScene::BoardScene(const BoardPattern& pattern, const BodyPose& pose, const BoardLook& look,
                       double pixel_rad)
    : pattern_(pattern), print_(pattern), pose_(pose), look_(look), pixel_rad_(pixel_rad) {}

bool BoardScene::meet(Vec3 origin, Vec3 direction, Hit& hit) const {
  const Vec3 o = pose_.to_body(origin), d = pose_.world_from_body.transposed() * direction;
  if (std::abs(d.z) < 1e-9) return false;
  hit.distance = -o.z / d.z;
  hit.x = o.x + hit.distance * d.x;
  hit.y = o.y + hit.distance * d.y;
  return hit.distance > 0 && pattern_.covers(hit.x, hit.y);
}

// A round hand that comes from the right, a third of the board high.
bool BoardScene::covered(const Hit& hit) const {
  if (look_.cover <= 0) return false;
  const double w = (pattern_.corners_x + 1) * pattern_.square_mm,
               h = (pattern_.corners_y + 1) * pattern_.square_mm;
  const double radius = h / 3, reach = pattern_.corners_x * pattern_.square_mm - look_.cover * w + radius;
  const double y = hit.y - 0.3 * pattern_.corners_y * pattern_.square_mm, x = std::min(hit.x - reach, 0.0);
  return x * x + y * y < radius * radius;
}

double BoardScene::light(Vec3 origin, Vec3 direction, const Hit& hit) const {
  const double w = (pattern_.corners_x + 1) * pattern_.square_mm,
               h = (pattern_.corners_y + 1) * pattern_.square_mm;
  const double u = hit.x / w, v = hit.y / h;
  const Vec3 p = origin + direction * hit.distance;
  double lit = 0.55 + 0.45 * std::abs(dot(pose_.normal(), normalised(p - Vec3{-200, -200, 0})));
  lit *= 1 - look_.lamp * clamp01(u);
  // The shadow's rim is a few millimetres wide.
  lit *= 1 - look_.shadow * smoothstep(0.66, 0.68, u + 0.35 * (v - 0.5));
  return lit * (1 + 0.01 * value_noise(p * 0.02, 5));
}

double BoardScene::dark_share(Vec3 origin, Vec3 direction, const Hit& hit) const {
  const BoardPrint::Spot middle = print_.at(hit.x, hit.y);
  if (pixel_rad_ <= 0) return middle.dark ? 1 : 0;
  const Vec3 right = across(direction) * pixel_rad_, down = cross(direction, across(direction)) * pixel_rad_;
  const auto spot = [&](double u, double v) {
    Hit at;
    return meet(origin, direction + right * u + down * v, at) ? print_.at(at.x, at.y)
                                                              : BoardPrint::Spot{false, -1};
  };
  bool even = true;
  for (int k = 0; k < 4 && even; ++k) even = spot(k % 2 - 0.5, k / 2 - 0.5).cell == middle.cell;
  if (even) return middle.dark ? 1 : 0;
  int dark = 0;
  // In pairs across the middle: no direction is favoured.
  for (int k = 0; k < kSamples / 2; ++k) {
    const double u = (k + 0.5) / kSamples, v = k * kGolden - std::floor(k * kGolden) - 0.5;
    dark += (spot(u, v).dark ? 1 : 0) + (spot(-u, -v).dark ? 1 : 0);
  }
  return double(dark) / kSamples;
}

RayHit BoardScene::look(Vec3 origin, Vec3 direction) const {
  Hit hit;
  if (!meet(origin, direction, hit)) return {{kRoom, kRoom, kRoom}, RayCaster::kFar, -1, false};
  const double lit = light(origin, direction, hit);
  if (covered(hit)) return {{kHand * lit, kHand * lit, kHand * lit}, hit.distance, 3, false};
  const double dark = dark_share(origin, direction, hit);
  const double x = hit.x / pattern_.square_mm - 0.4 * pattern_.corners_x,
               y = hit.y / pattern_.square_mm - 0.4 * pattern_.corners_y;
  const double v =
      mix(kWhite, kBlack, dark) * lit + look_.highlight * kWhite * gauss(std::sqrt(x * x + y * y) / 0.7);
  const std::int32_t body = pixel_rad_ > 0 ? 0 : dark > 0.5 ? 1 : 2;
  return {{v, v, v}, hit.distance, body, false};
}

}  // namespace relievo::hal::sim
