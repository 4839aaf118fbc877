// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which of these points is nearest? A kd-tree, built once (CGAL; its own heap, about 150 bytes a point).
// Exact; among equally near ones any, but always the same. Millimetres, any frame.
// Throws std::bad_alloc. Thread: asking: any number at once.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "pipeline/model/geometry.h"

namespace relievo::pipeline {

class NearestPoints {
 public:
  explicit NearestPoints(std::span<const Vec3f> points_mm);  // copied; at least one
  ~NearestPoints();
  NearestPoints(NearestPoints&&) noexcept;
  NearestPoints& operator=(NearestPoints&&) noexcept;

  std::uint32_t nearest(const Vec3d& to_mm) const;  // its index

 private:
  struct Tree;
  std::unique_ptr<const Tree> tree_;
};

}  // namespace relievo::pipeline
