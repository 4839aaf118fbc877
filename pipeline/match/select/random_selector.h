// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// RandomSelector ("random"): `count` different pixels of the face region, every one equally likely
// (selection sampling: Knuth, The Art of Computer Programming 2, 3.4.2, algorithm S). The same seed
// gives the same pixels on every machine. The yardstick for selectors that claim to know better.
// Errors: InvalidInput (no pixels), NoFace (an empty region), OutOfMemory, Cancelled.
#pragma once

#include "pipeline/base/options.h"
#include "pipeline/match/kinds.h"

namespace relievo::pipeline {

struct RandomSelector {
  int max_points = 20'000;
  int seed = 1;

  void describe(auto&& field) {
    field("max_points", max_points, OptionRange{1, 1'000'000},
          "how many keypoints; all pixels where the region has no more");
    field("seed", seed, OptionRange{0, 2'000'000'000}, "another seed draws other pixels");
  }
  Result<Keypoints> select(const RectifiedPair& pair, StageContext& context) const;
};

}  // namespace relievo::pipeline
