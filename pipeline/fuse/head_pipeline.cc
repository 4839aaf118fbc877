// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/fuse/head_pipeline.h"

#include <algorithm>
#include <utility>

#include "pipeline/fuse/head_texturer.h"
#include "pipeline/mesh/landmarks/head_frame.h"
#include "pipeline/mesh/meshers/base_sheet.h"
#include "pipeline/mesh/model_quality.h"
#include "pipeline/model/vector3.h"
#include "pipeline/texture/texture_sharpness.h"

namespace relievo::pipeline {
namespace {

constexpr const char* kHeadRadiusMm = "200";  // a head with its ears, about the tip of the nose
constexpr int kRoughTriangles = 60'000;       // enough to find a head's frame
constexpr double kRoughAreaMm2 = 3000;
constexpr int kMostAtlasPx = 4096;

void keep_photographs(const RectifiedPair& pair, HeadPose& pose) {
  pose.width_px = pair.width_px;
  pose.height_px = pair.height_px;
  pose.right_centre_px = pair.right_centre_px;
  pose.baseline_mm = pair.baseline_mm;
  pose.left_rgb.assign(pair.left.rgb.begin(), pair.left.rgb.end());
  pose.right_rgb.assign(pair.right.rgb.begin(), pair.right.rgb.end());
}

// A pair as far as its points, and what of it outlives the stages.
struct Measured {
  RectifiedPair pair;
  PointCloud cloud;
  HeadPose pose;
};
Result<Measured> measure(const Pipeline& pipeline, const StereoFrame& frame, StageContext& context,
                         Arena& kept) {
  RELIEVO_TRY_ASSIGN(RectifiedPair pair, pipeline.rectify(frame, context));
  RELIEVO_TRY_ASSIGN(const MatchSet matches, pipeline.match(pair, context));
  RELIEVO_TRY_ASSIGN(PointCloud cloud, pipeline.reconstruct(pair, matches, context));
  StageContext keeping{kept, context.scratch, context.pool, context.progress, context.cancelled};
  RELIEVO_TRY_ASSIGN(HeadPose pose, run_stage(keeping, [&](StageContext& c) -> Result<HeadPose> {
                       HeadPose made(&c.output);
                       RELIEVO_TRY_ASSIGN(made.surface, make_pose_surface(cloud, pair, c));
                       keep_photographs(pair, made);
                       return made;
                     }));
  pose.drift = judge_drift(matches.epipolar_shift, pipeline.calibration());
  return Measured{std::move(pair), std::move(cloud), std::move(pose)};
}

// Both cameras of every pose, the master's first.
std::pmr::vector<HeadView> views_of(std::span<const HeadPose> poses, const Registration& registration,
                                    std::pmr::memory_resource* memory) {
  std::pmr::vector<HeadView> views(memory);
  for (std::size_t k = 0; k < poses.size(); ++k)
    for (const bool right : {false, true}) {
      const HeadPose& pose = poses[k];
      const RigidTransform back = inverse(registration.poses[k].first_from_pose);
      HeadView view;
      view.rgb = right ? pose.right_rgb : pose.left_rgb;
      view.width_px = pose.width_px;
      view.height_px = pose.height_px;
      view.focal_px = pose.surface.focal_px;
      view.centre_px = right ? pose.right_centre_px : pose.surface.centre_px;
      view.view_from_head = product({pose.surface.rectified_from_camera, {}}, back);
      if (right) view.view_from_head.translation_mm.x -= pose.baseline_mm;
      view.master = k == 0;
      view.right = right;
      views.push_back(view);
    }
  return views;
}

}  // namespace

Result<HeadPipeline> HeadPipeline::make(const AlgorithmSet& set) {
  HeadPipeline made(set);
  if (set.get("face.radius_mm") == AlgorithmSet{}.get("face.radius_mm"))
    RELIEVO_TRY(made.set_.set("face.radius_mm", kHeadRadiusMm));
  RELIEVO_TRY_ASSIGN(made.fuser_, make_head_fuser(set));
  return made;
}

Result<FrontPose> HeadPipeline::front(const StereoFrame& frame, const StereoCalibration& calibration,
                                      StageContext& context, Arena& kept) const {
  RELIEVO_TRY_ASSIGN(const Pipeline pipeline, Pipeline::make(set_, calibration));
  RELIEVO_TRY_ASSIGN(Measured measured, measure(pipeline, frame, context, kept));
  auto& [pair, cloud, pose] = measured;
  RELIEVO_TRY_ASSIGN(FaceMesh mesh, pipeline.mesh(cloud, pair, context));
  RELIEVO_TRY_ASSIGN(FaceModel face,
                     pipeline.assemble(std::move(mesh), TextureAtlas(&context.output), pair, context));
  pose.surface.head_from_camera = face.head_from_camera;
  pose.surface.has_head = of(face.landmarks, LandmarkName::Pronasale).found;
  return FrontPose{std::move(pose), std::move(face)};
}

Result<HeadPose> HeadPipeline::turned(const StereoFrame& frame, const StereoCalibration& calibration,
                                      StageContext& context, Arena& kept) const {
  RELIEVO_TRY_ASSIGN(const Pipeline pipeline, Pipeline::make(set_, calibration, {}, Region::TurnedHead));
  RELIEVO_TRY_ASSIGN(Measured measured, measure(pipeline, frame, context, kept));
  HeadPose& pose = measured.pose;
  const auto head = run_stage(context, [&](StageContext& c) -> Result<HeadFrame> {
    RELIEVO_TRY_ASSIGN(const FaceMesh rough,
                       lattice_sheet(measured.cloud, kRoughTriangles, kRoughAreaMm2, c));
    return find_head_frame(rough, c);
  });
  if (!head && head.error().code != Errc::PoorGeometry) return head.error();
  if (head) {
    pose.surface.head_from_camera = head->head_from_camera;
    pose.surface.has_head = true;
  }
  return std::move(pose);
}

Result<FusedHead> HeadPipeline::fuse(FaceModel face, std::span<HeadPose> poses, StageContext& context) const {
  if (poses.size() > static_cast<std::size_t>(kMostPoses))
    return Error{Errc::InvalidInput, "at most seven pairs make a head"};
  std::pmr::vector<PoseSurface> surfaces(&context.output);
  for (HeadPose& pose : poses) surfaces.push_back(std::move(pose.surface));
  RELIEVO_TRY_ASSIGN(Registration registration,
                     run_stage(context, [&](StageContext& c) { return register_poses(surfaces, c); }));
  RELIEVO_TRY_ASSIGN(FaceMesh mesh, run_stage(context, [&](StageContext& c) {
                       return HeadFuser(fuser_).fuse(surfaces, registration, face.mesh, face.landmarks, c);
                     }));
  for (std::size_t k = 0; k < poses.size(); ++k) poses[k].surface = std::move(surfaces[k]);
  RELIEVO_TRY_ASSIGN(TextureAtlas atlas, run_stage(context, [&](StageContext& c) {
                       const auto views = views_of(poses, registration, &c.scratch);
                       return texture_head(mesh, views, kMostAtlasPx, c);
                     }));
  // Area, coverage and sigma are the whole head's; size and relief of the face stay those of the master.
  const ModelQuality of_face = face.quality;
  RELIEVO_TRY(run_stage(context, [&](StageContext& c) -> Result<void> {
    HeadFrame frame;
    frame.head_from_camera = face.head_from_camera;
    face.quality = measure_quality(mesh, frame, c);
    face.quality.texture_sharpness = texture_sharpness(atlas, c);
    return {};
  }));
  face.quality.relief = of_face.relief;
  face.quality.width_mm = of_face.width_mm;
  face.quality.height_mm = of_face.height_mm;
  face.quality.nose_relief_mm = of_face.nose_relief_mm;
  face.quality.symmetry_residual_mm = of_face.symmetry_residual_mm;
  face.quality.epipolar_residual_px = of_face.epipolar_residual_px;
  face.mesh = std::move(mesh);
  face.texture = std::move(atlas);
  return FusedHead{std::move(face), std::move(registration)};
}

}  // namespace relievo::pipeline
