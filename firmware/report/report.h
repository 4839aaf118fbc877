// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Report: what a reconstruction cost and how good it is; report.json. The keys are part of the
// product: scripts and benchmarks read them. Bytes, millimetres.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "firmware/work/stage_runner.h"
#include "pipeline/calibrate/drift.h"
#include "pipeline/fuse/aliveness.h"
#include "pipeline/fuse/pose_registration.h"
#include "pipeline/match/diagnose/pair_diagnosis.h"
#include "pipeline/model/face_model.h"

namespace relievo::firmware {

struct Report {
  std::string calibration;  // the file, or the store's revision
  std::string algorithms;   // "matcher = refined", one a line
  std::vector<StageRecord> stages;
  std::chrono::nanoseconds total{0};  // pictures in memory to textured model in memory
  std::uint64_t peak_rss_bytes = 0;
  pipeline::ModelQuality quality;
  std::optional<pipeline::DriftJudgement> drift;  // none where nothing was matched
  std::optional<double> motion_px;                // MatchSet::motion_px, where it is known
  pipeline::Landmarks landmarks{};                // the left camera's frame
  pipeline::RigidTransform head_from_camera{};
  std::optional<pipeline::Overexposure> white{};   // of the face, where the pictures are at hand
  std::size_t by_hand = 0;                         // matches, of those that Reconstruct took
  std::vector<pipeline::RegisteredPose> poses{};   // empty: there was one pair
  std::optional<pipeline::Aliveness> aliveness{};  // of a head from several pairs
  double skin_moved_mm = 0;                        // between them: Registration
};

std::string line_of(const StageRecord& stage);  // for a terminal
std::string line_of(std::size_t pair, const pipeline::RegisteredPose& pose);
std::string line_of(const pipeline::DriftJudgement& drift);
std::string line_of_motion(double motion_px);                    // empty where it is not worth saying
std::string line_of_light(const pipeline::Overexposure& white);  // the same
std::string report_json(const Report& report);
std::uint64_t peak_rss_bytes();  // of this process, up to now

}  // namespace relievo::firmware
