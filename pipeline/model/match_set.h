// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Match: where a keypoint of the left rectified view appears in the right one, on the same row.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <vector>

#include "pipeline/model/geometry.h"

namespace relievo::pipeline {

struct Match {
  Vec2f left_px;
  float disparity_px = 0;
  float cost = 0;                 // 0 perfect .. 1 unrelated: 1 - zero-mean correlation where the matcher has one
  float sigma_px = 0;             // one standard deviation of disparity_px
  std::uint16_t rejected_by = 0;  // bit n: constraint n of the set; 0 means accepted
};

struct MatchSet {
  explicit MatchSet(std::pmr::memory_resource* memory) : matches(memory) {}
  std::pmr::vector<Match> matches;
  float epipolar_residual_px = 0; // rms vertical disagreement of the matches before any realignment; 0 where not measured
  int lattice_step_px = 0;        // as in Keypoints: left_px of accepted and rejected lie on a lattice
};

}  // namespace relievo::pipeline
