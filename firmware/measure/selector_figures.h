// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How good a selector's places are. Repeatability (Schmid, Mohr, Bauckhage 2000): the selector is asked for
// the right view as well; of the left's places, those that both views see by the truth (without one: whose
// match was accepted) should be chosen there again, within kRepeatedPx. Thread: worker.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "firmware/measure/comparison.h"
#include "pipeline/base/stage.h"
#include "pipeline/match/kinds.h"
#include "pipeline/model/keypoint.h"
#include "pipeline/model/match_set.h"

namespace relievo::firmware::compare {

// What the constraints took away, rule by rule, and whether they were right to. Thread: any. No errors.

MatchFigures figures_of(const NamedSet& set, const pipeline::Keypoints& keypoints,
                        const pipeline::MatchSet& matches, const std::optional<DisparityTruth>& truth,
                        double limit_px);

// A pixel each: 0, or 1 + the rule that took the match there. On a lattice every node stands for its cell,
// a scattered match for 9 x 9 pixels.
std::vector<std::uint8_t> rejected_map(const pipeline::MatchSet& matches, int width_px, int height_px);

inline constexpr double kRepeatedPx = 1.5;

// Places of the right view, by its own axes: the pair is handed over mirrored, so that it is the left one.
// A face region goes with it, brought over by `map`. Errors: the selector's.
Result<pipeline::Keypoints> select_in_right(const pipeline::KeypointSelector& selector,
                                            const pipeline::RectifiedPair& pair, const DisparityMap& map,
                                            pipeline::StageContext& context);

SelectorFigures selector_figures(const pipeline::RectifiedPair& pair, const pipeline::Keypoints& left,
                                 const pipeline::Keypoints& right, const pipeline::MatchSet& matches,
                                 const std::optional<DisparityTruth>& truth);

}  // namespace relievo::firmware::compare
