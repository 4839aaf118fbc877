// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// DenseSelector ("dense", the default): a keypoint on every node of a lattice inside the face region.
// Unlike scattered selectors it keeps neighbourhoods: lattice_step_px is set.
#pragma once

#include "pipeline/base/options.h"
#include "pipeline/match/kinds.h"

namespace relievo::pipeline {

struct DenseSelector {
  int step_px = 2;

  void describe(auto&& field) {
    field("step_px", step_px, OptionRange{1, 16}, "distance between keypoints, pixels");
  }
  Result<Keypoints> select(const RectifiedPair& pair, StageContext& context) const;
};

}  // namespace relievo::pipeline
