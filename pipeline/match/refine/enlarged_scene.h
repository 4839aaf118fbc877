// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A small picture of a scene (no face was looked for) is matched at twice its size: semi-global matching then
// sees every pixel, not every second one, and a bar six pixels wide is no longer taken for its neighbour.
// Cubic between pixels (Keys 1981, a = -1/2), each new one a quarter of a pixel off an old one, so that all
// are equally sharp. Memory: what is enlarged lies in the arena given. Thread: any. Errors: none; throws
// std::bad_alloc.
#pragma once

#include <memory_resource>

#include "pipeline/model/keypoint.h"
#include "pipeline/model/match_set.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::pipeline {

// Whether a pair is one: as large as may be matched at twice its size in the memory there is for a face.
bool is_small_scene(const RectifiedPair& pair);

// Grey values and what is valid; colours are left behind.
RectifiedPair enlarge(const RectifiedPair& pair, std::pmr::memory_resource* memory);
Keypoints enlarge(const Keypoints& keypoints, std::pmr::memory_resource* memory);

// What was found of an enlarged pair, in the pixels of the pair itself, for keypoints on a lattice of this
// step.
void shrink(MatchSet& matches, int lattice_step_px);

}  // namespace relievo::pipeline
