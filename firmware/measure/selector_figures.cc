// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/measure/selector_figures.h"

#include <algorithm>
#include <cmath>

namespace relievo::firmware::compare {
namespace {

// Where on the right view each of the left's places should be found again.
std::vector<pipeline::Vec2d> expected_in_right(const pipeline::Keypoints& left,
                                               const pipeline::MatchSet& matches,
                                               const std::optional<DisparityTruth>& truth) {
  std::vector<pipeline::Vec2d> expected;
  if (!truth) {
    for (const pipeline::Match& match : matches.matches)
      if (match.rejected_by == 0)
        expected.push_back({static_cast<double>(match.left_px.x - match.disparity_px),
                            static_cast<double>(match.left_px.y)});
    return expected;
  }
  for (const pipeline::Keypoint& place : left.points) {
    const int x = static_cast<int>(std::lround(place.at_px.x));
    const int y = static_cast<int>(std::lround(place.at_px.y));
    if (!truth->map.holds(x, y) || truth->seen[truth->map.index(x, y)] == 0) continue;
    expected.push_back(
        {static_cast<double>(place.at_px.x - truth->map.at(x, y)), static_cast<double>(place.at_px.y)});
  }
  return expected;
}

// A pixel each: 1 where a place lies within kRepeatedPx; asked at whole pixels nearby, then exactly.
bool repeated(const pipeline::Vec2d& expected, const std::vector<pipeline::Vec2d>& sorted_by_row) {
  const auto first = std::lower_bound(sorted_by_row.begin(), sorted_by_row.end(), expected.y - kRepeatedPx,
                                      [](const pipeline::Vec2d& p, double row) { return p.y < row; });
  for (auto it = first; it != sorted_by_row.end() && it->y <= expected.y + kRepeatedPx; ++it)
    if (std::hypot(it->x - expected.x, it->y - expected.y) <= kRepeatedPx) return true;
  return false;
}

double spread_of(const pipeline::RectifiedPair& pair, const pipeline::Keypoints& places) {
  constexpr int kCells = 16;
  std::vector<std::uint8_t> usable(kCells * kCells, 0);
  std::vector<std::uint8_t> held(kCells * kCells, 0);
  const auto cell = [&pair](int x, int y) {
    return static_cast<std::size_t>(y * kCells / pair.height_px * kCells + x * kCells / pair.width_px);
  };
  for (int y = 0; y < pair.height_px; ++y)
    for (int x = 0; x < pair.width_px; ++x) {
      const std::size_t k =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(pair.width_px) + static_cast<std::size_t>(x);
      if (pair.left.valid[k] != 0 && (pair.region.empty() || pair.region[k] != 0)) usable[cell(x, y)] = 1;
    }
  for (const pipeline::Keypoint& place : places.points)
    held[cell(std::clamp(static_cast<int>(place.at_px.x), 0, pair.width_px - 1),
              std::clamp(static_cast<int>(place.at_px.y), 0, pair.height_px - 1))] = 1;
  int all = 0;
  int with = 0;
  for (std::size_t i = 0; i < usable.size(); ++i) {
    all += usable[i];
    with += usable[i] & held[i];
  }
  return all == 0 ? 0 : static_cast<double>(with) / all;
}

}  // namespace

Result<pipeline::Keypoints> select_in_right(const pipeline::KeypointSelector& selector,
                                            const pipeline::RectifiedPair& pair, const DisparityMap& map,
                                            pipeline::StageContext& context) {
  pipeline::RectifiedPair swapped = pair;
  std::swap(swapped.left, swapped.right);
  swapped.left_centre_px = pair.right_centre_px;
  swapped.right_centre_px = pair.left_centre_px;
  if (!pair.region.empty()) {
    std::fill(swapped.region.begin(), swapped.region.end(), std::uint8_t{0});
    for (int y = 0; y < pair.height_px; ++y)
      for (int x = 0; x < pair.width_px; ++x) {
        if (!map.known(x, y)) continue;
        const int to = static_cast<int>(std::lround(static_cast<float>(x) - map.at(x, y)));
        for (int near = std::max(0, to - 1); near <= std::min(pair.width_px - 1, to + 1); ++near)
          swapped.region[map.index(near, y)] = 1;
      }
  }
  return selector(swapped, context);
}

SelectorFigures selector_figures(const pipeline::RectifiedPair& pair, const pipeline::Keypoints& left,
                                 const pipeline::Keypoints& right, const pipeline::MatchSet& matches,
                                 const std::optional<DisparityTruth>& truth) {
  SelectorFigures f;
  f.left = left.points.size();
  f.right = right.points.size();
  for (const pipeline::Keypoint& place : left.points) f.places_px.push_back(place.at_px);
  std::vector<pipeline::Vec2d> places;
  for (const pipeline::Keypoint& place : right.points)
    places.push_back({static_cast<double>(place.at_px.x), static_cast<double>(place.at_px.y)});
  std::sort(places.begin(), places.end(), [](const pipeline::Vec2d& a, const pipeline::Vec2d& b) {
    return a.y < b.y || (a.y == b.y && a.x < b.x);
  });
  const std::vector<pipeline::Vec2d> expected = expected_in_right(left, matches, truth);
  f.asked = expected.size();
  const auto again = std::count_if(expected.begin(), expected.end(),
                                   [&places](const pipeline::Vec2d& at) { return repeated(at, places); });
  if (f.asked > 0) f.repeatability = static_cast<double>(again) / static_cast<double>(f.asked);
  const auto accepted = std::count_if(matches.matches.begin(), matches.matches.end(),
                                      [](const pipeline::Match& m) { return m.rejected_by == 0; });
  if (f.left > 0) f.match_rate = static_cast<double>(accepted) / static_cast<double>(f.left);
  f.spread = spread_of(pair, left);
  return f;
}

}  // namespace relievo::firmware::compare
