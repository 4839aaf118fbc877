// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// RandomSelector ("random"): `count` different pixels of the face region, every one equally likely
// (selection sampling: Knuth, The Art of Computer Programming 2, 3.4.2, algorithm S). The same seed
// gives the same pixels on every machine. The yardstick for selectors that claim to know better.
// Errors: InvalidInput (no pixels), NoFace (an empty region), OutOfMemory, Cancelled.
#pragma once

#include "pipeline/base/options.h"
#include "pipeline/match/keypoint_selector.h"

namespace relievo::pipeline {

struct RandomSelectorOptions {
  int max_points = 20'000;
  int seed = 1;
  Result<void> check() const;
};

template <typename Field>
void describe(RandomSelectorOptions& o, Field&& field) {
  field("max_points", o.max_points, OptionRange{1, 1'000'000},
        "how many keypoints; all pixels where the region has no more");
  field("seed", o.seed, OptionRange{0, 2'000'000'000}, "another seed draws other pixels");
}

class RandomSelector final : public KeypointSelector {
 public:
  explicit RandomSelector(const RandomSelectorOptions& options) : options_(options) {}
  std::string_view name() const override { return "random"; }
  Result<Keypoints> select(const RectifiedPair& pair, StageContext& context) const override;

 private:
  RandomSelectorOptions options_;
};

}  // namespace relievo::pipeline
