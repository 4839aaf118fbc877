// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/refine/surface_refiner.h"

#include <algorithm>
#include <cmath>

namespace relievo::pipeline {
namespace {

constexpr int kDetailRadius = 3;  // waves longer than about twice this window, 7 pixels, are taken out
constexpr int kReach = 4;         // pixels to either side
constexpr int kTile = 4;          // pixels a side; scores stand for tiles
constexpr int kWindowRadius = 2;  // tiles: a window of 20 pixels
constexpr float kMargin = 0.2F;   // by which the correlation must be better; of noise alone it strays by 0.08
constexpr float kLeast = 0.3F;    // and what it must reach
constexpr float kFilled = 0.85F;  // share of the window both views must show: outlines match by chance
constexpr float kNoise = 0.05F;   // squared grey levels: less detail than this is none
constexpr std::size_t kLeastTiles = 48;  // half the tip of a nose; what is smaller refinement settles

struct Tiles {
  PlaneShape shape;
  Plane<float> across{shape};
  Plane<float> pixels{shape};                           // that both views show
  Plane<float> left{shape}, right{shape}, both{shape};  // sums of squares and of products
  Plane<float> score{shape, -1}, shift{shape};          // of the best so far
  Plane<float> here{shape};                             // score where the field is now
};

// The picture less what two passes of a box leave of its broad shading: even a bent slope is gone.
void keep_detail(const Plane<float>& from, ThreadPool& pool, Plane<float>& sums, Plane<float>& across,
                 Plane<float>& to) {
  constexpr float kCells = (2 * kDetailRadius + 1) * (2 * kDetailRadius + 1);
  to.values = from.values;
  for (int pass = 0; pass < 2; ++pass) {
    box_sum(to, kDetailRadius, pool, across, sums);
    for (std::size_t k = 0; k < to.values.size(); ++k) to.values[k] -= sums.values[k] / kCells;
  }
}

struct Views {
  const RefinerScene& scene;
  const SurfaceField& field;
  const Plane<float>&left, &right;  // detail
};

// Adds row y to its tiles, the right view `shift` pixels beyond where the field says.
void add_row(const Views& v, int y, float shift, Tiles& tiles) {
  const float to_level = 1.0F / float(1 << v.scene.level);
  const float* l = v.left.row(y);
  const float* r = v.right.row(y);
  const float* d = v.field.disparity_px.row(y);
  const std::uint8_t* in = v.field.domain.row(y);
  const std::uint8_t* valid = v.scene.right_valid.row(y);
  for (int x = 0; x < v.left.width; ++x) {
    if (in[x] == 0) continue;
    const float at = float(x) - d[x] * to_level - shift;
    if (!(at >= 0 && at < float(v.right.width - 1))) continue;
    const int k = int(at);
    if ((valid[k] & valid[k + 1]) == 0) continue;
    const float seen = r[k] + (at - float(k)) * (r[k + 1] - r[k]);
    tiles.pixels.row(y / kTile)[x / kTile] += 1;
    tiles.left.row(y / kTile)[x / kTile] += l[x] * l[x];
    tiles.right.row(y / kTile)[x / kTile] += seen * seen;
    tiles.both.row(y / kTile)[x / kTile] += l[x] * seen;
  }
}

void try_shift(const Views& views, int shift, ThreadPool& pool, Tiles& tiles) {
  pool.for_each(tiles.score.height, tiles.score.height, [&](int t) {
    for (Plane<float>* plane : {&tiles.pixels, &tiles.left, &tiles.right, &tiles.both})
      std::fill_n(plane->row(t), plane->width, 0.0F);
    for (int y = t * kTile; y < std::min((t + 1) * kTile, views.left.height); ++y)
      add_row(views, y, float(shift), tiles);
  });
  for (Plane<float>* plane : {&tiles.pixels, &tiles.left, &tiles.right, &tiles.both})
    box_sum(*plane, kWindowRadius, pool, tiles.across, *plane);
  constexpr float kWindowPixels = (2 * kWindowRadius + 1) * (2 * kWindowRadius + 1) * kTile * kTile;
  constexpr float kFloor = kNoise * kWindowPixels;
  for (std::size_t k = 0; k < tiles.score.values.size(); ++k) {
    const float score =
        tiles.both.values[k] / std::sqrt((tiles.left.values[k] + kFloor) * (tiles.right.values[k] + kFloor));
    if (shift == 0) tiles.here.values[k] = score;
    if (score <= tiles.score.values[k] || tiles.pixels.values[k] < kFilled * kWindowPixels) continue;
    tiles.score.values[k] = score;
    tiles.shift.values[k] = float(shift);
  }
}

// Bilinear between the tiles' middles: no steps, which refinement would take for creases.
float between_tiles(const Plane<float>& tiles, int x, int y) {
  const float fx = std::clamp((float(x) + 0.5F) / kTile - 0.5F, 0.0F, float(tiles.width - 1));
  const float fy = std::clamp((float(y) + 0.5F) / kTile - 0.5F, 0.0F, float(tiles.height - 1));
  const int i = std::min(int(fx), tiles.width - 2);
  const int j = std::min(int(fy), tiles.height - 2);
  const float tx = fx - float(i);
  const float ty = fy - float(j);
  const float* upper = tiles.row(j) + i;
  const float* lower = tiles.row(j + 1) + i;
  return (1 - ty) * (upper[0] + tx * (upper[1] - upper[0])) + ty * (lower[0] + tx * (lower[1] - lower[0]));
}

}  // namespace

bool search_by_detail(const RefinerScene& scene, StageContext& context, SurfaceField& field) {
  const int w = scene.left.width;
  const int h = scene.left.height;
  if (field.domain.width != w || field.domain.height != h || w < 2 * kTile || h < 2 * kTile) return false;
  Arena::Mark mark(context.scratch);
  std::pmr::memory_resource* memory = &context.scratch;
  Plane<float> left(memory, w, h), right(memory, w, h);
  Tiles tiles{{memory, (w + kTile - 1) / kTile, (h + kTile - 1) / kTile}};
  {
    Arena::Mark passing(context.scratch);
    Plane<float> sums(memory, w, h), across(memory, w, h);
    keep_detail(scene.left, context.pool, sums, across, left);
    keep_detail(scene.right, context.pool, sums, across, right);
  }
  const Views views{scene, field, left, right};
  for (int shift = -kReach; shift <= kReach && !context.stop(); ++shift)
    try_shift(views, shift, context.pool, tiles);
  // Only the shifts of clearly better tiles stay.
  std::size_t moved = 0;
  for (std::size_t k = 0; k < tiles.shift.values.size(); ++k) {
    const bool clear =
        tiles.score.values[k] > kLeast && tiles.score.values[k] > tiles.here.values[k] + kMargin;
    if (!clear) tiles.shift.values[k] = 0;
    moved += tiles.shift.values[k] != 0 ? 1U : 0U;
  }
  if (moved < kLeastTiles) return false;
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x)
      if (field.domain.row(y)[x] != 0)
        field.disparity_px.row(y)[x] += between_tiles(tiles.shift, x, y) * float(1 << scene.level);
  return true;
}

}  // namespace relievo::pipeline
