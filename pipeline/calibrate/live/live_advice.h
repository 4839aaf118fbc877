// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Why a pair of pictures was or was not taken, and the names of that and of what is advised
// (pipeline/model/live_advice.h).
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "pipeline/model/live_advice.h"

namespace relievo::pipeline {

enum class PairVerdict : std::uint8_t {
  Taken,
  NoBoard,
  LeftMissesIt,
  RightMissesIt,
  Moving,  // corners moved since the pair before, or there was no board in it
  Blurred,
  AlreadyHave,
  Swapped,
  Finished,  // nothing more is taken
};

const char* name_of(LiveAdvice advice);  // as a person would say it: "tilt left"
// Of several things to change: "closer, lower left, tilt back".
std::string words_of(std::span<const LiveAdvice> way);
const char* name_of(PairVerdict verdict);
const char* name_of(LiveEnd end);

}  // namespace relievo::pipeline
