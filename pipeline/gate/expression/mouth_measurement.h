// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// MouthMeasurement: whether the lips are together and the face at rest.
//
// Closed lips show one dark line, thin and as long as the mouth. Parted ones show a dark gap, teeth between
// two lines, or a tongue with its shadow: there are teeth where what lies between two dark lines is evenly
// bright. A tongue put out also stands before the lips, which the relief knows. A smile draws the ends of the
// line apart and up.
//
// Memory: context's scratch. Thread: worker. Errors: none.
#pragma once

#include "pipeline/gate/expression/face_window.h"

namespace relievo::pipeline {

struct MouthMeasurement {
  bool known = false;   // the window was seen whole
  double steps_mm = 0;  // between two thin dark lines with teeth between them, in the middle of the mouth; 0:
                        // there are none. MouthClosed
  double dark_mm2 = 0;  // thicker than a line and much darker than the skin: what shows between parted lips
  double before_mm = 0;  // how far what lies below the line stands before the upper lip
  double width_mm = 0;   // of the line, between the corners: ExpressionNeutrality
  double rise_mm = 0;    // of the corners above the middle of the line, on a head held upright
};

MouthMeasurement measure_mouth(const FacePhoto& photo, StageContext& context);

}  // namespace relievo::pipeline
