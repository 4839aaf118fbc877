// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The relief as grey values to look at: near is bright (255 at near_mm, 40 at far_mm, even steps of
// disparity), 0 is unknown. Thread: any. Errors: none.
#pragma once

#include <cstdint>

#include "pipeline/model/relief.h"

namespace relievo::pipeline {

// `grey`: width_px * height_px values, row by row without padding.
void draw_relief(const Relief& relief, double near_mm, double far_mm, std::uint8_t* grey);

}  // namespace relievo::pipeline
