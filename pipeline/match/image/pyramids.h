// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Both views at full size, half, a quarter, ... (image_pyramid.h). On context.scratch.
#pragma once

#include <vector>

#include "pipeline/base/stage.h"
#include "pipeline/match/image/image_pyramid.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::pipeline {

struct Pyramids {
  std::pmr::vector<PyramidLevel> left;  // [level]; level 0 full size
  std::pmr::vector<PyramidLevel> right;
};

Pyramids build_pyramids(const RectifiedPair& pair, int count, StageContext& context);

}  // namespace relievo::pipeline
