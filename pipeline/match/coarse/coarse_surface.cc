// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/coarse/semi_global.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "pipeline/base/parts.h"

namespace relievo::pipeline {
namespace {

// The surfaces of a field of disparities, by their size, nodes: neighbours on the lattice whose disparities
// differ by little belong together.
struct Surfaces {
  explicit Surfaces(std::pmr::memory_resource* memory) : sizes(memory) {}
  std::pmr::vector<int> sizes;  // [label - 1]
  int largest = 0;              // its label; 0: there is none
  int size_of(int label) const { return label > 0 ? sizes[std::size_t(label - 1)] : 0; }
};

constexpr float kStepPx = 1.5F;  // neighbours further apart belong to different surfaces

// Fills `label` (0: none) where `allowed` and known.
Surfaces label_surfaces(const Plane<float>& d, const Plane<std::uint8_t>& allowed, Plane<int>& label,
                        std::pmr::memory_resource& scratch) {
  Surfaces found(&scratch);
  label_parts(
      std::span(label.values), std::size_t(d.width), &scratch,
      [&](std::size_t k) { return allowed.values[k] != 0 && d.values[k] != kNoDisparity; },
      [&](std::size_t a, std::size_t b) { return !(std::abs(d.values[b] - d.values[a]) > kStepPx); },
      [&](std::span<const std::uint32_t> cells) {
        found.sizes.push_back(int(cells.size()));
        if (found.sizes.back() > found.size_of(found.largest)) found.largest = int(found.sizes.size());
      });
  return found;
}

constexpr int kLevel = 1;       // the field's
constexpr int kCoarsest = 2;    // where all depths of the box are tried
constexpr int kBand = 24;       // of half the size, around what was found there
constexpr int kBeside = 32;     // pixels of half the size around the field
constexpr float kBeyond = 32;   // full-size pixels nearer and farther than the field
constexpr int kWindow = 2;      // radius over which both disagree
constexpr float kApart = 1.5F;  // full-size pixels

// Of level 1, even, so that level 2 has the same box; the right view's lies `shift` pixels further left.
struct Box {
  int x = 0, y = 0, w = 0, h = 0, shift = 0;
  DisparityInterval range;  // beyond the shift, full-size pixels
};

int even(int v) { return v - (v & 1); }

std::optional<Box> box_of(const SurfaceField& field) {
  const int w = field.domain.width, h = field.domain.height;
  int left = w, right = -1, top = h, bottom = -1;
  float least = 1e9F, most = -1e9F;
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      if (field.domain.row(y)[x] == 0) continue;
      left = std::min(left, x), right = std::max(right, x), top = std::min(top, y), bottom = y;
      least = std::min(least, field.disparity_px.row(y)[x]),
      most = std::max(most, field.disparity_px.row(y)[x]);
    }
  if (right < 0) return std::nullopt;
  Box box;
  box.shift = even(int(std::lround(least + most) / 4));
  const auto shift_px = double(2 * box.shift);
  box.range = {double(least - kBeyond) - shift_px, double(most + kBeyond) - shift_px};
  box.x = even(std::max(0, left - kBeside)), box.y = even(std::max(0, top - kBeside));
  box.w = even(std::min(w, right + kBeside + 1) - box.x),
  box.h = even(std::min(h, bottom + kBeside + 1) - box.y);
  return box;
}

// From (x, y) on; black and not valid beyond the picture.
PyramidLevel cut(const PyramidLevel& from, int x, int y, int w, int h, std::pmr::memory_resource& memory) {
  PyramidLevel part(&memory, w, h);
  const int begin = std::clamp(-x, 0, w), end = std::clamp(from.grey.width - x, begin, w);
  for (int row = 0; row < h && y + row < from.grey.height; ++row) {
    std::copy(from.grey.row(y + row) + x + begin, from.grey.row(y + row) + x + end,
              part.grey.row(row) + begin);
    std::copy(from.valid.row(y + row) + x + begin, from.valid.row(y + row) + x + end,
              part.valid.row(row) + begin);
  }
  return part;
}

Pyramids cut(const Pyramids& whole, const Box& box, std::pmr::memory_resource& memory) {
  const auto cut_view = [&](const std::pmr::vector<PyramidLevel>& from, int left) {
    std::pmr::vector<PyramidLevel> levels(&memory);
    levels.reserve(kCoarsest + 1);
    levels.emplace_back(&memory, 0, 0);  // full size is not asked for
    for (int level = kLevel; level <= kCoarsest; ++level) {
      const int scale = 1 << (level - kLevel);
      levels.push_back(
          cut(from[std::size_t(level)], left / scale, box.y / scale, box.w / scale, box.h / scale, memory));
    }
    return levels;
  };
  return {cut_view(whole.left, box.x), cut_view(whole.right, box.x - box.shift)};
}

// At a node, which may stand beyond the last pixel.
std::uint8_t in_region(const RectifiedPair& pair, int x, int y) {
  return pair.region[pair.index(std::min(x, pair.width_px - 1), std::min(y, pair.height_px - 1))];
}

// What was found of the face: one surface, full-size pixels.
struct Found {
  Found(std::pmr::memory_resource* memory, const Box& at)
      : box(at), disparity(memory, at.w, at.h), face(memory, at.w, at.h) {}
  Box box;
  Plane<float> disparity;
  Plane<std::uint8_t> face;
};

Result<void> find(const RectifiedPair& pair, const Pyramids& pyramids, const CoarseSurfaceOptions& options,
                  StageContext& context, Found& found) {
  Arena::Mark mark(context.scratch);
  const Box& box = found.box;
  Progress own;  // a step of the matcher's: what the bar shows must not go back
  StageContext inner{context.output, context.scratch, context.pool, own, context.cancelled};
  RELIEVO_TRY(match_down(box.range, cut(pyramids, box, context.scratch),
                         {kCoarsest, kLevel, kBand, options.cross_check_px}, {}, inner, 1, found.disparity));
  Plane<std::uint8_t> usable(&context.scratch, box.w, box.h);
  for (int y = 0; y < box.h; ++y)
    for (int x = 0; x < box.w; ++x) {
      found.face.row(y)[x] = in_region(pair, 2 * (box.x + x), 2 * (box.y + y));
      usable.row(y)[x] = found.face.row(y)[x] & pyramids.left[kLevel].valid.row(box.y + y)[box.x + x];
    }
  Plane<int> label(&context.scratch, box.w, box.h);
  const Surfaces surfaces = label_surfaces(found.disparity, found.face, label, context.scratch);
  for (std::size_t k = 0; k < label.values.size(); ++k) {
    found.face.values[k] = label.values[k] != 0 && label.values[k] == surfaces.largest ? 1 : 0;
    found.disparity.values[k] = 2 * (found.disparity.values[k] + float(box.shift));
  }
  bridge_holes(usable, options.largest_hole, found.face, found.disparity, context.scratch);
  return {};
}

// By how much what was found lies from the field, on average over a window.
void measure_distance(const Found& found, const SurfaceField& field, StageContext& context,
                      Plane<float>& mean) {
  Plane<float> across(&context.scratch, found.box.w, found.box.h),
      count(&context.scratch, found.box.w, found.box.h);
  for (int y = 0; y < found.box.h; ++y)
    for (int x = 0; x < found.box.w; ++x) {
      if (found.face.row(y)[x] == 0 || field.domain.row(found.box.y + y)[found.box.x + x] == 0) continue;
      mean.row(y)[x] = found.disparity.row(y)[x] - field.disparity_px.row(found.box.y + y)[found.box.x + x];
      count.row(y)[x] = 1;
    }
  box_sum(mean, kWindow, context.pool, across, mean);
  box_sum(count, kWindow, context.pool, across, count);
  for (std::size_t k = 0; k < mean.values.size(); ++k) mean.values[k] /= std::max(count.values[k], 1.0F);
}

constexpr int kBorder = 4;       // pixels: the census knows nothing there
constexpr int kLeastFace = 400;  // pixels
// A scene that is not one face: many surfaces, thin ones too, and depths that jump by more than a band.
constexpr int kSceneLevel = 2;
constexpr int kSceneBand = 24;
constexpr int kLeastPatch = 60;  // pixels of half the size

}  // namespace

void bridge_holes(const Plane<std::uint8_t>& usable, int largest, Plane<std::uint8_t>& domain,
                  Plane<float>& disparity, std::pmr::memory_resource& scratch) {
  const auto w = std::size_t(domain.width), h = std::size_t(domain.height);
  const auto outside = [&](std::size_t k) {
    const std::size_t x = k % w, y = k / w;
    return x == 0 || y == 0 || x == w - 1 || y == h - 1 || usable.values[k] == 0;
  };
  const auto bridge = [&](std::span<const std::uint32_t> hole) {
    bool enclosed = true;
    double sum = 0;
    double rim = 0;
    for (const std::size_t k : hole)
      for (const std::size_t n : {k - 1, k + 1, k - w, k + w})
        if (domain.values[n] != 0) {
          sum += double(disparity.values[n]);
          ++rim;
        } else {
          enclosed = enclosed && !outside(n);
        }
    if (!enclosed || int(hole.size()) > largest || rim == 0) return;
    for (const std::uint32_t k : hole) disparity.values[k] = float(sum / rim);
    // A soap film over the rim; a few dozen sweeps do for holes this small.
    for (int sweep = 0; sweep < 60; ++sweep)
      for (const std::uint32_t k : hole) {
        float* d = disparity.values.data() + k;
        *d = 0.25F * (d[-1] + d[1] + d[-domain.width] + d[domain.width]);
      }
    for (const std::uint32_t k : hole) domain.values[k] = 1;
  };
  Plane<int> label(&scratch, domain.width, domain.height);
  label_parts(
      std::span(label.values), w, &scratch,
      [&](std::size_t k) { return domain.values[k] == 0 && !outside(k); },
      [](std::size_t, std::size_t) { return true; }, bridge);
}

Result<void> search_edges(const RectifiedPair& pair, const Pyramids& pyramids,
                          const CoarseSurfaceOptions& options, StageContext& context, SurfaceField& field) {
  Arena::Mark mark(context.scratch);
  const auto box = box_of(field);
  if (!box) return {};
  Found found(&context.scratch, *box);
  RELIEVO_TRY(find(pair, pyramids, options, context, found));
  Plane<float> distance(&context.scratch, box->w, box->h);
  measure_distance(found, field, context, distance);
  for (int y = 0; y < box->h; ++y)
    for (int x = 0; x < box->w; ++x) {
      if (found.face.row(y)[x] == 0) continue;
      std::uint8_t& inside = field.domain.row(box->y + y)[box->x + x];
      if (inside == 0 || std::abs(distance.row(y)[x]) > kApart)
        field.disparity_px.row(box->y + y)[box->x + x] = found.disparity.row(y)[x];
      inside = 1;
    }
  return {};
}

Result<void> find_coarse_surface(const RectifiedPair& pair, const Pyramids& pyramids,
                                 const CoarseSurfaceOptions& options, StageContext& context,
                                 SurfaceField& field) {
  const bool scene = is_scene(pair);
  const int step = field.step_px;
  const int finest = step == 2 ? 1 : kFineLevel;
  const int w = field.domain.width;
  const int h = field.domain.height;
  Plane<float> disparity(&context.scratch, w, h);
  const SizeLadder ladder{scene ? kSceneLevel : kCoarseLevel, finest, scene ? kSceneBand : options.band,
                          options.cross_check_px};
  RELIEVO_TRY(match_down(whole_range(pair), pyramids, ladder, {}, context, 0.3F, disparity));

  Plane<std::uint8_t> allowed(&context.scratch, w, h);
  for (int y = kBorder; y < h - kBorder; ++y)
    for (int x = kBorder; x < w - kBorder; ++x)
      allowed.row(y)[x] = scene ? std::uint8_t{1} : in_region(pair, step * x, step * y);
  Plane<int> label(&context.scratch, w, h);
  const Surfaces surfaces = label_surfaces(disparity, allowed, label, context.scratch);
  if (surfaces.size_of(surfaces.largest) < kLeastFace)
    return Error{
        Errc::TooFewMatches,
        "no surface of a face's size between the near and far limits: is the face in both views and the calibration this rig's?"};
  for (std::size_t k = 0; k < label.values.size(); ++k) {
    const bool kept =
        scene ? surfaces.size_of(label.values[k]) >= kLeastPatch : label.values[k] == surfaces.largest;
    field.domain.values[k] = kept ? 1 : 0;
    field.disparity_px.values[k] = kept ? float(step) * disparity.values[k] : 0.0F;
  }
  const PyramidLevel& left = pyramids.left[std::size_t(finest)];
  for (std::size_t k = 0; k < allowed.values.size(); ++k) allowed.values[k] &= left.valid.values[k];
  if (!scene) bridge_holes(allowed, options.largest_hole, field.domain, field.disparity_px, context.scratch);
  return {};
}

}  // namespace relievo::pipeline
