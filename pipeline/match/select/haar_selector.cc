// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>

#include "pipeline/match/select/response/corner_response.h"
#include "pipeline/match/select/response/keypoint_choice.h"
#include "pipeline/match/select/selectors.h"

namespace relievo::pipeline {
namespace {

constexpr int kOctaveBands = 16;
constexpr int kSizes = 4;

// One octave: responses of four filter sizes on every step-th pixel.
struct Octave {
  Octave(int number, int width_px, int height_px, std::pmr::memory_resource* memory)
      : step_px(1 << number),
        size_px{},
        response{layer(memory, width_px, height_px), layer(memory, width_px, height_px),
                 layer(memory, width_px, height_px), layer(memory, width_px, height_px)} {
    for (int k = 0; k < kSizes; ++k) size_px[std::size_t(k)] = 3 * ((2 << number) * (k + 1) + 1);
  }
  Plane<float> layer(std::pmr::memory_resource* memory, int width_px, int height_px) const {
    return Plane<float>(memory, (width_px + step_px - 1) / step_px, (height_px + step_px - 1) / step_px);
  }
  int step_px;
  std::array<int, kSizes> size_px;
  std::array<Plane<float>, kSizes> response;
};

void respond(const FastHessian& hessian, const Selectable& selectable, ThreadPool& pool, Octave& octave) {
  pool.for_each_band(octave.response[0].height, kOctaveBands, [&](int begin, int end, int) {
    for (std::size_t k = 0; k < kSizes; ++k)
      for (int j = begin; j < end; ++j)
        for (int i = 0; i < octave.response[k].width; ++i)
          if (const int x = i * octave.step_px, y = j * octave.step_px;
              selectable(x, y, octave.size_px[k] / 2))
            octave.response[k].row(j)[i] = std::max(0.0F, hessian.determinant(x, y, octave.size_px[k]));
  });
}

// Of equal ones the first in size, row and column.
bool is_peak(const Octave& octave, std::size_t k, int i, int j) {
  const float here = octave.response[k].row(j)[i];
  for (std::size_t l = k - 1; l <= k + 1; ++l)
    for (int b = j - 1; b <= j + 1; ++b)
      for (int a = i - 1; a <= i + 1; ++a) {
        if (l == k && b == j && a == i) continue;
        const bool before = l != k ? l < k : b != j ? b < j : a < i;
        const float there = octave.response[l].row(b)[a];
        if (before ? there >= here : there > here) return false;
      }
  return true;
}

// The top of the quadratic through a peak and its neighbours, in steps from the peak along x, y and size;
// where it would lie further away than the neighbours the samples say no more than the peak itself.
std::array<double, 2> top_of(const Octave& octave, std::size_t k, int i, int j) {
  const auto at = [&](int di, int dj, int dk) {
    return double(octave.response[std::size_t(int(k) + dk)].row(j + dj)[i + di]);
  };
  const double here = at(0, 0, 0);
  const double gx = 0.5 * (at(1, 0, 0) - at(-1, 0, 0)), gy = 0.5 * (at(0, 1, 0) - at(0, -1, 0)),
               gs = 0.5 * (at(0, 0, 1) - at(0, 0, -1));
  const double xx = at(1, 0, 0) + at(-1, 0, 0) - 2 * here, yy = at(0, 1, 0) + at(0, -1, 0) - 2 * here,
               ss = at(0, 0, 1) + at(0, 0, -1) - 2 * here;
  const double xy = 0.25 * (at(1, 1, 0) - at(-1, 1, 0) - at(1, -1, 0) + at(-1, -1, 0));
  const double xs = 0.25 * (at(1, 0, 1) - at(-1, 0, 1) - at(1, 0, -1) + at(-1, 0, -1));
  const double ys = 0.25 * (at(0, 1, 1) - at(0, -1, 1) - at(0, 1, -1) + at(0, -1, -1));
  const double det = xx * (yy * ss - ys * ys) - xy * (xy * ss - ys * xs) + xs * (xy * ys - yy * xs);
  if (!(std::abs(det) > 1e-12 * here * here * here)) return {0, 0};
  const double x = -(gx * (yy * ss - ys * ys) - xy * (gy * ss - ys * gs) + xs * (gy * ys - yy * gs)) / det;
  const double y = -(xx * (gy * ss - gs * ys) - gx * (xy * ss - ys * xs) + xs * (xy * gs - gy * xs)) / det;
  if (!(std::abs(x) <= 1 && std::abs(y) <= 1)) return {0, 0};
  return {x, y};
}

// Marks the octave's peaks at full size; a pixel keeps its strongest.
void mark_peaks(const Octave& octave, const Selectable& selectable, Plane<float>& found) {
  for (std::size_t k = 1; k + 1 < kSizes; ++k)
    for (int j = 1; j + 1 < octave.response[k].height; ++j)
      for (int i = 1; i + 1 < octave.response[k].width; ++i) {
        const float here = octave.response[k].row(j)[i];
        if (!(here > 0) || !is_peak(octave, k, i, j)) continue;
        const auto [dx, dy] = top_of(octave, k, i, j);
        const int x = int(std::lround((i + dx) * octave.step_px));
        const int y = int(std::lround((j + dy) * octave.step_px));
        if (selectable(x, y, 0)) found.row(y)[x] = std::max(found.row(y)[x], here);
      }
}

}  // namespace

Result<Keypoints> HaarSelector::select(const RectifiedPair& pair, StageContext& context) const {
  RELIEVO_TRY_ASSIGN(const Selectable selectable, selectable_of(pair, context));
  const FastHessian hessian(pair.left.grey, pair.width_px, pair.height_px, &context.scratch);
  Plane<float> found(&context.scratch, pair.width_px, pair.height_px);
  for (int number = 0; number < octaves; ++number) {
    Arena::Mark mark(context.scratch);
    Octave octave(number, pair.width_px, pair.height_px, &context.scratch);
    respond(hessian, selectable, context.pool, octave);
    if (context.stop()) return selection_stopped();
    mark_peaks(octave, selectable, found);
  }
  return peak_keypoints(found, {quality * quality, 0, double(min_distance_px), max_points}, context);
}

namespace {

constexpr int kBands = 16;

// Bands of whole blocks of the coarsest scale: no track leaves its band.
void mark_ends(const SalientTracks& tracks, const Selectable& selectable, ThreadPool& pool,
               Plane<float>& saliency) {
  const int block = 1 << tracks.scales();
  pool.for_each_band((saliency.height + block - 1) / block, kBands, [&](int begin, int end, int) {
    for (int scale = 1; scale <= tracks.scales(); ++scale) {
      const int side = 1 << scale;
      const int last = std::min(tracks.rows(scale), end * (block / side));
      for (int row = begin * (block / side); row < last; ++row)
        for (int column = 0; column < tracks.columns(scale); ++column) {
          if (!selectable.valid_block(column * side, row * side, side)) continue;
          for (int orientation = 0; orientation < SalientTracks::kOrientations; ++orientation) {
            if (!(tracks.magnitude(scale, orientation, column, row) > 0)) continue;
            const Candidate found = tracks.follow(scale, orientation, column, row);
            if (!selectable(found.x, found.y, 1)) continue;
            float& there = saliency.row(found.y)[found.x];
            there = std::max(there, found.strength);
          }
        }
    }
  });
}

}  // namespace

Result<Keypoints> WaveletSalientSelector::select(const RectifiedPair& pair, StageContext& context) const {
  RELIEVO_TRY_ASSIGN(const Selectable selectable, selectable_of(pair, context));
  const SalientTracks tracks(pair.left.grey, pair.width_px, pair.height_px, scales, &context.scratch);
  Plane<float> saliency(&context.scratch, pair.width_px, pair.height_px);
  mark_ends(tracks, selectable, context.pool, saliency);
  if (context.stop()) return selection_stopped();
  return peak_keypoints(saliency, {quality, 0, double(min_distance_px), max_points}, context);
}

}  // namespace relievo::pipeline
