// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/work/pipeline_stages.h"

#include <algorithm>
#include <array>

#include "firmware/capture/live_judge.h"
#include "hal/base/assert.h"

namespace relievo::firmware {
namespace {

std::uint64_t pixels(const ImageView& view) {
  return std::uint64_t(view.width_px) * std::uint64_t(view.height_px);
}

std::uint64_t accepted(const pipeline::MatchSet& matches) {
  return std::uint64_t(
      std::ranges::count_if(matches.matches, [](const pipeline::Match& m) { return m.rejected_by == 0; }));
}

bool may_be_the_pictures(Errc code) {
  return code == Errc::NoFace || code == Errc::TooFewMatches || code == Errc::PoorGeometry ||
         code == Errc::NotCalibrated;
}

}  // namespace

Result<void> PipelineStages::add_pose(const pipeline::StereoFrame& pair, const pipeline::FaceModel& face,
                                      std::vector<pipeline::HeadPose>& poses, pipeline::StageContext& context,
                                      Arena& kept) {
  if (!pipeline_) return uncalibrated();
  RELIEVO_TRY_ASSIGN(const auto head, pipeline::HeadPipeline::make(set_));
  RELIEVO_TRY_ASSIGN(pipeline::HeadPose pose, head.measure(pair, pipeline_->calibration(), context, kept));
  if (pose.drift.verdict == pipeline::DriftVerdict::Refuse) return error_of(pose.drift);
  poses.push_back(std::move(pose));
  const Result<void> placed = head.place_last(face, poses, context);
  if (!placed) poses.pop_back();
  return placed;
}

Result<pipeline::FusedHead> PipelineStages::fuse(const pipeline::FaceModel& face,
                                                 std::span<pipeline::HeadPose> poses,
                                                 pipeline::StageContext& context) {
  RELIEVO_TRY_ASSIGN(const auto head, pipeline::HeadPipeline::make(set_));
  RELIEVO_TRY_ASSIGN(pipeline::FusedHead fused, head.fuse(face, poses, context));
  if (fused.model.unjudged && when_unjudged_ == WhenUnjudged::Refuse) return *fused.model.unjudged;
  return fused;
}

// A face that is not found, not matched or no face's shape may be the pictures' fault: then that is told.
Result<void> PipelineStages::run(State stage, Products& products, pipeline::StageContext& context,
                                 StageRecord& record) {
  constexpr std::array kSteps{&PipelineStages::match, &PipelineStages::reconstruct, &PipelineStages::mesh,
                              &PipelineStages::texture, &PipelineStages::assemble};
  static_assert(kSteps.size() == kStages.size());
  if (!pipeline_) return uncalibrated();
  if (!is_stage(stage)) return Error{Errc::InvalidState, "is no stage of the pipeline"}.at(name_of(stage));
  Result<void> done = (this->*kSteps[number_of(stage)])(products, context, record);
  // A surface that is there and has no face's relief needs no other cause.
  if (done || stage >= State::Texture || !may_be_the_pictures(done.error().code) || !products.frame)
    return done;
  if (std::optional<Error> cause = pipeline_->explain(*products.frame, context)) return *cause;
  return done;
}

Result<void> PipelineStages::match(Products& products, pipeline::StageContext& context,
                                   StageRecord& record) const {
  RELIEVO_ASSERT(products.frame.has_value());
  record.in = pixels(products.frame->left) + pixels(products.frame->right);
  RELIEVO_TRY_ASSIGN(products.pair, pipeline_->rectify(*products.frame, context));
  RELIEVO_TRY_ASSIGN(products.matches, pipeline_->match(*products.pair, context));
  record.out = accepted(*products.matches);
  products.drift = pipeline::judge_drift(products.matches->epipolar_shift, pipeline_->calibration());
  if (products.drift->verdict != pipeline::DriftVerdict::Refuse || when_moved_ == WhenMoved::GoOn) return {};
  return error_of(*products.drift);
}

Result<void> PipelineStages::reconstruct(Products& products, pipeline::StageContext& context,
                                         StageRecord& record) const {
  RELIEVO_ASSERT(products.pair.has_value() && products.matches.has_value());
  record.in = accepted(*products.matches) + by_hand_.size();
  RELIEVO_TRY_ASSIGN(products.cloud,
                     pipeline_->reconstruct(*products.pair, *products.matches, context, by_hand_));
  record.out = products.cloud->points.size();
  return {};
}

Result<void> PipelineStages::mesh(Products& products, pipeline::StageContext& context,
                                  StageRecord& record) const {
  RELIEVO_ASSERT(products.cloud.has_value() && products.pair.has_value());
  record.in = products.cloud->points.size();
  RELIEVO_TRY_ASSIGN(products.mesh, pipeline_->mesh(*products.cloud, *products.pair, context));
  record.out = products.mesh->triangles.size();
  return {};
}

Result<void> PipelineStages::texture(Products& products, pipeline::StageContext& context,
                                     StageRecord& record) const {
  RELIEVO_ASSERT(products.mesh.has_value() && products.pair.has_value());
  record.in = products.mesh->triangles.size();
  RELIEVO_TRY_ASSIGN(products.texture, pipeline_->texture(*products.mesh, *products.pair, context));
  record.out = products.texture->rgb.size() / 3;
  return {};
}

Result<void> PipelineStages::assemble(Products& products, pipeline::StageContext& context,
                                      StageRecord& record) const {
  RELIEVO_ASSERT(products.texture.has_value() && products.mesh.has_value() && products.pair.has_value() &&
                 products.matches.has_value());
  record.in = products.mesh->vertices_mm.size();
  RELIEVO_TRY_ASSIGN(
      products.model,
      pipeline_->assemble(std::move(*products.mesh), std::move(*products.texture), *products.pair, context));
  products.mesh.reset();  // they live on in the model
  products.texture.reset();
  if (products.model->unjudged && when_unjudged_ == WhenUnjudged::Refuse) {
    const Error why = *products.model->unjudged;
    products.model.reset();
    return why;
  }
  products.model->quality.epipolar_residual_px = products.matches->epipolar_shift.residual_px;
  record.out = std::uint64_t(
      std::ranges::count_if(products.model->landmarks, [](const pipeline::Landmark& l) { return l.found; }));
  return {};
}

}  // namespace relievo::firmware
