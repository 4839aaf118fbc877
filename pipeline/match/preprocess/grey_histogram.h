// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// GreyHistogram: how often each grey level occurs, and its cumulative curve, without steps: inside a
// level (k - 0.5 to k + 0.5) the curve rises linearly, so that a map made of two of them is monotone and
// continuous and keeps what lies between whole levels.
// Thread: any; the counts are whole numbers, so bands add up to the same on any number of threads.
#pragma once

#include <array>
#include <cstdint>
#include <functional>

#include "hal/base/result.h"
#include "hal/base/thread_pool.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::pipeline {

class GreyHistogram {
 public:
  static constexpr int kLevels = 256;

  // `wanted` says which pixels count. Values beyond 0..255 count as the end levels.
  using Wanted = std::function<bool(int x, int y)>;
  static GreyHistogram of(const std::pmr::vector<float>& grey, int width_px, int height_px,
                          const Wanted& wanted, ThreadPool& pool);

  std::uint64_t count() const { return below_[kLevels]; }
  // Share of the counted pixels darker than `grey`, 0 to 1. Needs count() > 0.
  double share_below(double grey) const;
  // The grey below which `share` of the pixels lie; in the middle of a gap where many would do.
  double grey_at(double share) const;

 private:
  std::array<std::uint64_t, kLevels + 1> below_{};  // pixels darker than k - 0.5
};

// A monotone map of grey values, tabulated finely enough for the curves above; linear in between.
class GreyMap {
 public:
  explicit GreyMap(const std::function<double(double)>& map);
  float operator()(float grey) const;
  void apply(std::pmr::vector<float>& grey, ThreadPool& pool) const;

 private:
  static constexpr int kPerLevel = 16;
  std::array<float, 255 * kPerLevel + 1> table_{};
};

}  // namespace relievo::pipeline
