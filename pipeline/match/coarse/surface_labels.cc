// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/coarse/surface_labels.h"

#include <cmath>

namespace relievo::pipeline {

Surfaces label_surfaces(const Plane<float>& d, const Plane<std::uint8_t>& allowed, float step,
                        Plane<int>& label, std::pmr::memory_resource& scratch) {
  Surfaces found(&scratch);
  int next = 0;
  std::pmr::vector<int> open(&scratch);
  open.reserve(d.values.size());
  for (std::size_t seed = 0; seed < d.values.size(); ++seed) {
    if (label.values[seed] != 0 || allowed.values[seed] == 0 || d.values[seed] == kNoDisparity) continue;
    ++next;
    int size = 0;
    open.clear();
    open.push_back(static_cast<int>(seed));
    label.values[seed] = next;
    while (!open.empty()) {
      const int k = open.back();
      open.pop_back();
      ++size;
      const int x = k % d.width;
      const int y = k / d.width;
      const int neighbours[4] = {x > 0 ? k - 1 : -1, x + 1 < d.width ? k + 1 : -1, y > 0 ? k - d.width : -1,
                                 y + 1 < d.height ? k + d.width : -1};
      for (const int n : neighbours) {
        if (n < 0) continue;
        const auto at = static_cast<std::size_t>(n);
        if (label.values[at] != 0 || allowed.values[at] == 0 || d.values[at] == kNoDisparity) continue;
        if (std::abs(d.values[at] - d.values[static_cast<std::size_t>(k)]) > step) continue;
        label.values[at] = next;
        open.push_back(n);
      }
    }
    found.sizes.push_back(size);
    if (size > found.size_of(found.largest)) found.largest = next;
  }
  return found;
}

void bridge_holes(const Plane<std::uint8_t>& usable, int largest, Plane<std::uint8_t>& domain,
                  Plane<float>& disparity, std::pmr::memory_resource& scratch) {
  const int w = domain.width;
  const int h = domain.height;
  Plane<std::uint8_t> seen(&scratch, w, h);
  std::pmr::vector<int> hole(&scratch);
  hole.reserve(seen.values.size());
  for (int seed = 0; seed < w * h; ++seed) {
    if (seen.values[static_cast<std::size_t>(seed)] != 0 ||
        domain.values[static_cast<std::size_t>(seed)] != 0)
      continue;
    hole.clear();
    hole.push_back(seed);
    seen.values[static_cast<std::size_t>(seed)] = 1;
    bool enclosed = true;
    double sum = 0;
    double rim = 0;
    for (std::size_t next = 0; next < hole.size(); ++next) {
      const int k = hole[next];
      const int x = k % w;
      const int y = k / w;
      if (x == 0 || y == 0 || x == w - 1 || y == h - 1 || usable.values[static_cast<std::size_t>(k)] == 0) {
        enclosed = false;
        continue;
      }
      for (const int n : {k - 1, k + 1, k - w, k + w}) {
        const auto at = static_cast<std::size_t>(n);
        if (domain.values[at] == 1) {
          sum += static_cast<double>(disparity.values[at]);
          ++rim;
        } else if (seen.values[at] == 0) {
          seen.values[at] = 1;
          hole.push_back(n);
        }
      }
    }
    if (!enclosed || static_cast<int>(hole.size()) > largest || rim == 0) continue;
    for (const int k : hole) disparity.values[static_cast<std::size_t>(k)] = static_cast<float>(sum / rim);
    // A soap film over the rim; a few dozen sweeps do for holes this small.
    for (int sweep = 0; sweep < 60; ++sweep)
      for (const int k : hole) {
        const float* d = disparity.values.data() + k;
        disparity.values[static_cast<std::size_t>(k)] = 0.25F * (d[-1] + d[1] + d[-w] + d[w]);
      }
    for (const int k : hole) domain.values[static_cast<std::size_t>(k)] = 2;  // not a rim for the next hole
  }
  for (std::uint8_t& inside : domain.values) inside = inside != 0 ? 1 : 0;
}

}  // namespace relievo::pipeline
