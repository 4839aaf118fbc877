// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How good a selector's places are. Repeatability (Schmid, Mohr, Bauckhage 2000): the selector is asked for
// the right view as well; of the left's places, those that both views see by the truth (without one: whose
// match was accepted) should be chosen there again, within kRepeatedPx. Thread: worker.
#pragma once

#include <optional>

#include "firmware/measure/comparison.h"
#include "pipeline/base/stage.h"
#include "pipeline/match/kinds.h"
#include "pipeline/model/match_set.h"

namespace relievo::firmware::compare {

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
