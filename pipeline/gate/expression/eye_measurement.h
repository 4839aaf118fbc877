// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// EyeMeasurement: whether an eye is seen and how far it is open.
//
// An iris is as wide in every adult (11.7 mm, +-0.5) and dark between two bright pieces of sclera: it is
// looked for by the difference of luminance across both sides of a circle of that size (Daugman 1993's
// operator, on the sides only, since lids cover its top and bottom). A closed eye has no such pair of edges.
//
// Memory: none of its own. Thread: any. Errors: none.
#pragma once

#include <array>

#include "pipeline/gate/expression/face_window.h"

namespace relievo::pipeline {

struct EyeMeasurement {
  bool known = false;                // the window was seen whole
  double right_mm = 0, down_mm = 0;  // the middle of the iris, from the tip of the nose
  double contrast = 0;               // (sclera - iris) / (sclera + iris), the weaker side
  double brightness = 1;  // the brighter parts of the eye and its lids, share of the skin below it: dark
                          // glasses are dark all over (EyesVisible)
  double glare_mm2 = 0;   // of the eye, behind what shines before it and before the lids as well: neither
                          // sclera nor the lamp in a cornea
};

// The eye on the picture's left, then the one on its right. Where glare covers one, the other says where it
// is.
std::array<EyeMeasurement, 2> measure_eyes(const FacePhoto& photo, StageContext& context);

}  // namespace relievo::pipeline
