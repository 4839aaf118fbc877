// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where in a volume around a head the master's own face stands: between its lids, and where it was completed.
// Memory: four bytes a voxel. Thread: any number reads, one marks.
#pragma once

#include <cmath>
#include <memory_resource>
#include <optional>
#include <vector>

#include "pipeline/mesh/meshers/band_volume.h"

namespace relievo::pipeline {

class OwnFace {
 public:
  OwnFace(const BandVolume& volume, std::pmr::memory_resource* memory)
      : volume_(volume), sigma_(volume.value.size(), 0.0F, memory) {}
  // To be called for completed places first: a measured one takes their voxels where it is near, as a lid
  // those of the eyeball.
  void mark(const Vec3f& at, float sigma_mm, bool measured) {
    const float said = measured ? sigma_mm : -1 - sigma_mm;
    const auto say_within = [&](float voxels, bool over_others) {
      for_each_voxel_near(volume_, at, voxels * volume_.voxel_mm, [&](int x, int y, int z) {
        float& here = sigma_[volume_.index(x, y, z)];
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
        sigma_[volume_.index(cell(place.x, volume_.corner_mm.x), cell(place.y, volume_.corner_mm.y),
                             cell(place.z, volume_.corner_mm.z))];
    if (said == 0) return std::nullopt;
    return Said{said > 0 ? said : -1 - said, said > 0};
  }

 private:
  static constexpr float kReachVoxels = 2, kNearVoxels = 1;
  const BandVolume& volume_;
  std::pmr::vector<float> sigma_;  // 0: nothing; below: completed
};

}  // namespace relievo::pipeline
