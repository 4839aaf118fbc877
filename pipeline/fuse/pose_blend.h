// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What all poses show together, once they are registered: their mean where they agree within sigma; where
// they do not, the master's surface where it sees well, else the surest. Noise averages out; what makes a
// place less sure than a pose's skin usually is does not. All places and directions are in the master's
// frame, millimetres; what it is made of outlives it. Thread: any, several at once. Throws std::bad_alloc.
#pragma once

#include <array>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "pipeline/fuse/head_pose.h"
#include "pipeline/fuse/head_zones.h"
#include "pipeline/fuse/pose_registration.h"
#include "pipeline/mesh/meshers/band_volume.h"

namespace relievo::pipeline {

class PoseBlend {
 public:
  PoseBlend(std::span<const HeadPose> poses, const Registration& registration, const HeadZones& zones,
            StageContext& context);

  // Whether any pose shows a surface within 15 mm.
  bool is_seen_near(const Vec3f& place) const;

  // The points that count, of all poses; where they lie closer than the field tells apart, every other one.
  // Memory: scratch.
  std::pmr::vector<FieldPoint> points(float voxel_mm) const;

  // Moves a vertex onto the mean of what the poses show; none where no pose shows anything there.
  struct Placed {
    Vec3f at_mm;
    float sigma_mm;
    std::uint8_t pose;   // that counts most
    std::uint8_t poses;  // that count, a bit each
  };
  std::optional<Placed> settle(Vec3f at, const Vec3f& normal) const;

 private:
  // What a pose shows at a vertex.
  struct Seen {
    float distance = 0, weight = 0, certainty = 0, trust = 0, shared = 0;
    Vec3f normal{};
  };

  // What pose k shows at a place.
  std::optional<SurfaceHit> look(std::size_t k, const Vec3f& place) const;
  std::optional<Placed> step(const Vec3f& at, const Vec3f& normal) const;
  Placed mean_of(std::array<Seen, kMostPoses>& seen, std::size_t best, const Vec3f& at,
                 const Vec3f& normal) const;
  bool overruled(std::size_t k, const Vec3f& at, const Vec3f& normal, float sigma, float trust) const;
  double registration_sigma(std::size_t k, const Vec3f& at, const Vec3f& normal) const;

  std::span<const HeadPose> poses_;
  const Registration& registration_;
  const HeadZones& zones_;
  StageContext& context_;
  std::pmr::vector<RigidTransform> back_;  // into each pose's frame
  std::pmr::vector<float> usual_;          // median sigma of each pose
};

}  // namespace relievo::pipeline
