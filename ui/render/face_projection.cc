// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/render/face_projection.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ui/render/face_geometry.h"

namespace relievo::ui {
namespace {

using pipeline::Vec3d;

// A face turns about the tip of its nose, a head, which is deeper, about its middle, and is seen whole.
constexpr float kHeadDepthMm = 130, kHeadShare = 0.8F;
constexpr float kNearMm = 200, kFarMm = 1200;

Vec3d minus(const Vec3d& a, const Vec3d& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec3d cross(const Vec3d& a, const Vec3d& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
double dot(const Vec3d& a, const Vec3d& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

// How far along the ray a triangle is met (Moeller and Trumbore, 1997); infinite: not at all.
double met(const Vec3d& from, const Vec3d& along, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const Vec3d ab = minus(b, a), ac = minus(c, a), p = cross(along, ac);
  const double det = dot(ab, p);
  if (std::abs(det) < 1e-12) return kNever;
  const Vec3d s = minus(from, a), q = cross(s, ab);
  const double u = dot(s, p) / det, v = dot(along, q) / det, t = dot(ac, q) / det;
  return u < 0 || v < 0 || u + v > 1 || t <= 0 ? kNever : t;
}

}  // namespace

FaceStand stand_of(const pipeline::FaceModel& model) {
  constexpr float kEnd = std::numeric_limits<float>::max();
  float low = kEnd, high = -kEnd, back = kEnd, front = -kEnd;
  for (const auto& triangle : model.mesh.triangles)
    for (const std::uint32_t at : triangle) {
      const Dot d = dot_of(model.head_from_camera, model.mesh.vertices_mm[at]);
      low = std::min(low, d.y), high = std::max(high, d.y);
      back = std::min(back, d.z), front = std::max(front, d.z);
    }
  if (low > high) return {};
  FaceStand stand{(low + high) / 2, 0, 1};
  if (front - back <= kHeadDepthMm) return stand;
  stand.axis_mm = (back + front) / 2;
  stand.fit = std::min(1.0F, kHeadShare * kSeenHeightMm / (high - low));
  return stand;
}

// First about the upright axis, then about the level one.
FaceProjection::FaceProjection(const FaceStand& stand, const FaceLook& look, float aspect, float covered)
    : scale_(2 * kFaceDistanceMm / kSeenHeightMm * look.zoom * stand.fit),
      aspect_(aspect),
      covered_(covered) {
  const float cy = std::cos(radians(look.yaw_deg)), sy = std::sin(radians(look.yaw_deg));
  const float cp = std::cos(radians(look.pitch_deg)), sp = std::sin(radians(look.pitch_deg));
  const float from[] = {cy, sp * sy, -cp * sy, 0, cp, sp, sy, -sp * cy, cp * cy};
  std::copy(std::begin(from), std::end(from), turned_);
  const float cr = std::cos(radians(look.roll_deg)), sr = std::sin(radians(look.roll_deg));
  for (std::size_t c = 0; c < 9; c += 3) {
    const float across = turned_[c], up = turned_[c + 1];
    turned_[c] = cr * across + sr * up;
    turned_[c + 1] = cr * up - sr * across;
  }
  // What turning about the axis moves the origin by; the middle of the model is the window's.
  shift_[0] = -stand.axis_mm * turned_[6];
  shift_[1] = -stand.axis_mm * turned_[7] - stand.middle_mm;
  shift_[2] = stand.axis_mm * (1 - turned_[8]);
  const float f = scale_, a = (kFarMm + kNearMm) / (kNearMm - kFarMm),
              b = 2 * kFarMm * kNearMm / (kNearMm - kFarMm);
  for (std::size_t c = 0; c < 3; ++c) {
    clip_[4 * c] = f / aspect * turned_[3 * c];
    clip_[4 * c + 1] = f * turned_[3 * c + 1];
    clip_[4 * c + 2] = a * turned_[3 * c + 2];
    clip_[4 * c + 3] = -turned_[3 * c + 2];
  }
  clip_[12] = f / aspect * shift_[0];
  clip_[13] = f * shift_[1];
  clip_[14] = a * (shift_[2] - kFaceDistanceMm) + b;
  clip_[15] = kFaceDistanceMm - shift_[2];
  for (std::size_t c = 0; c < 4; ++c)
    clip_[4 * c + 1] += covered_ * clip_[4 * c + 3];  // half the window is 1
}

pipeline::Vec2f FaceProjection::seen(const pipeline::Vec3f& at) const {
  float out[4];
  for (std::size_t r = 0; r < 4; ++r)
    out[r] = clip_[r] * at.x + clip_[4 + r] * at.y + clip_[8 + r] * at.z + clip_[12 + r];
  return {(1 + out[0] / out[3]) / 2, (1 - out[1] / out[3]) / 2};
}

std::optional<pipeline::Vec3f> FaceProjection::touched(const pipeline::FaceModel& model,
                                                       pipeline::Vec2f window) const {
  const auto turned_back = [this](const Vec3d& v) {
    const auto of = [&](std::size_t i) {
      return double(turned_[3 * i]) * v.x + double(turned_[3 * i + 1]) * v.y +
             double(turned_[3 * i + 2]) * v.z;
    };
    return Vec3d{of(0), of(1), of(2)};
  };
  const double across = double((2 * window.x - 1) * aspect_ / scale_),
               up = double((1 - 2 * window.y - covered_) / scale_);
  const Vec3d from =
                  turned_back({-double(shift_[0]), -double(shift_[1]), double(kFaceDistanceMm - shift_[2])}),
              along = turned_back({across, up, -1});
  const auto corner = [&](std::uint32_t at) {
    const Dot d = dot_of(model.head_from_camera, model.mesh.vertices_mm[at]);
    return Vec3d{double(d.x), double(d.y), double(d.z)};
  };
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& t : model.mesh.triangles)
    nearest = std::min(nearest, met(from, along, corner(t[0]), corner(t[1]), corner(t[2])));
  if (std::isinf(nearest)) return std::nullopt;
  return pipeline::Vec3f{float(from.x + nearest * along.x), float(from.y + nearest * along.y),
                         float(from.z + nearest * along.z)};
}

}  // namespace relievo::ui
