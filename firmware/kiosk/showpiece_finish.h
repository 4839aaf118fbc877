// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the head of the page that invites gets beyond what was measured, so that it is whole from across a room: pinholes are
// closed and its rim is an even oval. Only a showpiece; a visitor's portrait is never touched by it.
// Lengths in mm, the oval in the head frame. Memory: the model's own. Errors: none. Thread: any.
#pragma once

#include "pipeline/model/face_model.h"

namespace relievo::firmware {

// |x / half_width|^n + |y / (up or down)|^n = 1 (Lame's oval): fuller than an ellipse.
struct ShowpieceOval {
  double half_width_mm = 57;
  double middle_mm = 18;            // of its height, above the tip of the nose
  double up_mm = 84, down_mm = 84;  // from there
  double power = 2.4;
};

// Every hole whose edge is no longer than `longest_mm`; the rim of the surface is longer.
void close_holes(pipeline::FaceModel& model, double longest_mm);
// Triangles that the oval crosses are cut along it; vertices that nothing uses any more are taken out.
void cut_to_oval(pipeline::FaceModel& model, const ShowpieceOval& oval);

}  // namespace relievo::firmware
