// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// TargetMeter: measures a target as the product measures a face: rectify, match, triangulate, reject
// outliers, mesh, with the default algorithms. Only what knows of faces stays out: no face is looked
// for (a ball around the target is the region instead, so nothing is cropped), the mesher accepts less
// surface than a face has, and the texture stage with its head frame is not run.
// Left camera's frame, millimetres.
// Memory: 0.9 GiB of address space, touched as far as the pictures need; one pool of threads.
// Errors: the stages' own; PoorGeometry (nothing measured there). Thread: worker; one caller.
#pragma once

#include <memory>
#include <vector>

#include "firmware/base/boot_memory.h"
#include "firmware/checks/optical_target.h"
#include "pipeline/model/vector3.h"
#include "pipeline/pipeline.h"

namespace relievo::firmware {

class TargetMeter {
 public:
  static Result<TargetMeter> make(const pipeline::StereoCalibration& calibration,
                                  const std::atomic<bool>& cancelled);
  TargetMeter(TargetMeter&&) noexcept;
  ~TargetMeter();

  // Rectifies the pair; it is borrowed until the next one is taken.
  Result<void> take(const TargetPictures& pictures);
  // The measured vertices of the mesh (never the bridged ones) within `reach_mm` of `centre_mm` as the
  // left rectified view shows it.
  Result<std::vector<pipeline::Vec3d>> surface_around(const pipeline::Vec3d& centre_mm, double reach_mm);
  // The rectified left view around the target, beside it the same with every point coloured by its
  // deviation: blue -range, white 0, red +range, and the scale below.
  hal::Picture picture_of(const pipeline::Vec3d& centre_mm, double reach_mm,
                          const std::vector<pipeline::Vec3d>& points_mm,
                          const std::vector<double>& deviations_mm, double range_mm) const;

 private:
  struct Circle {
    double x_px = 0, y_px = 0, radius_px = 0;
  };
  TargetMeter();
  Circle circle_around(const pipeline::Vec3d& centre_mm, double reach_mm) const;

  struct Room;  // memory, threads and the rectified pair: they stay where they are
  std::unique_ptr<Room> room_;
};

}  // namespace relievo::firmware
