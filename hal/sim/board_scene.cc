// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/sim/board_scene.h"

#include "hal/sim/base/noise.h"
#include "hal/sim/optics/ray_caster.h"

namespace relievo::hal::sim {
namespace {

constexpr double kWhite = 0.62, kBlack = 0.035, kRoom = 0.10, kHand = 0.33;
constexpr int kSamples = 128;  // of a pixel that sees an edge
constexpr double kGolden = 0.6180339887498949;

Vec3 across(Vec3 direction) { return normalised(Vec3{direction.z, 0, -direction.x}); }

}  // namespace

Result<void> BoardLook::check() const {
  for (const double share : {lamp, shadow, cover})
    if (!(share >= 0) || !(share <= 0.98))
      return Error{Errc::InvalidInput, "lamp, shadow and cover are shares from 0 to 0.98"};
  if (!(highlight >= 0) || !(highlight <= 20))
    return Error{Errc::InvalidInput, "a highlight is 0 to 20 times as bright as paper"};
  return {};
}

BoardScene::BoardScene(const BoardPattern& pattern, const BoardPose& pose, const BoardLook& look,
                       double pixel_rad)
    : pattern_(pattern), print_(pattern), pose_(pose), look_(look), pixel_rad_(pixel_rad) {}

bool BoardScene::meet(Vec3 origin, Vec3 direction, Hit& hit) const {
  const Mat3 board_from_world = pose_.world_from_board.transposed();
  const Vec3 o = board_from_world * (origin - pose_.origin_mm), d = board_from_world * direction;
  if (std::abs(d.z) < 1e-9) return false;
  hit.distance = -o.z / d.z;
  hit.x = o.x + hit.distance * d.x;
  hit.y = o.y + hit.distance * d.y;
  const double low = -pattern_.square_mm - pattern_.margin_mm;
  return hit.distance > 0 && hit.x > low && hit.y > low &&
         hit.x < pattern_.corners_x * pattern_.square_mm + pattern_.margin_mm &&
         hit.y < pattern_.corners_y * pattern_.square_mm + pattern_.margin_mm;
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
  const Vec3 normal{pose_.world_from_board.row[0].z, pose_.world_from_board.row[1].z,
                    pose_.world_from_board.row[2].z};
  double lit = 0.55 + 0.45 * std::abs(dot(normal, normalised(p - Vec3{-200, -200, 0})));
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
  return static_cast<double>(dark) / kSamples;
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

bool BoardScene::solid(Vec3 origin, Vec3 direction, SolidPoint& out) const {
  Hit hit;
  if (!meet(origin, direction, hit)) return false;
  out.point = origin + direction * hit.distance;
  out.normal = pose_.world_from_board * Vec3{0, 0, -1};
  out.skin = false;
  return true;
}

Mesh BoardScene::solid_mesh() const {
  const double low = -pattern_.square_mm - pattern_.margin_mm;
  const double right = pattern_.corners_x * pattern_.square_mm + pattern_.margin_mm,
               bottom = pattern_.corners_y * pattern_.square_mm + pattern_.margin_mm;
  Mesh mesh;
  for (const Vec3 p : {Vec3{low, low, 0}, {right, low, 0}, {right, bottom, 0}, {low, bottom, 0}}) {
    const Vec3 q = pose_.to_world(p);
    mesh.points.push_back({static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z)});
  }
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

}  // namespace relievo::hal::sim
