// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How well a result agrees with its own two pictures: what can be said where nothing is known to be true.
// None of it sees an error that both views share (a wrong calibration, motion along the rows).
// Pixels of the rectified views. Thread: worker. Errors: those of the steps that are run once more.
#pragma once

#include <optional>

#include "firmware/measure/comparison.h"
#include "firmware/measure/disparity_map.h"
#include "hal/base/result.h"
#include "pipeline/algorithms.h"
#include "pipeline/base/stage.h"
#include "pipeline/model/face_mesh.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::firmware::compare {

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
