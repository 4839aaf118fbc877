// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/fuse/head_pipeline.h"

#include <utility>

#include "pipeline/fuse/head_texturer.h"
#include "pipeline/mesh/landmarks/head_frame.h"
#include "pipeline/mesh/model_quality.h"

namespace relievo::pipeline {
namespace {

constexpr const char* kHeadRadiusMm = "200";  // a head with its ears, about the tip of the nose
constexpr int kCoarseTriangles = 60'000;      // enough to find a head's frame
constexpr int kMostAtlasPx = 4096;

Result<void> check_count(std::span<const HeadPose> poses) {
  if (poses.empty() || poses.size() > std::size_t(kMostPoses))
    return invalid("one to seven pairs make a head");
  return {};
}

// Its landmarks say where the master's head is.
void take_frame(const FaceModel& face, HeadPose& master) {
  master.head_from_camera = face.head_from_camera;
  master.has_head = of(face.landmarks, LandmarkName::Pronasale).found;
}

// Both cameras of every pose, the master's first.
std::pmr::vector<HeadView> views_of(std::span<const HeadPose> poses, const Registration& registration,
                                    std::pmr::memory_resource* memory) {
  std::pmr::vector<HeadView> views(memory);
  for (std::size_t k = 0; k < poses.size(); ++k)
    for (const bool right : {false, true}) {
      if (!registration.poses[k].joined) continue;
      const HeadPose& pose = poses[k];
      const RigidTransform back = inverse(registration.poses[k].first_from_pose);
      RigidTransform view_from_head = product({pose.rectified_from_camera, {}}, back);
      if (right) view_from_head.translation_mm.x -= pose.baseline_mm;
      views.push_back({.rgb = right ? pose.right_rgb : pose.left_rgb,
                       .width_px = pose.width_px,
                       .height_px = pose.height_px,
                       .focal_px = pose.focal_px,
                       .centre_px = right ? pose.right_centre_px : pose.centre_px,
                       .view_from_head = view_from_head,
                       .master = k == 0,
                       .right = right,
                       .pose = &pose,
                       .pose_from_head = back});
    }
  return views;
}

}  // namespace

Result<HeadPipeline> HeadPipeline::make(const AlgorithmSet& set) {
  HeadPipeline made(set);
  if (set.get("face.radius_mm") == AlgorithmSet{}.get("face.radius_mm"))
    RELIEVO_TRY(made.head_set_.set("face.radius_mm", kHeadRadiusMm));
  RELIEVO_TRY_ASSIGN(made.fuser_, make_head_fuser(set));
  made.asks_for_life_ = set.get("relief") != "off";
  return made;
}

Result<FaceModel> HeadPipeline::face(const StereoFrame& frame, const StereoCalibration& calibration,
                                     StageContext& context) const {
  RELIEVO_TRY_ASSIGN(const Pipeline pipeline, Pipeline::make(face_set_, calibration));
  RELIEVO_TRY_ASSIGN(RectifiedPair pair, pipeline.rectify(frame, context));
  RELIEVO_TRY_ASSIGN(const MatchSet matches, pipeline.match(pair, context));
  RELIEVO_TRY_ASSIGN(const PointCloud cloud, pipeline.reconstruct(pair, matches, context));
  RELIEVO_TRY_ASSIGN(FaceMesh mesh, pipeline.mesh(cloud, pair, context));
  return pipeline.assemble(std::move(mesh), TextureAtlas(&context.output), pair, context);
}

Result<HeadPose> HeadPipeline::measure(const StereoFrame& frame, const StereoCalibration& calibration,
                                       StageContext& context, Arena& kept) const {
  RELIEVO_TRY_ASSIGN(const Pipeline pipeline, Pipeline::make(head_set_, calibration, {}, Region::Head));
  RELIEVO_TRY_ASSIGN(RectifiedPair pair, pipeline.rectify(frame, context));
  RELIEVO_TRY_ASSIGN(const MatchSet matches, pipeline.match(pair, context));
  RELIEVO_TRY_ASSIGN(const PointCloud cloud, pipeline.reconstruct(pair, matches, context));
  StageContext keeping{kept, context.scratch, context.pool, context.progress, context.cancelled};
  RELIEVO_TRY_ASSIGN(HeadPose pose,
                     run_stage(keeping, [&](StageContext& c) { return make_head_pose(cloud, pair, c); }));
  pose.drift = judge_drift(matches.epipolar_shift, pipeline.calibration());
  const auto head = run_stage(context, [&](StageContext& c) -> Result<HeadFrame> {
    return find_head_frame(coarse_mesh(pose, kCoarseTriangles, c), c);
  });
  if (!head && head.error().code != Errc::PoorGeometry) return head.error();
  if (head) {
    pose.head_from_camera = head->head_from_camera;
    pose.has_head = true;
  }
  return pose;
}

Result<void> HeadPipeline::place_last(const FaceModel& face, std::span<HeadPose> poses,
                                      StageContext& context) const {
  RELIEVO_TRY(check_count(poses));
  take_frame(face, poses[0]);
  return run_stage(context, [&](StageContext& c) -> Result<void> {
    place_last_pose(poses, c);
    return {};
  });
}

Result<FusedHead> HeadPipeline::fuse(const FaceModel& face, std::span<HeadPose> poses,
                                     StageContext& context) const {
  RELIEVO_TRY(check_count(poses));
  take_frame(face, poses[0]);
  RELIEVO_TRY_ASSIGN(Registration registration,
                     run_stage(context, [&](StageContext& c) { return register_poses(poses, c); }));
  RELIEVO_TRY_ASSIGN(FusedSurface surface, run_stage(context, [&](StageContext& c) {
                       return fuser_.fuse(poses, registration, face.mesh, face.landmarks, c);
                     }));
  Aliveness aliveness;
  RELIEVO_TRY_ASSIGN(TextureAtlas atlas, run_stage(context, [&](StageContext& c) {
                       const auto views = views_of(poses, registration, &c.scratch);
                       aliveness = measure_aliveness(views, face.landmarks, face.head_from_camera);
                       return texture_head(surface.mesh, surface.closing, views, kMostAtlasPx, c);
                     }));
  FaceModel head(&context.output);
  head.head_from_camera = face.head_from_camera;
  head.landmarks = face.landmarks;
  head.backdrop = face.backdrop;
  head.unjudged = face.unjudged;
  if (asks_for_life_ && aliveness.verdict() == Aliveness::Verdict::NotAlive)
    head.unjudged = error_of(aliveness);
  for (const RegisteredPose& pose : registration.poses) head.poses_left_out += pose.joined ? 0 : 1;
  // Area, coverage and sigma are the whole head's; size and relief of the face stay those of the master.
  head.quality = face.quality;
  RELIEVO_TRY(run_stage(context, [&](StageContext& c) -> Result<void> {
    HeadFrame frame;
    frame.head_from_camera = head.head_from_camera;
    const ModelQuality whole = measure_quality(surface.mesh, frame, c);
    head.quality.median_sigma_mm = whole.median_sigma_mm;
    head.quality.measured_area_mm2 = whole.measured_area_mm2;
    head.quality.coverage = whole.coverage;
    head.quality.texture_sharpness = texture_sharpness(atlas, c);
    return {};
  }));
  head.mesh = std::move(surface.mesh);
  head.texture = std::move(atlas);
  return FusedHead{std::move(head), std::move(registration), aliveness};
}

}  // namespace relievo::pipeline
