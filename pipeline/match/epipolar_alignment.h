// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far corresponding points are from sharing a row after all, measured on the face's own texture,
// and the right view resampled so that they do.
//
// A camera that was nudged, a mount that warmed up or a pair that was not exposed at the same instant
// leaves a vertical disagreement that is, over one face, nearly linear in the picture. It is found by
// Gauss-Newton over all surface points (offset, slope in x, slope in y). What the same error does along
// the rows cannot be seen: it changes the depth of the face, not its likeness.
#pragma once

#include "pipeline/match/surface_refiner.h"

namespace relievo::pipeline {

// Add shift(x, y) to the row of a right view's pixel (full size) to reach the row of its left partner's.
struct VerticalShift {
  double offset_px = 0;
  double per_x = 0;
  double per_y = 0;
  double centre_x_px = 0;
  double centre_y_px = 0;
  double rms_px = 0;        // of the shift over the surface; 0 where there was nothing to measure
  double at(double x, double y) const { return offset_px + per_x * (x - centre_x_px) + per_y * (y - centre_y_px); }
};

// Pictures of one level; `field` holds a surface good to about a pixel of that level.
VerticalShift measure_vertical_shift(const Plane<float>& left, const Plane<float>& right, int level,
                                     const SurfaceField& field, StageContext& context);

// right(x, y) = right(x, y + shift), by cubic convolution along the columns.
void shift_rows(const VerticalShift& shift, int level, Plane<float>& right, StageContext& context);

}  // namespace relievo::pipeline
