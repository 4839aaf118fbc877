// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// GateFixture: the capture gate with room to work in, as the kiosk has it, for pictures of an Album and
// others. Thread: one caller. Errors: end the program with one line.
#pragma once

#include "pipeline/base/workspace.h"
#include "pipeline/gate/capture_gate.h"
#include "tests/support/head_album.h"

namespace relievo::test {

// Of somebody who does everything right.
pipeline::GateMeasures good_measures();

class GateFixture {
 public:
  // `reduction` of the relief: 1 for an album's pictures, which are a quarter of the rig's already.
  explicit GateFixture(int reduction = 1);
  // The relief lies in this fixture until it looks again.
  pipeline::GateLook look(const pipeline::StereoFrame& frame, const pipeline::StereoCalibration& calibration,
                          pipeline::GateTime now, pipeline::GateHistory& history);
  pipeline::GateLook look(const Album& album, const Shot& shot, const Developing& how, pipeline::GateTime now,
                          pipeline::GateHistory& history);
  // As if nothing had been seen before.
  pipeline::GateLook first_look(const pipeline::StereoFrame& frame,
                                const pipeline::StereoCalibration& calibration);
  pipeline::GateLook first_look(const Album& album, const Shot& shot, const Developing& how = {});

 private:
  pipeline::Workspace work_;
  pipeline::CaptureGate gate_;
};

}  // namespace relievo::test
