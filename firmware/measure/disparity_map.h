// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// DisparityMap: a disparity for every pixel of the left rectified view, or none: what all matchers, dense or
// sparse, are compared by. Pixels; row by row; NaN where nothing is known. Thread: any. No errors.
#pragma once

#include <array>
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

// How far a disparity map is from the truth, in the figures of Scharstein and Szeliski (2002): a pixel is bad
// where it is off by more than a limit, or where the map has none though the truth is known. Pixels; shares
// of 1. Thread: any. Errors: none; the sizes of map and truth are the caller's promise.

// Signed errors in bins from -kReachPx to kReachPx; the first and last hold all beyond.
struct ErrorHistogram {
  static constexpr int kBins = 81;
  static constexpr double kReachPx = 4;
  std::array<std::size_t, kBins> counts{};
};

struct DisparityScore {
  std::size_t judged = 0;                                     // pixels whose truth is known
  std::size_t given = 0;                                      // of these, with a disparity
  double density = 0;                                         // given / judged
  double bad_half = 0, bad_1 = 0, bad_2 = 0, bad_4 = 0;       // of the judged; a hole is bad
  double bad_limit = 0;                                       // the same with the limit asked for
  double bad_given = 0;                                       // of the given, with the limit asked for
  std::size_t seen = 0;                                       // judged pixels that both views see
  double bad_seen = 0;                                        // of these, with the limit; a hole is bad
  double mean_px = 0, rms_px = 0, median_px = 0, p95_px = 0;  // of the absolute error of the given
  double bias_px = 0;  // mean signed error of the given that are within the limit
  ErrorHistogram histogram;
};

DisparityScore score(const DisparityMap& map, const DisparityTruth& truth, double limit_px);

// Two maps where both give a disparity and the truth is known: share of bad ones of each.
struct SharedScore {
  std::size_t shared = 0;
  double bad_one = 0, bad_other = 0;
  double median_one_px = 0, median_other_px = 0;
};
SharedScore score_shared(const DisparityMap& one, const DisparityMap& other, const DisparityTruth& truth,
                         double limit_px);

}  // namespace relievo::firmware::compare
