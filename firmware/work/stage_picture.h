// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a stage made, drawn small as the left camera sees it: the matches coloured by their depth over
// the photograph, the points, the surface under a lamp, the surface with its colours.
// Allocates nothing but one depth buffer or the cells of dots. Thread: worker. Errors: none; what is missing
// stays dark.
#pragma once

#include "firmware/machine/transition.h"
#include "firmware/session/session.h"
#include "firmware/session/stage_pictures.h"

namespace relievo::firmware {

void draw_stage_picture(State stage, const Products& products, StagePictures& pictures);

}  // namespace relievo::firmware
