// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The kinds of algorithms between two pictures and judged matches. An algorithm is a struct of its options
// with a const member function of the kind's form; any thread may call it.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "pipeline/base/stage.h"
#include "pipeline/model/keypoint.h"
#include "pipeline/model/match_set.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::pipeline {

// Changes the grey values that selectors and matchers see, in place; geometry, colours (the texture is laid
// from them) and the face region stay as they are. Errors: OutOfMemory, Cancelled, InvalidInput (a pair
// without pixels): what the grey values are then is not said.
using Preprocessor = std::function<Result<void>(RectifiedPair& pair, StageContext& context)>;

// Chooses the places of the left rectified view that are to be matched.
// Errors: NoFace (nothing to choose from), OutOfMemory, Cancelled.
using KeypointSelector = std::function<Result<Keypoints>(const RectifiedPair& pair, StageContext& context)>;

// Finds where each left keypoint appears in the right image. A keypoint without a believable partner is left
// out of the result. Errors: TooFewMatches, OutOfMemory, Cancelled, InvalidInput (a pair without pixels).
using Matcher = std::function<Result<MatchSet>(const RectifiedPair& pair, const Keypoints& keypoints,
                                               StageContext& context)>;

// Judges matches; marks the ones it rejects with its bit and erases none, so that the technician can see
// which rule took a point away. Matches already rejected are not asked.
using MatchConstraint = std::function<void(const RectifiedPair& pair, std::span<Match> matches,
                                           int lattice_step_px, std::uint16_t bit, StageContext& context)>;

}  // namespace relievo::pipeline
