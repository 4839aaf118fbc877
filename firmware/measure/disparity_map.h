// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// DisparityMap: a disparity for every pixel of the left rectified view, or none: what all matchers, dense or
// sparse, are compared by. Pixels; row by row; NaN where nothing is known. Thread: any. No errors.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <vector>

#include "firmware/measure/truth_view.h"
#include "hal/base/result.h"
#include "pipeline/model/match_set.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::firmware::compare {

inline constexpr float kNoDisparity = std::numeric_limits<float>::quiet_NaN();

struct DisparityMap {
  DisparityMap() = default;
  DisparityMap(int width, int height)
      : width_px(width), height_px(height), values(std::size_t(width) * std::size_t(height), kNoDisparity) {}

  std::size_t index(int x, int y) const { return std::size_t(y) * std::size_t(width_px) + std::size_t(x); }
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

// DisparityTruth: what a pair's disparities truly are, and which pixels of the left view the right one sees.
//   a picture, PNG: grey value / scale; 0 is unknown (Middlebury 2001 to 2006)
//   a PFM: float32, one channel, either byte order; infinite or NaN is unknown (Middlebury 2014)
//   a folder of the simulated rig (measure::TruthView): depth, brought into the rectified view
// Errors: NotFound, IoFailed, InvalidInput, each with the file. Thread: any.

struct DisparityTruth {
  DisparityMap map;
  std::vector<std::uint8_t> seen;  // 1: known, and nothing nearer hides it from the right view
};

Result<DisparityTruth> read_disparity_truth(const std::filesystem::path& file, double scale);

// Rectified views come from `view`'s left picture; only skin of the face that is judged is known.
DisparityTruth truth_of_view(const measure::TruthView& view, const pipeline::RectifiedPair& pair);

// Which pixels the right view sees, from the disparities themselves.
std::vector<std::uint8_t> seen_by_both(const DisparityMap& map);

}  // namespace relievo::firmware::compare
