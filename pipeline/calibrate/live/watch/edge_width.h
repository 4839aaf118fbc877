// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How sharp a board is in a picture: the distance over which its edges rise from 10 to 90 % of their
// contrast, in pixels. A well focused picture has about 2; motion and defocus widen it, motion in its
// own direction only, so edges along rows and along columns are judged apart and the wider ones count.
// Thread: any.
#pragma once

#include "hal/base/image_view.h"
#include "pipeline/calibrate/board/board_finder.h"

namespace relievo::pipeline {

// Median over the edges between neighbouring corners; corners to a pixel or so. What is wider than a
// sixth of a square measures as that. 0 where no edge can be measured.
double edge_width_px(const ImageView& picture, const BoardCorners& corners, const BoardPattern& pattern);

}  // namespace relievo::pipeline
