// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pipeline: the stages in their order, each with the algorithm chosen for it. Data flows one way:
//
//   StereoFrame -> RectifiedPair -> MatchSet -> PointCloud -> FaceMesh -> TextureAtlas -> FaceModel
//
// Every product lives in the context's `output`; `scratch` is swept after every call. A call is one
// stage on the technician's page: Match (rectify and match), Reconstruct, Mesh, Texture, Assemble.
// Thread: worker; holds no state between calls.
#pragma once

#include <optional>
#include <span>

#include "pipeline/algorithms.h"
#include "pipeline/base/stage.h"
#include "pipeline/match/rectify/rectifier.h"
#include "pipeline/match/region/face_region.h"
#include "pipeline/model/calibration.h"
#include "pipeline/model/face_model.h"
#include "pipeline/model/match_set.h"
#include "pipeline/model/point_cloud.h"
#include "pipeline/model/rectified_pair.h"
#include "pipeline/model/stereo_frame.h"

namespace relievo::pipeline {

// Face: what lies around the face that was found. Head: the whole view, taken for skin: no detector says
// where a turned head ends. All: the whole view, taken for anything. Only a face is cropped.
enum class Region : std::uint8_t { Face, Head, All };

class Pipeline {
 public:
  // Errors: InvalidInput (options; a mesher for lattices with scattered matches), NotFound,
  // StoreCorrupt or LibraryFailed (the face detector's files).
  static Result<Pipeline> make(const AlgorithmSet& set, const StereoCalibration& calibration,
                               const RectifierOptions& volume = {}, Region region = Region::Face);

  // Errors: InvalidInput (pictures that are not this calibration's), NoFace, Cancelled, OutOfMemory.
  Result<RectifiedPair> rectify(const StereoFrame& frame, StageContext& context) const;
  // The pair's grey values are then what the preprocessor made of them. Errors: TooFewMatches, NoFace,
  // Cancelled, OutOfMemory.
  Result<MatchSet> match(RectifiedPair& pair, StageContext& context) const;
  // `by_hand`: matches beside those (match/hand/hand_matches.h).
  Result<PointCloud> reconstruct(const RectifiedPair& pair, const MatchSet& matches, StageContext& context,
                                 std::span<const Match> by_hand = {}) const;
  // Errors: those of Mesher.
  Result<FaceMesh> mesh(const PointCloud& cloud, const RectifiedPair& pair, StageContext& context) const;
  // Errors: Cancelled, OutOfMemory.
  Result<TextureAtlas> texture(const FaceMesh& mesh, const RectifiedPair& pair, StageContext& context) const;
  // Takes mesh and texture over into the model, where it succeeds; finds its head frame, landmarks, quality
  // and backdrop. It says where it could not be told whether that is a face (FaceModel::unjudged; never with
  // Region::All or relief=off). Errors: NoFace (a picture was held up; never so either), Cancelled,
  // OutOfMemory.
  Result<FaceModel> assemble(FaceMesh&& mesh, TextureAtlas&& texture, const RectifiedPair& pair,
                             StageContext& context) const;

  // After a failure: what is wrong with the pictures, if anything is. May take as long as a match.
  std::optional<Error> explain(const StereoFrame& frame, StageContext& context) const;

  const StereoCalibration& calibration() const { return calibration_; }
  const AlgorithmSet& algorithms() const { return set_; }

 private:
  Pipeline() = default;
  std::size_t surface_matches(const StereoFrame& frame, StageContext& context) const;
  Result<void> judge_relief(FaceModel& model, const FaceMesh& mesh, const RectifiedPair& pair,
                            StageContext& context) const;
  AlgorithmSet set_;
  StereoCalibration calibration_;
  RectifierOptions volume_;
  Region region_ = Region::Face;
  std::optional<FaceFinder> finder_;  // none where the whole view is wanted
  Algorithms chosen_;
};

}  // namespace relievo::pipeline
