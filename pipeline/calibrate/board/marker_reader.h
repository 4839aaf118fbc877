// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which part of a ChArUco board a lattice is: the markers in its white squares are read, each votes for
// where the lattice lies on the board, and the place that most agree on wins.
// Inside calibrate/board/ only. Thread: any.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "pipeline/calibrate/board/board_finder.h"
#include "pipeline/calibrate/board/lattice.h"

namespace relievo::pipeline {

// The first `count` markers of OpenCV's dictionary of `bits` a side: a bit for each module without the
// border, row by row from the lowest; set: white.
std::vector<std::uint64_t> marker_modules(int bits, int count);

// The lattice's nodes in their places on the board: columns x rows of the pattern. No value where too
// few markers agree. The lattice in pixels of the picture.
std::optional<Lattice> place_on_board(const ImageView& picture, const Lattice& lattice,
                                      const BoardPattern& pattern, const std::vector<std::uint64_t>& markers);

}  // namespace relievo::pipeline
