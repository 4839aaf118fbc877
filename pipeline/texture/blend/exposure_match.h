// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Brings the right photograph to the left one's exposure and white balance: a gain and an offset per
// channel, found on skin that both see. Reduced major axis (both pictures are noisy), repeated with
// Tukey's weights, so that highlights, hair and edges that do not meet have no say.
// (P. J. Huber, E. M. Ronchetti: Robust Statistics, 2009, ch. 7.) Grey levels, coded as captured.
#pragma once

#include <array>

#include "pipeline/texture/blend/shot_planes.h"

namespace relievo::pipeline {

struct ExposureMatch {
  std::array<float, 3> gain{1, 1, 1};
  std::array<float, 3> offset{0, 0, 0};
  std::array<float, 3> sigma{0, 0, 0};  // of left minus matched right, robust
  float matched(std::size_t channel, std::uint8_t right) const {
    return gain[channel] * static_cast<float>(right) + offset[channel];
  }
};

ExposureMatch match_exposure(const Chart& chart, const ShotPlanes& planes);

}  // namespace relievo::pipeline
