// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// DisparityMap: a disparity for every pixel of the left rectified view, or none: what all matchers, dense or
// sparse, are compared by. Pixels; row by row; NaN where nothing is known. Thread: any. No errors.
#pragma once

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <vector>

#include "hal/base/result.h"
#include "pipeline/model/match_set.h"

namespace relievo::firmware::compare {

inline constexpr float kNoDisparity = std::numeric_limits<float>::quiet_NaN();

struct DisparityMap {
  DisparityMap() = default;
  DisparityMap(int width, int height)
      : width_px(width),
        height_px(height),
        values(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), kNoDisparity) {}

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px) + static_cast<std::size_t>(x);
  }
  bool holds(int x, int y) const { return x >= 0 && y >= 0 && x < width_px && y < height_px; }
  float at(int x, int y) const { return values[index(x, y)]; }
  bool known(int x, int y) const { return !std::isnan(at(x, y)); }

  int width_px = 0;
  int height_px = 0;
  std::vector<float> values;
};

// Of the accepted matches. Those on a lattice give the pixels between them too: bilinearly where the four
// around agree within a pixel a step, else as the nearest. Scattered ones give one pixel each.
DisparityMap disparity_map(const pipeline::MatchSet& set, int width_px, int height_px);

// Scattered disparities as squares of this side, to be looked at; what is known stays.
DisparityMap thickened(const DisparityMap& map, int side_px);

// Portable float map, one channel ("Pf", width height, scale whose sign is the byte order, rows from the
// bottom up): how Middlebury 2014 and others store disparities. Infinite or NaN is "none", both ways.
// Errors: NotFound, IoFailed, InvalidInput (not such a file, of another length), each with the file.
Result<DisparityMap> read_pfm(const std::filesystem::path& file);
std::vector<std::byte> pfm_of(const DisparityMap& map);  // little-endian

}  // namespace relievo::firmware::compare
