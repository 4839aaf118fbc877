// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "pipeline/fuse/pose_residuals.h"
#include "pipeline/model/photo_sampler.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

constexpr double kMostPixelMm = 0.6;
constexpr double kSurfaceMm = 3;  // between the surfaces: more is other skin
constexpr float kLeastTrust = 0.2F;
constexpr double kSameFacing = 0.7;
constexpr int kHalf = 10, kSide = 2 * kHalf + 1, kPixels = kSide * kSide;
constexpr int kRounds = 12;
constexpr float kStill = 0.05F, kFarthest = 3;  // pixels of the window: of a step, of all
constexpr float kLeastContrast = 0.5F;          // grey levels a pixel, along the direction with the least
constexpr float kLeastAlike = 0.5F;             // normalised cross-correlation

// A window on a surface as a photograph shows it: so small that it is seen as if from far away.
struct Window {
  Vec2f middle, right, up;  // pixels
};

Vec2f project(const HeadPose& pose, const Vec3d& place) {
  const Vec3d p = apply(pose.rectified_from_camera, place);
  return {float(pose.focal_px * p.x / p.z + pose.centre_px.x),
          float(pose.focal_px * p.y / p.z + pose.centre_px.y)};
}

Window window_on(const HeadPose& pose, const Vec3d& place, const Vec3d& right, const Vec3d& up) {
  const Vec2f middle = project(pose, place), r = project(pose, plus(place, right)),
              u = project(pose, plus(place, up));
  return {middle, {r.x - middle.x, r.y - middle.y}, {u.x - middle.x, u.y - middle.y}};
}

class Photograph {
 public:
  explicit Photograph(const HeadPose& pose)
      : rgb_(pose.left_rgb),
        photo_(pose.left_rgb, pose.width_px, pose.height_px),
        width_(float(pose.width_px)),
        height_(float(pose.height_px)) {}

  // False where the window leaves the photograph, as it is rectified.
  template <std::size_t N>
  bool read(const Window& w, const Vec2f& shift, std::array<float, N>& grey) const {
    const int half = int(std::lround(std::sqrt(double(N)))) / 2;
    const auto at = [&](float c, float r) {
      return Vec2f{w.middle.x + c * w.right.x + r * w.up.x, w.middle.y + c * w.right.y + r * w.up.y};
    };
    for (const float c : {-float(half), float(half)})
      for (const float r : {-float(half), float(half)}) {
        const Vec2f p = at(c + shift.x, r + shift.y);
        if (!(p.x >= 1 && p.y >= 1 && p.x < width_ - 2 && p.y < height_ - 2)) return false;
        if (!is_photographed(rgb_, std::size_t(p.y) * std::size_t(width_) + std::size_t(p.x))) return false;
      }
    std::size_t k = 0;
    for (int r = -half; r <= half; ++r)
      for (int c = -half; c <= half; ++c) {
        const Vec2f p = at(float(c) + shift.x, float(r) + shift.y);
        float rgb[3];
        photo_.read(p.x, p.y, rgb);
        grey[k++] = (rgb[0] + rgb[1] + rgb[2]) / 3;
      }
    return true;
  }

 private:
  std::span<const std::uint8_t> rgb_;
  PhotoSampler photo_;
  float width_, height_;
};

// Mean 0; returns the standard deviation.
float centre(std::array<float, kPixels>& grey) {
  float sum = 0, squares = 0;
  for (const float g : grey) sum += g;
  for (float& g : grey) {
    g -= sum / kPixels;
    squares += g * g;
  }
  return std::sqrt(squares / kPixels);
}

// By how many of its steps the window lies elsewhere in the other photograph; starts at `shift`.
std::optional<Vec2f> track(const Photograph& from, const Window& there, const Photograph& to,
                           const Window& here, Vec2f shift) {
  constexpr int kWide = kSide + 2;
  std::array<float, kWide * kWide> wide{};
  if (!from.read(there, {}, wide)) return std::nullopt;
  std::array<float, kPixels> sought{}, across{}, upwards{}, seen{};
  float xx = 1e-6F, xy = 0, yy = 1e-6F;
  for (int r = 0, k = 0; r < kSide; ++r)
    for (int c = 0; c < kSide; ++c, ++k) {
      const float* at = &wide[std::size_t((r + 1) * kWide + c + 1)];
      const auto i = std::size_t(k);
      sought[i] = *at;
      across[i] = (at[1] - at[-1]) / 2;
      upwards[i] = (at[kWide] - at[-kWide]) / 2;
      xx += across[i] * across[i];
      xy += across[i] * upwards[i];
      yy += upwards[i] * upwards[i];
    }
  const float least = (xx + yy) / 2 - std::hypot((xx - yy) / 2, xy);
  if (least < kPixels * kLeastContrast * kLeastContrast) return std::nullopt;
  const float contrast = centre(sought), det = xx * yy - xy * xy;
  const Vec2f start = shift;
  for (int round = 0; round < kRounds; ++round) {
    if (!to.read(here, shift, seen)) return std::nullopt;
    const float gain = contrast / std::max(centre(seen), 1e-3F);
    float x = 0, y = 0, alike = 0;
    for (std::size_t k = 0; k < seen.size(); ++k) {
      const float off = gain * seen[k] - sought[k];
      x += across[k] * off;
      y += upwards[k] * off;
      alike += gain * seen[k] * sought[k];
    }
    const Vec2f step{-(yy * x - xy * y) / det, -(xx * y - xy * x) / det};
    shift = {shift.x + step.x, shift.y + step.y};
    if (std::hypot(shift.x - start.x, shift.y - start.y) > kFarthest) return std::nullopt;
    if (std::hypot(step.x, step.y) > kStill) continue;
    if (alike < kLeastAlike * kPixels * contrast * contrast) return std::nullopt;
    return shift;
  }
  return std::nullopt;
}

}  // namespace

bool shows_skin(const HeadPose& pose, const Vec3d& place) {
  return !pose.left_rgb.empty() && length(place) < kMostPixelMm * pose.focal_px;
}

std::optional<Vec3d> same_skin(const HeadPose& pose, const Vec3d& place, const std::array<Vec3d, 2>& along,
                               const HeadPose& other, const RigidTransform& other_from_pose) {
  const Vec3d guess = apply(other_from_pose, place);
  const auto hit = other.look(narrow(guess));
  if (!hit || hit->trust < kLeastTrust || !shows_skin(other, guess)) return std::nullopt;
  const Vec3d at = wide(hit->at_mm), normal = wide(hit->normal);
  const Vec3d seen_normal = apply(other_from_pose.rotation, cross(along[0], along[1]));
  if (std::abs(dot(seen_normal, normal)) < kSameFacing) return std::nullopt;
  if (std::abs(dot(normal, minus(guess, at))) > kSurfaceMm) return std::nullopt;
  // On the other surface, beside where the place would be: not where the line of sight to it ends.
  const Vec3d beside = minus(guess, times(normal, dot(normal, minus(guess, at))));
  const Photograph from(pose), to(other);
  Vec2f shift{};
  const double pixel_mm = place.z / pose.focal_px;
  double step_mm = 0;
  for (const double pixels : {3.0, 1.5}) {
    if (step_mm > 0) shift = {2 * shift.x, 2 * shift.y};
    step_mm = pixels * pixel_mm;
    const Vec3d right = times(along[0], step_mm), up = times(along[1], step_mm);
    const auto found = track(
        from, window_on(pose, place, right, up), to,
        window_on(other, beside, apply(other_from_pose.rotation, right), apply(other_from_pose.rotation, up)),
        shift);
    if (!found) return std::nullopt;
    shift = *found;
  }
  const auto slid = [&](std::size_t k, float steps) {
    return times(apply(other_from_pose.rotation, along[k]), double(steps) * step_mm);
  };
  return plus(beside, plus(slid(0, shift.x), slid(1, shift.y)));
}

}  // namespace relievo::pipeline
