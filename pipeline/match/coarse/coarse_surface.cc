// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/coarse/coarse_surface.h"

#include <algorithm>
#include <cmath>

#include "pipeline/match/coarse/size_ladder.h"

namespace relievo::pipeline {
namespace {

constexpr int kBorder = 4;         // pixels: the census knows nothing there
constexpr int kLeastFace = 400;    // pixels
// A scene that is not one face: many surfaces, thin ones too, and depths that jump by more than a band.
constexpr int kSceneLevel = 2;
constexpr int kSceneBand = 24;
constexpr int kLeastPatch = 60;    // pixels of half the size

// Labels surfaces whose neighbouring disparities differ by less than `step`, and how large each is.
struct Surfaces {
  explicit Surfaces(std::pmr::memory_resource* memory) : sizes(memory) {}
  std::pmr::vector<int> sizes;  // [label - 1]
  int largest = 0;              // its label; 0: there is none
  int size_of(int label) const { return label > 0 ? sizes[static_cast<std::size_t>(label - 1)] : 0; }
};

Surfaces label_surfaces(const Plane<float>& d, const Plane<std::uint8_t>& allowed, float step, Plane<int>& label,
                        std::pmr::memory_resource& scratch) {
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

// Holes that the surface encloses are bridged smoothly, so that refinement can look there: highlights
// and plain skin fail the cross-check and may still be found from their surroundings. What the finer
// pictures do not confirm keeps a large sigma and goes; what is hidden from the right view breaks the
// uniqueness rule and goes.
void bridge_holes(SurfaceField& field, const Plane<std::uint8_t>& usable, int largest, std::pmr::memory_resource& scratch) {
  const int w = field.domain.width;
  const int h = field.domain.height;
  Plane<std::uint8_t> seen(&scratch, w, h);
  std::pmr::vector<int> hole(&scratch);
  hole.reserve(seen.values.size());
  for (int seed = 0; seed < w * h; ++seed) {
    if (seen.values[static_cast<std::size_t>(seed)] != 0 || field.domain.values[static_cast<std::size_t>(seed)] != 0) continue;
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
        if (field.domain.values[at] == 1) {
          sum += static_cast<double>(field.disparity_px.values[at]);
          ++rim;
        } else if (seen.values[at] == 0) {
          seen.values[at] = 1;
          hole.push_back(n);
        }
      }
    }
    if (!enclosed || static_cast<int>(hole.size()) > largest || rim == 0) continue;
    for (const int k : hole) field.disparity_px.values[static_cast<std::size_t>(k)] = static_cast<float>(sum / rim);
    // A soap film over the rim; a few dozen sweeps do for holes this small.
    for (int sweep = 0; sweep < 60; ++sweep)
      for (const int k : hole) {
        const float* d = field.disparity_px.values.data() + k;
        field.disparity_px.values[static_cast<std::size_t>(k)] = 0.25F * (d[-1] + d[1] + d[-w] + d[w]);
      }
    for (const int k : hole) field.domain.values[static_cast<std::size_t>(k)] = 2;  // not a rim for the next hole
  }
  for (std::uint8_t& inside : field.domain.values) inside = inside != 0 ? 1 : 0;
}

SizeLadder ladder_for(const CoarseSurfaceOptions& options, bool scene, int finest) {
  if (!scene) return {kCoarseLevel, finest, options.band, options.cross_check_px};
  return {kSceneLevel, finest, kSceneBand, options.cross_check_px};
}

}  // namespace

Result<void> find_coarse_surface(const RectifiedPair& pair, const Pyramids& pyramids,
                                 const CoarseSurfaceOptions& options, StageContext& context, SurfaceField& field) {
  const bool scene = is_scene(pair);
  const int step = field.step_px;
  const int finest = step == 2 ? 1 : kFineLevel;
  const int w = field.domain.width;
  const int h = field.domain.height;
  Plane<float> disparity(&context.scratch, w, h);
  RELIEVO_TRY(match_down(pair, pyramids, ladder_for(options, scene, finest), options.costs, context, 0.3F, disparity));

  Plane<std::uint8_t> allowed(&context.scratch, w, h);
  for (int y = kBorder; y < h - kBorder; ++y)
    for (int x = kBorder; x < w - kBorder; ++x)
      allowed.row(y)[x] = scene ? std::uint8_t{1} : pair.region[static_cast<std::size_t>(std::min(step * y, pair.height_px - 1)) * static_cast<std::size_t>(pair.width_px) +
                                              static_cast<std::size_t>(std::min(step * x, pair.width_px - 1))];
  Plane<int> label(&context.scratch, w, h);
  const Surfaces surfaces = label_surfaces(disparity, allowed, options.step_limit_px, label, context.scratch);
  if (surfaces.size_of(surfaces.largest) < kLeastFace)
    return Error{Errc::TooFewMatches, "no surface of a face's size between the near and far limits: is the face in both views and the calibration this rig's?"};
  for (std::size_t k = 0; k < label.values.size(); ++k) {
    const bool kept = scene ? surfaces.size_of(label.values[k]) >= kLeastPatch : label.values[k] == surfaces.largest;
    field.domain.values[k] = kept ? 1 : 0;
    field.disparity_px.values[k] = kept ? static_cast<float>(step) * disparity.values[k] : 0.0F;
  }
  const PyramidLevel& left = pyramids.left[static_cast<std::size_t>(finest)];
  for (std::size_t k = 0; k < allowed.values.size(); ++k) allowed.values[k] &= left.valid.values[k];
  if (!scene) bridge_holes(field, allowed, options.largest_hole, context.scratch);
  return {};
}

}  // namespace relievo::pipeline
