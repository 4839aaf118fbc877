// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A rectified pair whose every disparity is known in closed form: a smooth bump over a tilted plane,
// painted with band-limited texture. It shares no code with the pipeline.
#pragma once

#include <cstdint>
#include <memory_resource>

#include "pipeline/model/match_set.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::test {

struct BumpScene {
  int width_px = 320;
  int height_px = 256;
  double base_px = 20;  // disparity of the plane in the middle
  double tilt = 0.02;   // disparity per pixel of x
  double bump_px = 8;
  double bump_radius_px = 60;
  double ripple_px = 0;  // waves along x besides, amplitude
  double ripple_period_px = 31;
  double groove_px = 0;  // a groove of this depth along x besides, three quarters down
  double groove_radius_px = 3;
  double groove_dark = 0;   // share of the light that is missing at its bottom
  double contrast = 20;     // grey levels, standard deviation
  double noise = 1.0;       // grey levels, standard deviation, each view its own
  double right_gain = 1.0;  // the right camera sees gain * grey + offset
  double right_offset = 0.0;
  std::uint32_t seed = 1;
  bool face = true;  // a region is marked, the whole picture: one surface is wanted
  double rows_px =
      0;  // what belongs on row y of the right view stands on y + rows_px + rows_tilt * (x - middle)
  double rows_tilt = 0;
  double moved_px =
      0;  // and a Gaussian hill of this height, in the middle of the lower half, moved down besides
  double moved_radius_px = 40;

  double disparity(double x, double y) const;
  double ripple(double x) const;           // its wave, amplitude 1
  double groove(double y) const;           // its section, depth 1
  double moved(double x, double y) const;  // of the right view, beside rows_px and rows_tilt
  pipeline::RectifiedPair render(std::pmr::memory_resource* memory) const;
  // Inside the picture, away from its edges and from what the other view does not see.
  bool judged(double x, double y) const;
};

pipeline::Keypoints lattice(const pipeline::RectifiedPair& pair, int step_px,
                            std::pmr::memory_resource* memory);

}  // namespace relievo::test
