// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// PhotographLayer: the whole way from a surface and its photographs to an atlas; both texturers use it.
// Surface that a camera saw shows its photograph, measured or not; what none saw is filled smoothly from its
// surroundings and flagged in `origin`.
// Memory: the atlas in `output`, the rest in `scratch`. Thread: any; works on the pool, and the result
// does not depend on its size. Errors: InvalidInput, Cancelled; throws std::bad_alloc.
#pragma once

#include "pipeline/base/stage.h"
#include "pipeline/model/texture_atlas.h"
#include "pipeline/texture/blend/shot_planes.h"
#include "pipeline/texture/chart/chart.h"

namespace relievo::pipeline {

struct LayerOptions {
  ChartOptions chart;
  ShotOptions shot;
  float highlight_level = 12;
};

Result<TextureAtlas> lay_photographs(const FaceMesh& mesh, const RectifiedPair& pair,
                                     const LayerOptions& options, StageContext& context);

}  // namespace relievo::pipeline
