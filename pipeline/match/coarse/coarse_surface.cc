// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/coarse/coarse_surface.h"

#include <algorithm>

#include "pipeline/match/coarse/size_ladder.h"
#include "pipeline/match/coarse/surface_labels.h"

namespace relievo::pipeline {
namespace {

constexpr int kBorder = 4;       // pixels: the census knows nothing there
constexpr int kLeastFace = 400;  // pixels
// A scene that is not one face: many surfaces, thin ones too, and depths that jump by more than a band.
constexpr int kSceneLevel = 2;
constexpr int kSceneBand = 24;
constexpr int kLeastPatch = 60;  // pixels of half the size

SizeLadder ladder_for(const CoarseSurfaceOptions& options, bool scene, int finest) {
  if (!scene) return {kCoarseLevel, finest, options.band, options.cross_check_px};
  return {kSceneLevel, finest, kSceneBand, options.cross_check_px};
}

}  // namespace

Result<void> find_coarse_surface(const RectifiedPair& pair, const Pyramids& pyramids,
                                 const CoarseSurfaceOptions& options, StageContext& context,
                                 SurfaceField& field) {
  const bool scene = is_scene(pair);
  const int step = field.step_px;
  const int finest = step == 2 ? 1 : kFineLevel;
  const int w = field.domain.width;
  const int h = field.domain.height;
  Plane<float> disparity(&context.scratch, w, h);
  RELIEVO_TRY(match_down(whole_range(pair), pyramids, ladder_for(options, scene, finest), options.costs,
                         context, 0.3F, disparity));

  Plane<std::uint8_t> allowed(&context.scratch, w, h);
  for (int y = kBorder; y < h - kBorder; ++y)
    for (int x = kBorder; x < w - kBorder; ++x)
      allowed.row(y)[x] = scene
                              ? std::uint8_t{1}
                              : pair.region[static_cast<std::size_t>(std::min(step * y, pair.height_px - 1)) *
                                                static_cast<std::size_t>(pair.width_px) +
                                            static_cast<std::size_t>(std::min(step * x, pair.width_px - 1))];
  Plane<int> label(&context.scratch, w, h);
  const Surfaces surfaces = label_surfaces(disparity, allowed, options.step_limit_px, label, context.scratch);
  if (surfaces.size_of(surfaces.largest) < kLeastFace)
    return Error{
        Errc::TooFewMatches,
        "no surface of a face's size between the near and far limits: is the face in both views and the calibration this rig's?"};
  for (std::size_t k = 0; k < label.values.size(); ++k) {
    const bool kept =
        scene ? surfaces.size_of(label.values[k]) >= kLeastPatch : label.values[k] == surfaces.largest;
    field.domain.values[k] = kept ? 1 : 0;
    field.disparity_px.values[k] = kept ? static_cast<float>(step) * disparity.values[k] : 0.0F;
  }
  const PyramidLevel& left = pyramids.left[static_cast<std::size_t>(finest)];
  for (std::size_t k = 0; k < allowed.values.size(); ++k) allowed.values[k] &= left.valid.values[k];
  if (!scene) bridge_holes(allowed, options.largest_hole, field.domain, field.disparity_px, context.scratch);
  return {};
}

}  // namespace relievo::pipeline
