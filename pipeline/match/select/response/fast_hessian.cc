// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/select/response/fast_hessian.h"

namespace relievo::pipeline {

FastHessian::FastHessian(const std::pmr::vector<float>& grey, int width_px, int height_px,
                         std::pmr::memory_resource* memory)
    : above_(memory, width_px + 1, height_px + 1, 0.0) {
  for (int y = 0; y < height_px; ++y) {
    const float* from = grey.data() + static_cast<std::ptrdiff_t>(y) * width_px;
    double in_row = 0;
    for (int x = 0; x < width_px; ++x) {
      in_row += static_cast<double>(from[x]);
      above_.row(y + 1)[x + 1] = above_.row(y)[x + 1] + in_row;
    }
  }
}

double FastHessian::sum(int left, int top, int width, int height) const {
  const double* upper = above_.row(top) + left;
  const double* lower = above_.row(top + height) + left;
  return lower[width] - lower[0] - upper[width] + upper[0];
}

float FastHessian::determinant(int x, int y, int size) const {
  const int lobe = size / 3;
  const int half = size / 2;
  const int broad = 2 * lobe - 1;
  // Three lobes, 1 -2 1: the whole minus three times the middle.
  const double xx =
      sum(x - half, y - lobe + 1, size, broad) - 3 * sum(x - lobe / 2, y - lobe + 1, lobe, broad);
  const double yy =
      sum(x - lobe + 1, y - half, broad, size) - 3 * sum(x - lobe + 1, y - lobe / 2, broad, lobe);
  const double xy = sum(x + 1, y - lobe, lobe, lobe) + sum(x - lobe, y + 1, lobe, lobe) -
                    sum(x - lobe, y - lobe, lobe, lobe) - sum(x + 1, y + 1, lobe, lobe);
  const double area = static_cast<double>(size) * static_cast<double>(size);
  return static_cast<float>((xx * yy - 0.81 * xy * xy) / (area * area));
}

}  // namespace relievo::pipeline
