// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the constraints took away, rule by rule, and whether they were right to. Thread: any. No errors.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "firmware/measure/comparison.h"
#include "pipeline/model/keypoint.h"
#include "pipeline/model/match_set.h"

namespace relievo::firmware::compare {

MatchFigures figures_of(const NamedSet& set, const pipeline::Keypoints& keypoints,
                        const pipeline::MatchSet& matches, const std::optional<DisparityTruth>& truth,
                        double limit_px);

// A pixel each: 0, or 1 + the rule that took the match there. On a lattice every node stands for its cell,
// a scattered match for 9 x 9 pixels.
std::vector<std::uint8_t> rejected_map(const pipeline::MatchSet& matches, int width_px, int height_px);

}  // namespace relievo::firmware::compare
