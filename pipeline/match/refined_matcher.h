// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// RefinedMatcher ("refined", the default): coarse semi-global matching blind to exposure, then one
// least-squares surface over the whole face, refined from a quarter of the size to full size.
// See coarse_surface.h and surface_refiner.h. sigma_px is the posterior of the fit; cost is one minus
// the local correlation of the warped views.
// Keypoints may lie anywhere; on the lattice of dense_selector.h no interpolation is needed.
#pragma once

#include "pipeline/match/coarse_surface.h"
#include "pipeline/match/matcher.h"

namespace relievo::pipeline {

struct RefinedMatcherOptions {
  CoarseSurfaceOptions coarse;
  SurfaceRefinerOptions refiner;
  float sigma_limit_px = 0.6F;   // a place less certain than this has no match
  Result<void> check() const;
};

class RefinedMatcher final : public Matcher {
 public:
  explicit RefinedMatcher(const RefinedMatcherOptions& options) : options_(options) {}
  std::string_view name() const override { return "refined"; }
  Result<MatchSet> match(const RectifiedPair& pair, const Keypoints& keypoints, StageContext& context) const override;

 private:
  RefinedMatcherOptions options_;
};

}  // namespace relievo::pipeline
