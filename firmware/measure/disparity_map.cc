// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/measure/disparity_map.h"

#include <algorithm>
#include <array>

namespace relievo::firmware::compare {
namespace {

// A pixel between four nodes of the lattice; `tx`, `ty` of 0 to 1.
float between(const std::array<float, 4>& node, float tx, float ty, float step_px) {
  const auto [least, most] =
      std::minmax_element(node.begin(), node.end(), [](float a, float b) { return a < b; });
  const bool all = std::none_of(node.begin(), node.end(), [](float d) { return std::isnan(d); });
  if (!all || *most - *least > step_px) return node[(tx < 0.5F ? 0U : 1U) + (ty < 0.5F ? 0U : 2U)];
  const float top = node[0] + tx * (node[1] - node[0]);
  return top + ty * (node[2] + tx * (node[3] - node[2]) - top);
}

// Nodes stand every `step` pixels from (first_x, first_y) on, which lies within the first step.
void fill_lattice(DisparityMap& map, int step, int first_x, int first_y) {
  const DisparityMap nodes = map;
  const auto node = [&nodes](int x, int y) { return nodes.holds(x, y) ? nodes.at(x, y) : kNoDisparity; };
  for (int y = 0; y < map.height_px; ++y)
    for (int x = 0; x < map.width_px; ++x) {
      const int left = x - (x - first_x + step) % step;
      const int top = y - (y - first_y + step) % step;
      const bool last_column = left + step >= map.width_px;
      const bool last_row = top + step >= map.height_px;
      const std::array around{node(left, top), last_column ? node(left, top) : node(left + step, top),
                              last_row ? node(left, top) : node(left, top + step),
                              last_column || last_row ? node(left, top) : node(left + step, top + step)};
      const float by_step = 1.0F / static_cast<float>(step);
      map.values[map.index(x, y)] = between(around, static_cast<float>(x - left) * by_step,
                                            static_cast<float>(y - top) * by_step, static_cast<float>(step));
    }
}

}  // namespace

DisparityMap disparity_map(const pipeline::MatchSet& set, int width_px, int height_px) {
  DisparityMap map(width_px, height_px);
  for (const pipeline::Match& match : set.matches) {
    const int x = static_cast<int>(std::lround(match.left_px.x));
    const int y = static_cast<int>(std::lround(match.left_px.y));
    if (match.rejected_by == 0 && map.holds(x, y)) map.values[map.index(x, y)] = match.disparity_px;
  }
  if (const int step = set.lattice_step_px; step > 1 && !set.matches.empty()) {
    const pipeline::Vec2f node = set.matches.front().left_px;
    fill_lattice(map, step, static_cast<int>(std::lround(node.x)) % step,
                 static_cast<int>(std::lround(node.y)) % step);
  }
  return map;
}

DisparityMap thickened(const DisparityMap& map, int side_px) {
  DisparityMap thick = map;
  for (int y = 0; y < map.height_px; ++y)
    for (int x = 0; x < map.width_px; ++x) {
      if (!map.known(x, y)) continue;
      for (int j = y - side_px / 2; j <= y + side_px / 2; ++j)
        for (int i = x - side_px / 2; i <= x + side_px / 2; ++i)
          if (thick.holds(i, j) && !map.known(i, j)) thick.values[thick.index(i, j)] = map.at(x, y);
    }
  return thick;
}

}  // namespace relievo::firmware::compare
