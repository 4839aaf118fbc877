// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What lies where on a head, for places in the master camera's frame, millimetres. Thread: any.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "pipeline/mesh/meshers/band_volume.h"
#include "pipeline/model/landmarks.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {

class HeadZones {
 public:
  // The neck is cut `neck_mm` below the tip of the nose.
  HeadZones(const Landmarks& landmarks, const RigidTransform& head_from_camera, double neck_mm)
      : head_from_camera_(head_from_camera), neck_mm_(neck_mm) {
    using enum LandmarkName;
    add_eye(of(landmarks, EndocanthionLeft), of(landmarks, ExocanthionLeft));
    add_eye(of(landmarks, EndocanthionRight), of(landmarks, ExocanthionRight));
  }

  // Shoulders and background are not.
  bool is_head(const Vec3f& place) const {
    constexpr double kHighestMm = 190, kFurthestMm = -215, kWidestMm = 120;
    constexpr double kChinMm = -85, kNeckAxisMm = -95, kNeckRadiusMm = 75;
    const Vec3d p = in_head(place);
    if (p.y < -neck_mm_ || p.y > kHighestMm || p.z < kFurthestMm || std::abs(p.x) > kWidestMm) return false;
    return p.y > kChinMm || std::hypot(p.x, p.z - kNeckAxisMm) < kNeckRadiusMm;
  }
  // Eyes move and close, and what lies between the lids is measured badly.
  bool is_eye(const Vec3f& place) const { return from_eye(place) < 1; }
  // Where the master's own eye gives way to what all poses say.
  bool is_eye_rim(const Vec3f& place) const { return std::abs(from_eye(place) - 1) < 0.2; }
  // How much other poses than the master count: little at an eye, so that no step is left around it.
  float others_share(const Vec3f& place) const {
    constexpr double kFullAt = 1.5;
    constexpr float kLeast = 0.01F;  // where the master sees nothing they still say what is there
    const auto t = float(std::clamp((from_eye(place) - 1) / (kFullAt - 1), 0.0, 1.0));
    return std::max(t * t * (3 - 2 * t), kLeast);
  }
  // Where hardly anybody has hair.
  bool is_face(const Vec3f& place) const {
    constexpr double kMiddleMm = -20, kHalfWidthMm = 70, kHalfHeightMm = 85, kBehindMm = -90;
    const Vec3d p = in_head(place);
    return p.z > kBehindMm && std::hypot(p.x / kHalfWidthMm, (p.y - kMiddleMm) / kHalfHeightMm) < 1;
  }
  // Nose and mouth.
  bool is_middle(const Vec3f& place) const {
    const Vec3d p = in_head(place);
    return std::abs(p.x) < 40 && p.y > -52 && p.y < 40;
  }
  bool is_ear(const Vec3f& place) const {
    const Vec3d p = in_head(place);
    return std::abs(p.x) > 50 && std::abs(p.y) < 45 && p.z < -60;
  }
  bool is_throat(const Vec3f& place) const {
    const Vec3d p = in_head(place);
    return std::abs(p.x) < 60 && p.y < -60 && p.z > -130;
  }

 private:
  struct Eye {
    Vec3d middle;
    double half_width, half_height;
  };
  // 1 on the outline of the nearer eye, less in it.
  double from_eye(const Vec3f& place) const {
    constexpr double kBehindMm = -90;
    const Vec3d p = in_head(place);
    double nearest = std::numeric_limits<double>::max();
    if (p.z > kBehindMm)
      for (int i = 0; i < count_; ++i) {
        const Eye& e = eyes_[std::size_t(i)];
        nearest = std::min(nearest,
                           std::hypot((p.x - e.middle.x) / e.half_width, (p.y - e.middle.y) / e.half_height));
      }
    return nearest;
  }
  Vec3d in_head(const Vec3f& place) const { return apply(head_from_camera_, wide(place)); }
  void add_eye(const Landmark& inner, const Landmark& outer) {
    if (!inner.found || !outer.found) return;
    constexpr double kWider = 1.2, kHigher = 0.75;  // than half the distance of the corners
    const Vec3d a = in_head(inner.at_mm), b = in_head(outer.at_mm);
    const double half = distance(a, b) / 2;
    eyes_[std::size_t(count_++)] = {times(plus(a, b), 0.5), kWider * half, kHigher * half};
  }

  RigidTransform head_from_camera_;
  double neck_mm_;
  std::array<Eye, 2> eyes_{};
  int count_ = 0;
};

// Where in a volume around a head the master's own face stands: between its lids, and where it was completed.
// Memory: the volume's own. Thread: any number reads, one marks.
class OwnFace {
 public:
  // Of a volume whose surface was made already: its values are written over.
  explicit OwnFace(BandVolume&& volume) : volume_(std::move(volume)) {
    std::ranges::fill(volume_.value, 0.0F);
  }
  // To be called for completed places first: a measured one takes their voxels where it is near, as a lid
  // those of the eyeball.
  void mark(const Vec3f& at, float sigma_mm, bool measured) {
    const float said = measured ? sigma_mm : -1 - sigma_mm;
    const auto say_within = [&](float voxels, bool over_others) {
      for_each_voxel_near(volume_, at, voxels * volume_.voxel_mm, [&](int x, int y, int z) {
        float& here = volume_.value[volume_.index(x, y, z)];
        if (over_others || here == 0) here = said;
      });
    };
    say_within(kReachVoxels, !measured);
    if (measured) say_within(kNearVoxels, true);
  }
  // None beyond it.
  struct Said {
    float sigma_mm;
    bool measured;
  };
  std::optional<Said> at(const Vec3f& place) const {
    const auto cell = [&](float x, float from) { return int(std::lround((x - from) / volume_.voxel_mm)); };
    const float said =
        volume_.value[volume_.index(cell(place.x, volume_.corner_mm.x), cell(place.y, volume_.corner_mm.y),
                                    cell(place.z, volume_.corner_mm.z))];
    if (said == 0) return std::nullopt;
    return Said{said > 0 ? said : -1 - said, said > 0};
  }

 private:
  static constexpr float kReachVoxels = 2, kNearVoxels = 1;
  BandVolume volume_;  // of sigmas; 0: nothing; below: completed
};

}  // namespace relievo::pipeline
