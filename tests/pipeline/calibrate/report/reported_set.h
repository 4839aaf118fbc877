// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A simulated set with everything a report has to tell: good pairs, one that slipped, one with a stray
// corner, one without a board, and names that a page must not take for its own words.
#pragma once

#include "pipeline/calibrate/report/calibration_report.h"
#include "tests/pipeline/calibrate/simulated_boards.h"

namespace relievo::tests {

inline constexpr const char* kWickedName = "<script>alert(\"&1'\")</script>";

struct ReportedSet {
  explicit ReportedSet(unsigned seed = 3) : boards(SimulatedRig{}, 0.05, seed) {
    boards.add(12);
    boards.add(boards.random_slip(0.004, 0.5));
    boards.add(2);
    pipeline::CalibratorInput& input = boards.input();
    input.views[2].right[7].x += 3;  // stray
    input.views[5].left.clear();
    input.views[12].name = kWickedName;  // the one that slipped
    input.views[13].name = "caf\xE9";    // no UTF-8
    auto done = pipeline::calibrate(input);
    if (done) output = *std::move(done);
  }

  pipeline::CalibrationReport report() {
    return {boards.input(), output, "Relievo 1.2.3", "2026-03-14 09:26 UTC", "boards <i>of</i> March", {}};
  }

  BoardSimulator boards;
  pipeline::CalibratorOutput output;
};

}  // namespace relievo::tests
