// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The kinds of algorithms, in the order in which data goes through them. An algorithm is a struct of its
// options with a const member function of the kind's form; any thread may call it.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "pipeline/base/stage.h"
#include "pipeline/model/face_mesh.h"
#include "pipeline/model/match_set.h"
#include "pipeline/model/point_cloud.h"
#include "pipeline/model/rectified_pair.h"
#include "pipeline/model/texture_atlas.h"

namespace relievo::pipeline {

// Changes the grey values that selectors and matchers see, in place; geometry, colours (the texture is laid
// from them) and the face region stay as they are. Errors: OutOfMemory, Cancelled, InvalidInput (a pair
// without pixels): what the grey values are then is not said.
using Preprocessor = std::function<Result<void>(RectifiedPair& pair, StageContext& context)>;

// Chooses the places of the left rectified view that are to be matched.
// Errors: NoFace (nothing to choose from), OutOfMemory, Cancelled.
using KeypointSelector = std::function<Result<Keypoints>(const RectifiedPair& pair, StageContext& context)>;

// Finds where each left keypoint appears in the right image. A keypoint without a believable partner is left
// out of the result. Errors: TooFewMatches, OutOfMemory, Cancelled, InvalidInput (a pair without pixels).
using Matcher = std::function<Result<MatchSet>(const RectifiedPair& pair, const Keypoints& keypoints,
                                               StageContext& context)>;

// Judges matches; marks the ones it rejects with its bit and erases none, so that the technician can see
// which rule took a point away. Matches already rejected are not asked.
using MatchConstraint = std::function<void(const RectifiedPair& pair, std::span<Match> matches,
                                           int lattice_step_px, std::uint16_t bit, StageContext& context)>;

// Accepted matches to points in the left camera's frame, millimetres.
// Errors: TooFewMatches, OutOfMemory, Cancelled.
using Triangulator = std::function<Result<PointCloud>(const RectifiedPair& pair, const MatchSet& matches,
                                                      StageContext& context)>;

// Takes points out of a cloud that do not belong to its surface. The cloud shrinks in place and keeps its
// order. Thread: any. Errors: Cancelled; throws std::bad_alloc as every stage does.
using OutlierFilter = std::function<Result<void>(PointCloud& cloud, StageContext& context)>;

// What is less certain along the line of sight (a chin that moved between the exposures, hair) is surface,
// but not measured: whichever mesher ran, a head's frame and its landmarks are found on the same.
inline constexpr double kMeasuredSigmaMm = 0.75;

// Points to one connected, consistently oriented surface with normals. Errors: PoorGeometry (no surface of a
// face's size), InvalidInput (it needs more triangles than allowed), OutOfMemory, Cancelled.
using Mesher = std::function<Result<FaceMesh>(const PointCloud& cloud, StageContext& context)>;

// Gives a measured surface what the cameras did not see. Completed vertices carry measured = 0 and a sigma_mm
// of their own; what was measured stays bit for bit where it is. One connected manifold surface comes out. A
// surface in which no head is found, or to which nothing can be added, comes back as it is. Errors:
// OutOfMemory, Cancelled. `across`: which way runs across the person, as find_head_frame() wants it.
using Completion = std::function<Result<FaceMesh>(FaceMesh mesh, const Vec3d& across, StageContext& context)>;

// Lays the pictures of both views over the surface.
// Errors: OutOfMemory, Cancelled, InvalidInput (a mesh without triangles).
using Texturer = std::function<Result<TextureAtlas>(const FaceMesh& mesh, const RectifiedPair& pair,
                                                    StageContext& context)>;

}  // namespace relievo::pipeline
