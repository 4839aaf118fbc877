// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Plane<T>: a picture or a field of numbers on an arena, row by row, no padding. PlaneShape: where such
// numbers lie and how many, for structs of several planes alike.
// SurfaceField: disparities over a lattice, as the search for a surface carries them from coarse to fine.
// Pixels are those of the full size. Thread: any, one at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <vector>

namespace relievo::pipeline {

struct PlaneShape {
  std::pmr::memory_resource* memory;
  int width, height;
};

template <typename T>
struct Plane {
  Plane(std::pmr::memory_resource* memory, int width_px, int height_px, T value = T{})
      : width(width_px),
        height(height_px),
        values(std::size_t(width_px) * std::size_t(height_px), value, memory) {}
  explicit Plane(const PlaneShape& shape, T value = T{})
      : Plane(shape.memory, shape.width, shape.height, value) {}

  int width;
  int height;
  std::pmr::vector<T> values;

  T* row(int y) { return values.data() + std::ptrdiff_t(y) * width; }
  const T* row(int y) const { return values.data() + std::ptrdiff_t(y) * width; }
};

inline constexpr float kNoDisparity = -1.0e6F;  // of a pixel of a field: nothing is known

// A field over the nodes of a lattice; node (i, j) stands on full-size pixel (step_px * i, step_px * j).
struct SurfaceField {
  SurfaceField(std::pmr::memory_resource* memory, int width, int height, int step)
      : step_px(step), shape{memory, width, height} {}
  int step_px;
  PlaneShape shape;
  Plane<float> disparity_px{shape};   // full-size pixels
  Plane<std::uint8_t> domain{shape};  // 1 where the surface is solved for
  Plane<float> sigma_px{shape};       // of disparity_px
  Plane<float> cost{shape};           // 1 - local zero-mean correlation
};

}  // namespace relievo::pipeline
