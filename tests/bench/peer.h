// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The peer: OpenCV's semi-global matcher (three-way mode) on the same rectified pair.
#pragma once

#include "pipeline/model/rectified_pair.h"

namespace relievo::bench {

// Returns the number of pixels that got a disparity.
long match_like_the_peer(const pipeline::RectifiedPair& pair);

}  // namespace relievo::bench
