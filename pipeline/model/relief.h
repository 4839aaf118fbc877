// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Relief: how far away everything in the live picture is, small enough to be made many times a second. Row by
// row without padding, in pixels of a rectified left view; the frame is that of rectified_pair.h (origin in
// the left camera, x along the baseline, z away from the rig, millimetres). Plain data, to be drawn as it is.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <vector>

#include "pipeline/model/geometry.h"

namespace relievo::pipeline {

// ReliefFigures: how the middle of a face differs from a sheet of paper, flat or bent.
struct ReliefFigures {
  double covered = 0;         // share of the disc around the middle of the face that was measured
  double sigma_mm = 0;        // stated for it, median
  double off_plane_mm = 0;    // rms of the nearest three quarters off the best plane
  double off_sheet_mm = 0;    // off the best sheet, bent along any one direction
  double sheet_range_mm = 0;  // of the same, averaged over discs of 8 mm radius: 2nd to 98th percentile
  double curvature_sr = 0;    // integral of |Gaussian curvature| over the disc, steradians; what was not
                              // measured is taken to curve as the rest
};

struct Relief : PixelGrid {
  explicit Relief(std::pmr::memory_resource* memory) : depth_mm(memory), surface(memory), grey(memory) {}
  double focal_px = 0, baseline_mm = 0;
  Vec2d centre_px;
  Rotation rectified_from_left;
  std::pmr::vector<float> depth_mm;         // z; 0 where nothing is known
  std::pmr::vector<std::uint16_t> surface;  // which connected one, 1 the largest; 0: nothing is known
  std::pmr::vector<std::uint8_t> grey;      // luminance of the left view

  // Of a place between pixels; std::lround() is a call, and asked a million times a picture.
  static int nearest(double v) { return int(v + 4096.5) - 4096; }
  bool known(int x, int y) const { return depth_mm[index(x, y)] > 0; }
  Vec3d point(double x, double y, double z_mm) const {
    return {(x - centre_px.x) * z_mm / focal_px, (y - centre_px.y) * z_mm / focal_px, z_mm};
  }
  Vec3d point(int x, int y) const { return point(x, y, double(depth_mm[index(x, y)])); }
  Vec2d pixel(const Vec3d& p) const {
    return {centre_px.x + focal_px * p.x / p.z, centre_px.y + focal_px * p.y / p.z};
  }
};

}  // namespace relievo::pipeline
