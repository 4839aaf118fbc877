// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/work/pipeline_stages.h"

#include <algorithm>

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
  if (!pipeline_) return uncalibrated();
  if (!is_stage(stage)) return Error{Errc::InvalidState, "is no stage of the pipeline"}.at(name_of(stage));
  const Result<void> done = do_stage(stage, products, context, record);
  // A surface that is there and has no face's relief needs no other cause.
  if (done || stage >= State::Texture || !may_be_the_pictures(done.error().code) || !products.frame)
    return done;
  if (std::optional<Error> cause = pipeline_->explain(*products.frame, context)) return *cause;
  return done;
}

Result<void> PipelineStages::do_stage(State stage, Products& made, pipeline::StageContext& context,
                                      StageRecord& record) const {
  static_assert(kStages.size() == 5);  // one more has its own branch here
  if (stage == State::Match) {
    RELIEVO_ASSERT(made.frame.has_value());
    record.in = pixels(made.frame->left) + pixels(made.frame->right);
    RELIEVO_TRY_ASSIGN(made.pair, pipeline_->rectify(*made.frame, context));
    RELIEVO_TRY_ASSIGN(made.matches, pipeline_->match(*made.pair, context));
    record.out = accepted(*made.matches);
    made.drift = pipeline::judge_drift(made.matches->epipolar_shift, pipeline_->calibration());
    if (made.drift->verdict == pipeline::DriftVerdict::Refuse && when_moved_ == WhenMoved::Refuse)
      return error_of(*made.drift);
  } else if (stage == State::Reconstruct) {
    RELIEVO_ASSERT(made.pair.has_value() && made.matches.has_value());
    record.in = accepted(*made.matches) + by_hand_.size();
    RELIEVO_TRY_ASSIGN(made.cloud, pipeline_->reconstruct(*made.pair, *made.matches, context, by_hand_));
    record.out = made.cloud->points.size();
  } else if (stage == State::Mesh) {
    RELIEVO_ASSERT(made.cloud.has_value() && made.pair.has_value());
    record.in = made.cloud->points.size();
    RELIEVO_TRY_ASSIGN(made.mesh, pipeline_->mesh(*made.cloud, *made.pair, context));
    record.out = made.mesh->triangles.size();
  } else if (stage == State::Texture) {
    RELIEVO_ASSERT(made.mesh.has_value() && made.pair.has_value());
    record.in = made.mesh->triangles.size();
    RELIEVO_TRY_ASSIGN(made.texture, pipeline_->texture(*made.mesh, *made.pair, context));
    record.out = made.texture->rgb.size() / 3;
  } else {
    RELIEVO_ASSERT(made.texture.has_value() && made.mesh.has_value() && made.pair.has_value() &&
                   made.matches.has_value());
    record.in = made.mesh->vertices_mm.size();
    RELIEVO_TRY_ASSIGN(made.model, pipeline_->assemble(std::move(*made.mesh), std::move(*made.texture),
                                                       *made.pair, context));
    made.mesh.reset();  // they live on in the model
    made.texture.reset();
    if (made.model->unjudged && when_unjudged_ == WhenUnjudged::Refuse) {
      const Error why = *made.model->unjudged;
      made.model.reset();
      return why;
    }
    made.model->quality.epipolar_residual_px = made.matches->epipolar_shift.residual_px;
    record.out = std::uint64_t(std::ranges::count_if(made.model->landmarks, &pipeline::Landmark::found));
  }
  return {};
}

}  // namespace relievo::firmware
