// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// NearestVertex: which of many points in front of the camera lies nearest, found through cells over the
// picture plane, ring by ring. Exact within the reach asked for. Millimetres. Thread: any, once made.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "pipeline/model/geometry.h"

namespace relievo::pipeline {

class NearestVertex {
 public:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;
  struct Hit {
    std::uint32_t vertex = kNone;
    float squared_mm = 0;
  };

  // Looks at `points` for as long as it lives. Throws std::bad_alloc when `memory` is used up.
  NearestVertex(std::span<const Vec3f> points_mm, std::pmr::memory_resource* memory);
  Hit find(const Vec3f& at_mm, float within_mm) const;

 private:
  std::span<const Vec3f> points_;
  float left_ = 0, top_ = 0, side_ = 1;
  int columns_ = 1, rows_ = 1;
  std::pmr::vector<std::uint32_t> first_, members_;  // points of cell k: members_[first_[k] .. first_[k + 1])
};

}  // namespace relievo::pipeline
