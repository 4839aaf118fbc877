// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// PipelineStages: the four stages of the machine, done by pipeline::Pipeline.
// Errors: the stage's own. Thread: worker.
#pragma once

#include "firmware/work/stage_runner.h"
#include "pipeline/pipeline.h"

namespace relievo::firmware {

class PipelineStages final : public StageRunner {
 public:
  explicit PipelineStages(pipeline::Pipeline pipeline) : pipeline_(std::move(pipeline)) {}
  const pipeline::Pipeline& pipeline() const { return pipeline_; }
  Result<void> run(State stage, Products& products, pipeline::StageContext& context, StageRecord& record) override;

 private:
  Result<void> match(Products& products, pipeline::StageContext& context, StageRecord& record) const;
  Result<void> reconstruct(Products& products, pipeline::StageContext& context, StageRecord& record) const;
  Result<void> mesh(Products& products, pipeline::StageContext& context, StageRecord& record) const;
  Result<void> texture(Products& products, pipeline::StageContext& context, StageRecord& record) const;

  pipeline::Pipeline pipeline_;
};

}  // namespace relievo::firmware
