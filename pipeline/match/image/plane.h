// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Plane<T>: a picture or a field of numbers on an arena, row by row, no padding. PlaneShape: where such
// numbers lie and how many, for structs of several planes alike.
#pragma once

#include <cstddef>
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

}  // namespace relievo::pipeline
