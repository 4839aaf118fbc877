// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// LatticeSearch: the best whole disparity of every node of a lattice over the whole volume. The windows'
// sums run down the columns and are joined across (McDonnell 1981; Faugeras et al. 1993, INRIA RR-2013),
// one disparity after the other, so that the cost does not depend on the window and the memory does not
// depend on the range: a few rows a band, one score and one disparity a pixel of a lattice row.
// Sums are single precision, started afresh every band: a search, not the last word (patch_scores.h).
// Parallel in bands of lattice rows; results do not depend on the number of threads.
#pragma once

#include "pipeline/match/window/patch_scores.h"

namespace relievo::pipeline {

struct LatticeRows {
  int first_px = 0;
  int step_px = 1;
  int count = 0;
};

inline constexpr int kNoCandidate = -1'000'000;

// best.row(j)[x]: the disparity of pixel (x, rows.first_px + j * rows.step_px), kNoCandidate where no
// window fits (or no correlation is positive). Stopped early where the context says so.
void search_lattice(const ChannelPlanes& planes, WindowScore score, const DisparityRange& range,
                    const LatticeRows& rows, StageContext& context, Plane<int>& best);

}  // namespace relievo::pipeline
