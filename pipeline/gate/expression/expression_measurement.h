// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether eyes are seen and open, the lips together, and the face at rest. Memory: context's scratch. Thread:
// worker. Errors: none.
#pragma once

#include <array>

#include "pipeline/gate/expression/face_window.h"

namespace relievo::pipeline {

// An iris is as wide in every adult (11.7 mm, +-0.5) and dark between two bright pieces of sclera: it is
// looked for by the difference of luminance across both sides of a circle of that size (Daugman 1993's
// operator, on the sides only, since lids cover its top and bottom). A closed eye has no such pair of edges.
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

// Closed lips show one dark line, thin and as long as the mouth. Parted ones show a dark gap, teeth between
// two lines, or a tongue with its shadow: there are teeth where what lies between two dark lines is evenly
// bright. A tongue put out also stands before the lips, which the relief knows. A smile draws the ends of the
// line apart and up.
struct MouthMeasurement {
  bool known = false;   // the window was seen whole
  double steps_mm = 0;  // between two thin dark lines with teeth between them, in the middle of the mouth; 0:
                        // there are none. MouthClosed
  double dark_mm2 = 0;  // thicker than a line and much darker than the skin: what shows between parted lips
  double before_mm = 0;  // how far what lies below the line stands before the upper lip
  double rise_mm = 0;    // of the corners above the middle of the line, held upright: ExpressionNeutrality
};

MouthMeasurement measure_mouth(const FacePhoto& photo, StageContext& context);

}  // namespace relievo::pipeline
