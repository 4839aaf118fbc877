// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// RectifiedPair: both pictures resampled so that a point of the scene lies on the same row in each.
//
// Both windows have the same size, focal length and vertical centre. Each has a horizontal centre of
// its own, laid over its picture, so that a toed-in rig is neither zoomed nor cut:
//   disparity_px = x_left - x_right (window pixels)
//   z_mm = focal_px * baseline_mm / (disparity_px - disparity_at_infinity_px())
//   x_mm = (x_left - left_centre_px.x) * z / focal_px,  y_mm = (y - left_centre_px.y) * z / focal_px
// in the rectified frame, whose origin is the left camera; p_left = rectified_from_left^T * p.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <vector>

#include "hal/base/result.h"
#include "pipeline/model/calibration.h"
#include "pipeline/model/geometry.h"

namespace relievo::pipeline {

// Shared by all rows: width_px * height_px values, no padding.
struct RectifiedView {
  explicit RectifiedView(std::pmr::memory_resource* memory)
      : grey(memory), rgb(memory), valid(memory), mirrored(memory) {}
  std::pmr::vector<float> grey;          // 0..255, luminance
  std::pmr::vector<std::uint8_t> rgb;    // 3 a pixel, as captured
  std::pmr::vector<std::uint8_t> valid;  // 1 where the source picture covers the pixel
  // Grey levels by which lamps that skin mirrors make the pixel brighter. Empty: nobody has looked for them.
  std::pmr::vector<std::uint8_t> mirrored;
  // Share of what single pores mirror that is still in `grey`, 0 to 1: coarse colours cannot tell it.
  float pores_left = 0;
};

struct RectifiedPair : PixelGrid {
  explicit RectifiedPair(std::pmr::memory_resource* memory) : left(memory), right(memory), region(memory) {}
  double focal_px = 0;
  double baseline_mm = 0;
  Vec2d left_centre_px;
  Vec2d right_centre_px;           // .y equals left_centre_px.y
  double near_mm = 0, far_mm = 0;  // the volume in which a surface is looked for
  Rotation rectified_from_left;
  Rotation rectified_from_right;
  RigidTransform right_from_left;  // of the cameras, as calibrated
  RectifiedView left;
  RectifiedView right;
  Vec2d face_centre_px;      // where the face was found in the left view, between eyes and mouth
  double face_width_px = 0;  // about 150 mm on a grown-up; 0 where no face was looked for
  double face_reach_mm = 0;  // what lies further from the tip of its nose is not wanted; 0: everything is
  std::pmr::vector<std::uint8_t> region;  // left view: 1 where the face may be; empty means everywhere

  double disparity_at_infinity_px() const { return left_centre_px.x - right_centre_px.x; }
  double depth_mm(double disparity_px) const {
    return focal_px * baseline_mm / (disparity_px - disparity_at_infinity_px());
  }
  double disparity_px(double depth_mm) const {
    return focal_px * baseline_mm / depth_mm + disparity_at_infinity_px();
  }
  // In the left camera's frame.
  Vec3d right_camera_mm() const { return apply(transposed(rectified_from_left), Vec3d{baseline_mm, 0, 0}); }
};

// Both views hold width_px * height_px values. Error: InvalidInput.
inline Result<void> check_pixels(const RectifiedPair& pair) {
  const bool none = pair.width_px <= 0 || pair.height_px <= 0;
  for (const RectifiedView* view : {&pair.left, &pair.right})
    if (none || view->grey.size() != pair.pixels() || view->valid.size() != pair.pixels())
      return invalid("the rectified pair has no pixels");
  return {};
}

}  // namespace relievo::pipeline
