// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether eyes are seen and open, the lips together, and the face at rest. Memory: context's scratch. Thread:
// worker. Errors: none.
#pragma once

#include <array>
#include <memory_resource>
#include <vector>

#include "pipeline/gate/head/head_measurement.h"
#include "pipeline/model/calibration.h"
#include "pipeline/model/stereo_frame.h"

namespace relievo::pipeline {

// FaceWindow: a part of the face as seen from in front of it, upright, every sample so many millimetres of
// skin: what is measured in it is metric, however far away and however turned the person stands. Taken from
// the left picture at full size (or the mean of as many pixels as a sample covers), through a plane laid into
// the part of the face that the relief knows. Luminance: mean of the channels, 0 .. 255. Axes: right and
// down, millimetres from the tip of the nose along those of HeadMeasurement. Memory: context's scratch.
// Thread: worker. Errors: none; empty() where the relief or the picture ends.
struct WindowBox {
  double right0_mm, right1_mm, down0_mm, down1_mm;
};

struct FaceWindow {
  explicit FaceWindow(std::pmr::memory_resource* memory) : grey(memory) {}
  WindowBox box{};
  int columns = 0, rows = 0;
  std::pmr::vector<float> grey;  // row by row

  static constexpr double kStepMm = 0.5;
  bool empty() const { return grey.empty(); }
  double right_mm(int x) const { return box.right0_mm + x * kStepMm; }
  double down_mm(int y) const { return box.down0_mm + y * kStepMm; }
  double column(double right_mm) const { return (right_mm - box.right0_mm) / kStepMm; }
  double row(double down_mm) const { return (down_mm - box.down0_mm) / kStepMm; }
  float at(int x, int y) const { return grey[std::size_t(y * columns + x)]; }
  // Between the samples; held at the border.
  double between(double right_mm, double down_mm) const;
};

// What the window is cut from.
struct FacePhoto {
  const StereoFrame& frame;
  const StereoCalibration& calibration;  // of the frame's size
  const Relief& relief;
  const HeadMeasurement& head;
};

FaceWindow cut_window(const FacePhoto& photo, const WindowBox& box, StageContext& context);

// The value that `share` of the samples within `box` are not above; 0 where it holds none. Memory: scratch.
double quantile(const FaceWindow& window, const WindowBox& box, double share, StageContext& context);

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
