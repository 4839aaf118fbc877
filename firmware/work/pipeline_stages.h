// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// PipelineStages: the stages of the machine, done by pipeline::Pipeline. Matching also judges whether
// the cameras have moved since they were calibrated (products.drift).
//
//   algorithms alone --replace()--> calibrated --replace()--> other algorithms, another calibration
//
// Errors: the stage's own, or what was wrong with the pictures where that explains it (pair_diagnosis.h);
// NotCalibrated without a calibration, and after Match where the cameras have moved too far to be measured
// with, unless told to go on. Thread: worker.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "firmware/work/stage_runner.h"
#include "pipeline/pipeline.h"

namespace relievo::firmware {

// Cameras that have moved too far to be measured with; a surface of which it is not known whether it is a
// face.
enum class WhenMoved : std::uint8_t { Refuse, GoOn };
enum class WhenUnjudged : std::uint8_t { Refuse, GoOn };

class PipelineStages final : public StageRunner {
 public:
  explicit PipelineStages(pipeline::Pipeline pipeline, WhenMoved when_moved = WhenMoved::Refuse,
                          WhenUnjudged when_unjudged = WhenUnjudged::Refuse)
      : set_(pipeline.algorithms()),
        pipeline_(std::move(pipeline)),
        when_moved_(when_moved),
        when_unjudged_(when_unjudged) {}
  // Of a device that nobody has calibrated yet.
  explicit PipelineStages(const pipeline::AlgorithmSet& set) : set_(set) {}
  const pipeline::AlgorithmSet& algorithms() const { return set_; }
  // None: there is none yet. Until replace().
  const pipeline::StereoCalibration* calibration() const {
    return pipeline_ ? &pipeline_->calibration() : nullptr;
  }
  // While no job runs.
  void replace(pipeline::Pipeline pipeline) {
    set_ = pipeline.algorithms();
    pipeline_ = std::move(pipeline);
  }
  // Matches beside the matcher's, of the pictures that are worked on. While no job runs.
  void add_by_hand(std::vector<pipeline::Match> matches) { by_hand_ = std::move(matches); }
  Result<void> run(State stage, Products& products, pipeline::StageContext& context,
                   StageRecord& record) override;
  Result<void> add_pose(const pipeline::StereoFrame& pair, const pipeline::FaceModel& face,
                        std::vector<pipeline::HeadPose>& poses, pipeline::StageContext& context,
                        Arena& kept) override;
  Result<pipeline::FusedHead> fuse(const pipeline::FaceModel& face, std::span<pipeline::HeadPose> poses,
                                   pipeline::StageContext& context) override;

 private:
  Result<void> do_stage(State stage, Products& made, pipeline::StageContext& context,
                        StageRecord& record) const;

  pipeline::AlgorithmSet set_;
  std::optional<pipeline::Pipeline> pipeline_;
  std::vector<pipeline::Match> by_hand_;
  WhenMoved when_moved_ = WhenMoved::Refuse;
  WhenUnjudged when_unjudged_ = WhenUnjudged::Refuse;
};

}  // namespace relievo::firmware
