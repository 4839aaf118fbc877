// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// StageRunner: runs one of the stages of the pipeline on a session's products. The seam between
// the state machine and the mathematics: tests put stages here that fail on purpose.
// Errors: the stage's own. Thread: worker.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "firmware/machine/machine.h"
#include "firmware/session/session.h"
#include "pipeline/base/stage.h"
#include "pipeline/fuse/head_pipeline.h"

namespace relievo::firmware {

// StageRecord: what one stage cost and made.
struct StageRecord {
  std::string_view name;  // of the state
  std::chrono::nanoseconds took{0};
  std::uint64_t in = 0;              // what the stage was given: pixels, matches, points, triangles
  std::uint64_t out = 0;             // and what it made: matches, points, triangles, texels
  std::size_t arena_peak_bytes = 0;  // of both arenas together
};

class StageRunner {
 public:
  virtual ~StageRunner() = default;
  // `stage` is one of kStages; the products of the stages before are there.
  // Fills in and out of the record.
  virtual Result<void> run(State stage, Products& products, pipeline::StageContext& context,
                           StageRecord& record) = 0;
  // Of a head that turned: adds one of its pairs, the front's first, whose face is given; what it shows is
  // kept in `kept`. And the head of all pairs (pipeline/fuse/head_pipeline.h).
  virtual Result<void> add_pose(const pipeline::StereoFrame& pair, const pipeline::FaceModel& face,
                                std::vector<pipeline::HeadPose>& poses, pipeline::StageContext& context,
                                Arena& kept) = 0;
  virtual Result<pipeline::FusedHead> fuse(const pipeline::FaceModel& face,
                                           std::span<pipeline::HeadPose> poses,
                                           pipeline::StageContext& context) = 0;
};

}  // namespace relievo::firmware
