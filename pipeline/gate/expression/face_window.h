// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// FaceWindow: a part of the face as seen from in front of it, upright, every sample so many millimetres of
// skin: what is measured in it is metric, however far away and however turned the person stands. Taken from
// the left picture at full size (or the mean of as many pixels as a sample covers), through a plane laid into
// the part of the face that the relief knows. Luminance: mean of the channels, 0 .. 255. Axes: right and
// down, millimetres from the tip of the nose along those of HeadMeasurement. Memory: context's scratch.
// Thread: worker. Errors: none; empty() where the relief or the picture ends.
#pragma once

#include <memory_resource>
#include <vector>

#include "pipeline/gate/head/head_measurement.h"
#include "pipeline/model/calibration.h"
#include "pipeline/model/stereo_frame.h"

namespace relievo::pipeline {

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

}  // namespace relievo::pipeline
