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

namespace relievo::pipeline {

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

// What to tell the person. Codes: InvalidInput for mistakes with files, NotCalibrated where a camera moved,
// NoFace for light.
Error error_of(PairFault fault);

}  // namespace relievo::pipeline
