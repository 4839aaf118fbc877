// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a lattice's own regularity tells: where corners are that the search overlooked, and which of
// those found do not belong. Inside calibrate/board/ only. Thread: any.
#pragma once

#include "pipeline/calibrate/board/corner_refiner.h"
#include "pipeline/calibrate/board/lattice.h"

namespace relievo::pipeline {

// Moves every node to the corner's exact place; forgets those that are no trustworthy corners.
void refine_nodes(CornerRefiner& refiner, Lattice& lattice);

// Looks for every unseen node beside seen ones, over and over, until nothing more is found.
void fill_gaps(CornerRefiner& refiner, Lattice& lattice);

// Forgets nodes that are not where their neighbours say: off by more than `least_px` and by far more
// than is usual here.
void drop_strays(Lattice& lattice, double least_px);

// The usual distance between neighbours, px.
double step_px(const Lattice& lattice);

}  // namespace relievo::pipeline
