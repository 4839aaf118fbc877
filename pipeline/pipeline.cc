// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/pipeline.h"

#include <cmath>
#include <utility>

#include "pipeline/calibrate/drift.h"
#include "pipeline/match/diagnose/pair_diagnosis.h"
#include "pipeline/match/hand/hand_matches.h"
#include "pipeline/mesh/eyes/eyeballs.h"
#include "pipeline/mesh/landmarks/head_frame.h"
#include "pipeline/mesh/landmarks/landmark_finder.h"
#include "pipeline/mesh/model_quality.h"
#include "pipeline/texture/backdrop_maker.h"

namespace relievo::pipeline {
namespace {

constexpr double kReachBeyondCrop = 1.15;  // so that the rough surface's own error cuts nothing off

// From the left camera's centre to the right one's, in the left one's frame.
Vec3d across(const StereoCalibration& calibration) {
  const Vec3d centre = inverse(calibration.right_from_left).translation_mm;
  const double length = std::hypot(centre.x, centre.y, centre.z);
  return length > 0 ? Vec3d{centre.x / length, centre.y / length, centre.z / length} : Vec3d{1, 0, 0};
}

}  // namespace

Result<Pipeline> Pipeline::make(const AlgorithmSet& set, const StereoCalibration& calibration,
                                const RectifierOptions& volume, Region region) {
  Pipeline pipeline;
  pipeline.set_ = set;
  pipeline.calibration_ = calibration;
  RELIEVO_TRY(volume.check());
  pipeline.volume_ = volume;
  pipeline.region_ = region;
  if (region == Region::Face) {
    RELIEVO_TRY_ASSIGN(pipeline.finder_, FaceFinder::open());
  }
  RELIEVO_TRY_ASSIGN(pipeline.chosen_, make_algorithms(set));
  RELIEVO_TRY(check_neighbours(set));
  return pipeline;
}

Result<RectifiedPair> Pipeline::rectify(const StereoFrame& frame, StageContext& context) const {
  return run_stage(context, [&](StageContext& c) -> Result<RectifiedPair> {
    RELIEVO_TRY_ASSIGN(RectifiedPair pair, volume_.rectify(frame, calibration_, c));
    if (region_ == Region::Head) pair.region.assign(pair.left.valid.size(), 1);
    if (!finder_) return pair;
    RELIEVO_TRY_ASSIGN(const FaceBox box, find_face(*finder_, pair, c));
    RELIEVO_TRY(mark_face_region(pair, box, c));
    pair.face_reach_mm = kReachBeyondCrop * chosen_.crop.radius_mm;
    return pair;
  });
}

// How many matches of a pair stay in the surface: none where there is no surface, its rows are out of step,
// or most matches lie beside it, as those do that are alike by chance.
std::size_t Pipeline::surface_matches(const StereoFrame& frame, StageContext& context) const {
  constexpr std::size_t kLeastShare = 6;  // one in so many
  Arena::Mark mark(context.output);
  auto pair = rectify(frame, context);
  if (!pair) return 0;
  const auto matches = match(*pair, context);
  if (!matches || judge_drift(matches->epipolar_shift, calibration_).verdict == DriftVerdict::Refuse)
    return 0;
  const auto cloud = reconstruct(*pair, *matches, context);
  return cloud && kLeastShare * cloud->points.size() > matches->matches.size() ? cloud->points.size() : 0;
}

std::optional<Error> Pipeline::explain(const StereoFrame& frame, StageContext& context) const {
  std::optional<PairFault> fault;
  const Result<void> looked = run_stage(context, [&](StageContext& c) -> Result<void> {
    fault = diagnose_pair(frame, calibration_, volume_, c);
    return {};
  });
  if (!looked || context.stop()) return std::nullopt;
  const bool light = fault && error_of(*fault).code == Errc::NoFace;
  const StereoFrame swapped{frame.right, frame.left, frame.sequence, frame.skew_ns};
  if (!light && fault != PairFault::SamePicture &&
      surface_matches(swapped, context) > 2 * surface_matches(frame, context))
    fault = PairFault::Swapped;
  return fault ? std::optional(error_of(*fault)) : std::nullopt;
}

Result<MatchSet> Pipeline::match(RectifiedPair& pair, StageContext& context) const {
  if (chosen_.preprocessor)
    RELIEVO_TRY(run_stage(context, [&](StageContext& c) { return chosen_.preprocessor(pair, c); }));
  RELIEVO_TRY_ASSIGN(const Keypoints keypoints,
                     run_stage(context, [&](StageContext& c) { return chosen_.selector(pair, c); }));
  RELIEVO_TRY_ASSIGN(
      MatchSet set, run_stage(context, [&](StageContext& c) { return chosen_.matcher(pair, keypoints, c); }));
  std::uint16_t bit = 1;
  for (const auto& constraint : chosen_.constraints) {
    RELIEVO_TRY(run_stage(context, [&](StageContext& c) -> Result<void> {
      constraint(pair, set.matches, set.lattice_step_px, bit, c);
      return {};
    }));
    bit = std::uint16_t(bit << 1);
  }
  return set;
}

Result<PointCloud> Pipeline::reconstruct(const RectifiedPair& pair, const MatchSet& matches,
                                         StageContext& context, std::span<const Match> by_hand) const {
  return run_stage(context, [&](StageContext& c) -> Result<PointCloud> {
    std::optional<MatchSet> joined;
    if (!by_hand.empty()) {
      RELIEVO_TRY_ASSIGN(joined, join_by_hand(pair, matches, by_hand, c));
    }
    RELIEVO_TRY_ASSIGN(PointCloud cloud, chosen_.triangulator(pair, joined ? *joined : matches, c));
    RELIEVO_TRY(crop_to_face(cloud, pair, chosen_.crop, c));
    const PointsByHand kept(cloud, by_hand, &c.scratch);
    if (chosen_.outliers) RELIEVO_TRY(chosen_.outliers(cloud, c));
    kept.put_back(cloud);
    return cloud;
  });
}

Result<FaceMesh> Pipeline::mesh(const PointCloud& cloud, const RectifiedPair& pair,
                                StageContext& context) const {
  return run_stage(context, [&](StageContext& c) -> Result<FaceMesh> {
    RELIEVO_TRY_ASSIGN(FaceMesh mesh, chosen_.mesher(cloud, c));
    if (const auto head = find_head_frame(mesh, c, across(calibration_)))
      lay_eyeballs(mesh, head->head_from_camera, pair, c);
    return chosen_.completion(std::move(mesh), across(calibration_), c);
  });
}

// Before anything that takes a face for granted looks at the surface.
Result<void> Pipeline::judge_relief(FaceModel& model, const FaceMesh& mesh, const RectifiedPair& pair,
                                    StageContext& context) const {
  if (region_ != Region::Face) return {};
  RELIEVO_TRY_ASSIGN(const ReliefFigures relief, measure_relief(mesh, pair, context));
  model.quality.relief = relief;
  if (!chosen_.relief) return {};
  const ReliefVerdict verdict = judge(relief, *chosen_.relief);
  if (verdict == ReliefVerdict::Picture) return error_of(verdict, relief, *chosen_.relief);
  return {};
}

Result<TextureAtlas> Pipeline::texture(const FaceMesh& mesh, const RectifiedPair& pair,
                                       StageContext& context) const {
  return run_stage(context, [&](StageContext& c) { return chosen_.texturer(mesh, pair, c); });
}

Result<FaceModel> Pipeline::assemble(FaceMesh&& mesh, TextureAtlas&& texture, const RectifiedPair& pair,
                                     StageContext& context) const {
  return run_stage(context, [&](StageContext& c) -> Result<FaceModel> {
    FaceModel model(&c.output);
    RELIEVO_TRY(judge_relief(model, mesh, pair, c));
    const double* x_axis = pair.rectified_from_left.m;
    const Vec3d across{x_axis[0], x_axis[1], x_axis[2]};
    const auto head = find_head_frame(mesh, c, across);
    if (!head && head.error().code != Errc::PoorGeometry) return head.error();
    const HeadFrame frame = head ? *head : frame_as_seen(mesh, c);
    model.head_from_camera = frame.head_from_camera;
    if (head) {
      const auto eyes = find_lids(mesh, frame.head_from_camera, pair, c);
      RELIEVO_TRY_ASSIGN(model.landmarks, find_landmarks(mesh, frame.head_from_camera, eyes, c));
      model.backdrop = make_backdrop(mesh, frame.head_from_camera, pair, c);
    }
    if (region_ == Region::Face) model.unjudged = why_unjudged(model, chosen_.relief);
    const ReliefFigures relief = model.quality.relief;
    model.quality = measure_quality(mesh, frame, c);
    model.quality.relief = relief;
    model.quality.texture_sharpness = texture_sharpness(texture, c);
    model.mesh = std::move(mesh);
    model.texture = std::move(texture);
    return model;
  });
}

}  // namespace relievo::pipeline
