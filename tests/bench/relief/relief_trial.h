// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One trial of the relief proof: what was shown is photographed by the simulated rig and goes through the
// whole chain with default algorithms, calibrated by the rig's truth. Accepted is what becomes a model.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "hal/sim/render.h"
#include "pipeline/fuse/aliveness.h"
#include "pipeline/relief/relief_check.h"
#include "tests/bench/relief/relief_scenes.h"
#include "tests/support/stage_fixture.h"

namespace relievo::bench {

struct Verdict {
  bool accepted = false;
  std::string why;                // it was not
  pipeline::Aliveness aliveness;  // of a head that turned
  std::optional<pipeline::ReliefFigures>
      relief;  // where there was a surface to measure: then it alone refuses
};

hal::sim::PicturePair photograph(const Trial& trial, ThreadPool& pool);
// What the kiosk makes of a head that turned: refused where its eyes were not alive.
Verdict judge_turning(std::span<const Trial> trials, std::span<const hal::sim::PicturePair> pictures,
                      test::StageFixture& room, Arena& kept);
Verdict judge(const Trial& trial, const hal::sim::PicturePair& pictures, test::StageFixture& room);

}  // namespace relievo::bench
