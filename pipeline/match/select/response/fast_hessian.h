// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// FastHessian: second derivatives of a picture by box filters on its integral image (Bay et al. 2008),
// at any size for the same cost. See selectors.h.
#pragma once

#include <memory_resource>
#include <vector>

#include "pipeline/match/image/plane.h"

namespace relievo::pipeline {

class FastHessian {
 public:
  FastHessian(const std::pmr::vector<float>& grey, int width_px, int height_px,
              std::pmr::memory_resource* memory);

  // Determinant of the Hessian at whole pixels, by filters `size_px` wide (9, 15, 21, ...: odd multiples
  // of 3), normalised by their area: it does not depend on the size of what it is laid upon. The
  // filter must lie inside the picture: at least size_px / 2 pixels from its edges.
  float determinant(int x, int y, int size_px) const;

 private:
  // Over left <= x < left + width, top <= y < top + height.
  double sum(int left, int top, int width, int height) const;

  Plane<double> above_;  // sum of all pixels above and left of (x, y)
};

}  // namespace relievo::pipeline
