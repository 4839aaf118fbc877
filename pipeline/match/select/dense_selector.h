// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// DenseSelector ("dense", the default): a keypoint on every node of a lattice inside the face region.
// Unlike scattered selectors it keeps neighbourhoods: lattice_step_px is set.
#pragma once

#include "pipeline/base/options.h"
#include "pipeline/match/keypoint_selector.h"

namespace relievo::pipeline {

struct DenseSelectorOptions {
  int step_px = 2;
  Result<void> check() const;
};

template <typename Field>
void describe(DenseSelectorOptions& o, Field&& field) {
  field("step_px", o.step_px, OptionRange{1, 16}, "distance between keypoints, pixels");
}

class DenseSelector final : public KeypointSelector {
 public:
  explicit DenseSelector(const DenseSelectorOptions& options) : options_(options) {}
  std::string_view name() const override { return "dense"; }
  bool on_lattice() const override { return true; }
  Result<Keypoints> select(const RectifiedPair& pair, StageContext& context) const override;

 private:
  DenseSelectorOptions options_;
};

}  // namespace relievo::pipeline
