// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/refine/surface_refiner.h"

#include <algorithm>

namespace relievo::pipeline {
namespace {

constexpr int kLineBands = 16;
constexpr int kAside = 3;                      // nodes from a line to what lies beside it
constexpr int kAlong = 8;                      // nodes: a line is seen over twice that
constexpr int kPart = 4;                       // nodes
constexpr int kBesides = 2;                    // nodes: how far beside its line a groove bends
constexpr float kNone = 0.12F, kSure = 0.24F;  // darker than its sides by this share of their grey level
constexpr float kLeastGrey = 20;

// By what share a place is darker than its two sides, where that is more than none: 0 to 1, 1 when sure.
float sureness(float darker) { return std::clamp((darker - kNone) / (kSure - kNone), 0.0F, 1.0F); }

float darker(float here, float one, float other) {
  const float sides = (one + other) / 2;
  return (sides - here) / std::max(sides, kLeastGrey);
}

// The left view at the nodes: the mean of 3 x 3 pixels.
void read_nodes(const RefinerScene& scene, const Window& nodes, int step, ThreadPool& pool,
                Plane<float>& grey) {
  const Plane<float>& left = scene.left;
  pool.for_each(nodes.height, kLineBands, [&](int y) {
    for (int x = 0; x < nodes.width; ++x) {
      const int px = std::clamp((nodes.x0 + x) * step, 1, left.width - 2);
      const int py = std::clamp((nodes.y0 + y) * step, 1, left.height - 2);
      float sum = 0;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) sum += left.row(py + dy)[px + dx];
      grey.row(y)[x] = sum / 9;
    }
  });
}

// Lines along x where (dx, dy) is (0, 1), which leads across them, along y where it is (1, 0).
void find_across(const Plane<float>& grey, int dx, int dy, ThreadPool& pool, Plane<float>& dark,
                 Plane<float>& sure, Plane<std::uint8_t>& found) {
  const int w = grey.width;
  const int h = grey.height;
  // Nodes `from` to `to` further, as far as the window goes.
  const auto each = [w, h](int x, int y, int to_x, int to_y, int from, int to, auto&& at) {
    for (int k = from; k <= to; ++k) {
      const int i = x + k * to_x;
      const int j = y + k * to_y;
      if (i >= 0 && j >= 0 && i < w && j < h) at(i, j);
    }
  };
  pool.for_each(h, kLineBands, [&](int y) {
    for (int x = 0; x < w; ++x) {
      const int i = kAside * dx;
      const int j = kAside * dy;
      const bool inside = x >= i && y >= j && x + i < w && y + j < h;
      dark.row(y)[x] = inside ? darker(grey.row(y)[x], grey.row(y - j)[x - i], grey.row(y + j)[x + i]) : 0.0F;
    }
  });
  pool.for_each(h, kLineBands, [&](int y) {
    for (int x = 0; x < w; ++x) {
      // Dark in each of its parts: texture is so in one or two by chance.
      float least = 1;
      for (int part = -kAlong; part < kAlong; part += kPart) {
        const int from = part < 0 ? part : part + 1;
        float sum = 0;
        each(x, y, dy, dx, from, from + kPart - 1, [&](int i, int j) { sum += dark.row(j)[i]; });
        least = std::min(least, sum / kPart);
      }
      sure.row(y)[x] = sureness(least);
    }
  });
  pool.for_each(h, kLineBands, [&](int y) {
    for (int x = 0; x < w; ++x) {
      float most = 0;
      each(x, y, dx, dy, -kBesides, kBesides, [&](int i, int j) { most = std::max(most, sure.row(j)[i]); });
      found.row(y)[x] = std::uint8_t(255 * most + 0.5F);
    }
  });
}

}  // namespace

void find_dark_lines(const RefinerScene& scene, const Window& nodes, int step, StageContext& context,
                     Folds& folds) {
  Arena::Mark mark(context.scratch);
  const PlaneShape shape{&context.scratch, nodes.width, nodes.height};
  Plane<float> grey(shape), dark(shape), sure(shape);
  read_nodes(scene, nodes, step, context.pool, grey);
  find_across(grey, 1, 0, context.pool, dark, sure, folds.xx);
  find_across(grey, 0, 1, context.pool, dark, sure, folds.yy);
}

}  // namespace relievo::pipeline
