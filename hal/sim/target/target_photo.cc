// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/sim/target/target_photo.h"

#include <array>

#include "hal/sim/base/noise.h"

namespace relievo::hal::sim {
namespace {

constexpr double kPaper = 0.72, kInk = 0.07;

// 1 inside a dot. Each cell holds a ball of ink whose size its own hash says.
double dots(Vec3 p_mm, double cell_mm, std::uint32_t seed) {
  const NearestDot near = nearest_dot(p_mm * (1 / cell_mm), seed);
  const double radius = 0.24 + 0.22 * unit_from_hash(near.hash * 747796405U + 1);
  const double soft = 0.12 / cell_mm;  // sprayed ink has soft edges
  return 1 - smoothstep(radius - soft, radius + soft, near.distance);
}

struct Lamp {
  Vec3 centre_mm;
  double power = 0;
};
constexpr std::array<Lamp, 2> kLamps{Lamp{{-330, -190, 40}, 0.62}, Lamp{{470, -200, 60}, 0.46}};
constexpr double kReferenceMm = 640;  // where a lamp's power is what it says

// How bright a matt surface stands there in world, times reflectance: two soft panels beside the cameras and
// the room's own light.
double matt_light(Vec3 p, Vec3 normal) {
  double light = 0.16 + 0.05 * -normal.y;  // the room, a little more of it from above
  for (const Lamp& lamp : kLamps) {
    const Vec3 to = lamp.centre_mm - p;
    const double d = length(to);
    // A lamp a quarter of a metre wide sets gently: the terminator is soft.
    const double lit = std::max(0.0, (dot(normal, to) / d + 0.15) / 1.15);
    light += lamp.power * lit * (kReferenceMm / d) * (kReferenceMm / d);
  }
  return light;
}

enum Body : std::int32_t { kSphere, kRod, kPlate };
constexpr double kNone = RayCaster::kFar;

// The nearer meeting of a ray with a sphere; d has unit length.
double meet_sphere(Vec3 o, Vec3 d, Vec3 centre, double radius) {
  const Vec3 to = o - centre;
  const double b = dot(to, d), c = dot(to, to) - radius * radius, root = b * b - c;
  if (root < 0) return kNone;
  const double t = -b - std::sqrt(root);
  return t > 1e-6 ? t : kNone;
}

// With the mantle of a cylinder along x from -half to half.
double meet_rod(Vec3 o, Vec3 d, double half, double radius) {
  const double a = d.y * d.y + d.z * d.z, b = o.y * d.y + o.z * d.z,
               c = o.y * o.y + o.z * o.z - radius * radius;
  const double root = b * b - a * c;
  if (a < 1e-12 || root < 0) return kNone;
  const double t = (-b - std::sqrt(root)) / a;
  return t > 1e-6 && std::abs(o.x + t * d.x) < half ? t : kNone;
}

Vec3 grey(double v) { return {v, v, v * 0.98}; }

const Error kCut{
    Errc::PoorGeometry,
    "the simulated rig does not see the whole target: put it nearer to the middle, or further away"};

bool seen(const SimView& view, Vec3 p, double reach_mm) {
  const double depth = view.depth_mm(p);
  if (depth < 50) return false;
  const Pixel q = view.project(p);
  const double edge = 4 + view.fx_px * reach_mm / depth;
  return q.x > edge && q.y > edge && q.x < view.width_px - 1 - edge && q.y < view.height_px - 1 - edge;
}

bool seen(const SimRig& rig, Vec3 p, double reach_mm) {
  return seen(rig.left, p, reach_mm) && seen(rig.right, p, reach_mm);
}

PicturePair take(const Scene& scene, const SimRig& rig, const TargetPhotoOptions& options,
                 std::uint64_t noise) {
  ThreadPool pool(options.threads);
  return render_pair(scene, rig, options.sensor, options.seed * 100000ULL + noise, pool);
}

// Two places never share their noise.
std::uint64_t noise_of(const ArtefactPlace& p) {
  std::uint64_t h = 1;
  for (const double v : {p.right_mm, p.down_mm, p.distance_mm, p.pitch_deg, p.yaw_deg, p.roll_deg})
    h = h * 1000003 + std::uint64_t(std::llround(v * 100) + 100'000'000);
  return 1000 + h % 90000;
}

}  // namespace

double speckle(Vec3 p, std::uint32_t seed) {
  const double ink = std::max({dots(p, 0.9, seed), dots(p, 1.4, seed + 57), dots(p, 4.1, seed + 101)});
  return mix(kPaper, kInk, ink) * (1 + 0.06 * value_noise(p * 0.09, seed + 7));
}

Result<void> Dumbbell::check() const {
  if (!(diameter_mm >= 10) || !(diameter_mm <= 200) || !(spacing_mm > diameter_mm) || !(spacing_mm <= 500) ||
      !(rod_radius_mm > 0) || !(rod_radius_mm < diameter_mm / 4))
    return invalid(
        "a dumbbell has spheres of 10 to 200 mm, further apart than that, up to 500 mm, on a rod "
        "thinner than half of one");
  return {};
}

Result<void> FlatPlate::check() const {
  if (!(width_mm >= 20) || !(height_mm >= 20) || !(width_mm <= 1000) || !(height_mm <= 1000))
    return invalid("a plate measures between 20 and 1000 mm a side");
  return {};
}

Vec3 DumbbellScene::centre_mm(int sphere) const {
  return pose_.to_world({(sphere == 0 ? -0.5 : 0.5) * dumbbell_.spacing_mm, 0, 0});
}

ArtefactScene::Met ArtefactScene::met_from(Vec3 origin, Vec3 direction) const {
  return meet(pose_.to_body(origin), pose_.world_from_body.transposed() * direction);
}

RayHit ArtefactScene::look(Vec3 origin, Vec3 direction) const {
  const Vec3 o = pose_.to_body(origin), d = pose_.world_from_body.transposed() * direction;
  const Met met = meet(o, d);
  if (met.distance == kNone) {
    const double dark = 0.03 + 0.006 * value_noise(direction * 6, 99) - 0.015 * direction.y;
    return {{dark, dark * 1.02, dark * 1.05}, kNone, met.body, false};
  }
  const double reflectance = met.printed ? speckle(o + d * met.distance, seed_) : 0.10;
  const double light = matt_light(origin + direction * met.distance, pose_.world_from_body * met.normal);
  // Dots are finer than a sample a pixel could show without aliasing.
  return {grey(reflectance * light), met.distance, met.body, met.printed};
}

bool ArtefactScene::solid(Vec3 origin, Vec3 direction, SolidPoint& out) const {
  const Met met = met_from(origin, direction);
  if (met.distance == kNone) return false;
  out = {origin + direction * met.distance, pose_.world_from_body * met.normal, met.printed};
  return true;
}

bool ArtefactScene::blocked(Vec3 from, Vec3 direction, double far_mm) const {
  return met_from(from, direction).distance < far_mm;
}

DumbbellScene::Met DumbbellScene::meet(Vec3 o, Vec3 d) const {
  const double half = dumbbell_.spacing_mm / 2, radius = dumbbell_.diameter_mm / 2;
  Met met;
  for (const double x : {-half, half})
    if (const double t = meet_sphere(o, d, {x, 0, 0}, radius); t < met.distance)
      met = {t, (o + d * t - Vec3{x, 0, 0}) * (1 / radius), kSphere, true};
  if (const double t = meet_rod(o, d, half, dumbbell_.rod_radius_mm); t < met.distance) {
    const Vec3 p = o + d * t;
    met = {t, Vec3{0, p.y, p.z} * (1 / dumbbell_.rod_radius_mm), kRod, false};
  }
  return met;
}

PlateScene::Met PlateScene::meet(Vec3 o, Vec3 d) const {
  if (std::abs(d.z) < 1e-9) return {};
  const double distance = -o.z / d.z;
  const Vec3 p = o + d * distance;
  if (distance <= 0 || std::abs(p.x) >= plate_.width_mm / 2 || std::abs(p.y) >= plate_.height_mm / 2)
    return {};
  return {distance, {0, 0, d.z > 0 ? -1.0 : 1.0}, kPlate, true};
}

BodyPose ArtefactPlace::pose() const {
  return {rotation(radians(pitch_deg), radians(yaw_deg), radians(roll_deg)),
          {right_mm, down_mm, distance_mm}};
}

Result<PicturePair> photograph_board(const TargetPhotoOptions& options, const BoardPattern& board, int number,
                                     int count) {
  RELIEVO_TRY(options.rig.check());
  const SimRig rig = make_rig(options.rig);
  RELIEVO_TRY_ASSIGN(const auto poses, good_board_poses(rig, board, count, options.seed));
  if (number < 0 || number >= count) return invalid("there is no board of this number in the series");
  TargetPhotoOptions grey = options;
  grey.sensor.grey = true;
  return take(BoardScene(board, poses[std::size_t(number)]), rig, grey, std::uint64_t(number));
}

Result<PicturePair> photograph_dumbbell(const TargetPhotoOptions& options, const Dumbbell& dumbbell,
                                        const ArtefactPlace& place) {
  RELIEVO_TRY(options.rig.check());
  RELIEVO_TRY(dumbbell.check());
  const SimRig rig = make_rig(options.rig);
  const DumbbellScene scene(dumbbell, place.pose());
  for (const int side : {0, 1})
    if (!seen(rig, scene.centre_mm(side), dumbbell.diameter_mm / 2)) return kCut;
  return take(scene, rig, options, noise_of(place));
}

Result<PicturePair> photograph_plate(const TargetPhotoOptions& options, const FlatPlate& plate,
                                     const ArtefactPlace& place) {
  RELIEVO_TRY(options.rig.check());
  RELIEVO_TRY(plate.check());
  const SimRig rig = make_rig(options.rig);
  const BodyPose pose = place.pose();
  for (const double x : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5})
      if (!seen(rig, pose.to_world({x * plate.width_mm, y * plate.height_mm, 0}), 0)) return kCut;
  return take(PlateScene(plate, pose), rig, options, noise_of(place));
}

}  // namespace relievo::hal::sim
