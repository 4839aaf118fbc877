// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The figures of comparison.h that need more than a map: of matches and the places they are asked for, and
// how well a result agrees with its own two pictures. Pixels of the rectified views. Thread: worker. Errors:
// those of the steps that are run once more.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "firmware/measure/comparison.h"
#include "firmware/measure/disparity_map.h"
#include "hal/base/result.h"
#include "pipeline/algorithms.h"
#include "pipeline/base/kinds.h"
#include "pipeline/base/stage.h"
#include "pipeline/model/face_mesh.h"
#include "pipeline/model/match_set.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::firmware::compare {

// What the constraints took away, rule by rule, and whether they were right to. Thread: any. No errors.
MatchFigures figures_of(const NamedSet& set, const pipeline::Keypoints& keypoints,
                        const pipeline::MatchSet& matches, const std::optional<DisparityTruth>& truth,
                        double limit_px);

// A pixel each: 0, or 1 + the rule that took the match there. On a lattice every node stands for its cell,
// a scattered match for 9 x 9 pixels.
std::vector<std::uint8_t> rejected_map(const pipeline::MatchSet& matches, int width_px, int height_px);

// How good a selector's places are. Repeatability (Schmid, Mohr, Bauckhage 2000): the selector is asked for
// the right view as well; of the left's places, those that both views see by the truth (without one: whose
// match was accepted) should be chosen there again, within kRepeatedPx.
inline constexpr double kRepeatedPx = 1.5;

// Places of the right view, by its own axes: the selector is given the pair with its views exchanged.
// A face region goes with it, brought over by `map`. Errors: the selector's.
Result<pipeline::Keypoints> select_in_right(const pipeline::KeypointSelector& selector,
                                            const pipeline::RectifiedPair& pair, const DisparityMap& map,
                                            pipeline::StageContext& context);

SelectorFigures selector_figures(const pipeline::RectifiedPair& pair, const pipeline::Keypoints& left,
                                 const pipeline::Keypoints& right, const pipeline::MatchSet& matches,
                                 const std::optional<DisparityTruth>& truth);

// What can be said where nothing is known to be true. None of it sees an error that both views share (a wrong
// calibration, motion along the rows).

// The same pair seen in a mirror, so that the right view is the left one: x becomes width - 1 - x,
// disparities keep their sign and size. The region comes over by `map`, the left view's disparities.
pipeline::RectifiedPair mirrored(const pipeline::RectifiedPair& pair, const DisparityMap& map);

// What the mesh (mm, left camera's frame) shows the left view.
DisparityMap model_view(const pipeline::RectifiedPair& pair, const pipeline::FaceMesh& mesh);

// Matches the mirrored pair with the set's own algorithms and compares each pixel's disparity with that of
// its partner. `map` holds accepted matches of a lattice; `model`, where there is one, the part of it that
// was kept.
Result<LeftRightFigures> left_right_figures(const pipeline::RectifiedPair& pair,
                                            const pipeline::AlgorithmSet& set, const DisparityMap& map,
                                            const std::optional<DisparityMap>& model,
                                            pipeline::StageContext& context);

// The right view is predicted from the left through the model and compared with what the camera saw, as it
// was given to the matcher: zero-mean normalised correlation in windows of kPhotoWindowPx.
inline constexpr int kPhotoWindowPx = 15;
PhotoFigures photo_figures(const pipeline::RectifiedPair& pair, const DisparityMap& model,
                           pipeline::StageContext& context);

}  // namespace relievo::firmware::compare
