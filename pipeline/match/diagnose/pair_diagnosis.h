// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Why a pair could not be measured: asked once a stage has failed, so that the person is told the cause and
// not its consequence. Looks at the pictures as they came and, much reduced, rectified, for whatever applies
// first: one or both black, over-exposed or without any detail; the same picture twice; one higher than the
// other. That they are swapped only matching them the other way round can tell (Pipeline::explain).
// Memory: what it takes of `output` and `scratch` is given back. Thread: any; deterministic.
#pragma once

#include <optional>

#include "pipeline/match/rectify/rectifier.h"
#include "pipeline/model/match_set.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::pipeline {

// White skin has no texture left: it comes back as a hole, or not at all.
inline constexpr float kWhiteGrey = 250;  // grey values, 0 .. 255, from which on a pixel is white

// Shares of the face that are white, 0 .. 1.
struct Overexposure {
  double left = 0;
  double right = 0;
};

// Of the face that was found (RectifiedPair::face_centre_px), and in the right view where the matches say it
// is; 0 where none was looked for.
Overexposure measure_overexposure(const RectifiedPair& pair, const MatchSet& matches);

// Of a face that nothing is known of: in the middle of the volume, before the middle of the rig.
Overexposure guess_overexposure(const RectifiedPair& pair);

enum class PairFault : std::uint8_t {
  SamePicture,
  LeftDark,
  RightDark,
  BothDark,
  LeftOverexposed,
  RightOverexposed,
  BothOverexposed,
  LeftBlank,
  RightBlank,
  BothBlank,
  Shifted,  // along the columns, by more than a nudge of a camera makes
  Swapped,
};

// Nothing where the pictures look as they should.
std::optional<PairFault> diagnose_pair(const StereoFrame& frame, const StereoCalibration& calibration,
                                       const RectifierOptions& volume, StageContext& context);

// For the person. Codes: InvalidInput (mistakes with files), NotCalibrated (a camera moved), NoFace (light).
Error error_of(PairFault fault);

}  // namespace relievo::pipeline
