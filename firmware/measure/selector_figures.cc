// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/measure/selector_figures.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "pipeline/algorithms/algorithm_table.h"

namespace relievo::firmware::compare {
namespace {

enum class Judgement : std::uint8_t { Unknown, Good, Bad };

Judgement judge(const pipeline::Match& match, const std::optional<DisparityTruth>& truth, double limit_px) {
  if (!truth) return Judgement::Unknown;
  const int x = int(std::lround(match.left_px.x));
  const int y = int(std::lround(match.left_px.y));
  if (!truth->map.holds(x, y) || !truth->map.known(x, y)) return Judgement::Unknown;
  const auto error = double(match.disparity_px - truth->map.at(x, y));
  return std::abs(error) > limit_px ? Judgement::Bad : Judgement::Good;
}

// Where on the right view each of the left's places should be found again.
std::vector<pipeline::Vec2d> expected_in_right(const pipeline::Keypoints& left,
                                               const pipeline::MatchSet& matches,
                                               const std::optional<DisparityTruth>& truth) {
  std::vector<pipeline::Vec2d> expected;
  if (!truth) {
    for (const pipeline::Match& match : matches.matches)
      if (match.rejected_by == 0)
        expected.push_back({double(match.left_px.x - match.disparity_px), double(match.left_px.y)});
    return expected;
  }
  for (const pipeline::Keypoint& place : left.points) {
    const int x = int(std::lround(place.at_px.x));
    const int y = int(std::lround(place.at_px.y));
    if (!truth->map.holds(x, y) || truth->seen[truth->map.index(x, y)] == 0) continue;
    expected.push_back({double(place.at_px.x - truth->map.at(x, y)), double(place.at_px.y)});
  }
  return expected;
}

// Does a place lie within kRepeatedPx?
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
    return std::size_t(y * kCells / pair.height_px * kCells + x * kCells / pair.width_px);
  };
  for (int y = 0; y < pair.height_px; ++y)
    for (int x = 0; x < pair.width_px; ++x) {
      const std::size_t k = std::size_t(y) * std::size_t(pair.width_px) + std::size_t(x);
      if (pair.left.valid[k] != 0 && (pair.region.empty() || pair.region[k] != 0)) usable[cell(x, y)] = 1;
    }
  for (const pipeline::Keypoint& place : places.points)
    held[cell(std::clamp(int(place.at_px.x), 0, pair.width_px - 1),
              std::clamp(int(place.at_px.y), 0, pair.height_px - 1))] = 1;
  int all = 0;
  int with = 0;
  for (std::size_t i = 0; i < usable.size(); ++i) {
    all += usable[i];
    with += usable[i] & held[i];
  }
  return all == 0 ? 0 : double(with) / all;
}

}  // namespace

MatchFigures figures_of(const NamedSet& set, const pipeline::Keypoints& keypoints,
                        const pipeline::MatchSet& matches, const std::optional<DisparityTruth>& truth,
                        double limit_px) {
  MatchFigures f;
  f.keypoints = keypoints.points.size();
  f.matches = matches.matches.size();
  for (const std::string& name : pipeline::split_names(set.set.get("constraints")))
    if (name != "none") f.rules.push_back({name});
  for (const pipeline::Match& match : matches.matches) {
    const Judgement judgement = judge(match, truth, limit_px);
    const std::size_t judged = judgement == Judgement::Unknown ? 0 : 1;
    const std::size_t bad = judgement == Judgement::Bad ? 1 : 0;
    f.judged += judged;
    f.bad += bad;
    if (match.rejected_by == 0) {
      ++f.accepted;
      f.accepted_judged += judged;
      f.accepted_bad += bad;
      continue;
    }
    const auto rule = std::size_t(std::countr_zero(match.rejected_by));
    if (rule >= f.rules.size()) continue;
    ++f.rules[rule].rejected;
    f.rules[rule].judged += judged;
    f.rules[rule].bad += bad;
  }
  return f;
}

std::vector<std::uint8_t> rejected_map(const pipeline::MatchSet& matches, int width_px, int height_px) {
  std::vector<std::uint8_t> map(std::size_t(width_px) * std::size_t(height_px), 0);
  constexpr int kScatteredPx = 9;
  const int cell = matches.lattice_step_px > 0 ? matches.lattice_step_px : kScatteredPx;
  const int before = matches.lattice_step_px > 0 ? 0 : kScatteredPx / 2;
  for (const pipeline::Match& match : matches.matches) {
    if (match.rejected_by == 0) continue;
    const auto rule = std::uint8_t(1 + std::countr_zero(match.rejected_by));
    const int left = int(std::lround(match.left_px.x)) - before;
    const int top = int(std::lround(match.left_px.y)) - before;
    for (int y = std::max(0, top); y < std::min(height_px, top + cell); ++y)
      for (int x = std::max(0, left); x < std::min(width_px, left + cell); ++x)
        map[std::size_t(y) * std::size_t(width_px) + std::size_t(x)] = rule;
  }
  return map;
}

Result<pipeline::Keypoints> select_in_right(const pipeline::KeypointSelector& selector,
                                            const pipeline::RectifiedPair& pair, const DisparityMap& map,
                                            pipeline::StageContext& context) {
  pipeline::RectifiedPair swapped = pair;
  std::swap(swapped.left, swapped.right);
  swapped.left_centre_px = pair.right_centre_px;
  swapped.right_centre_px = pair.left_centre_px;
  take_region(map, swapped);
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
    places.push_back({double(place.at_px.x), double(place.at_px.y)});
  std::ranges::sort(places, [](const pipeline::Vec2d& a, const pipeline::Vec2d& b) {
    return a.y < b.y || (a.y == b.y && a.x < b.x);
  });
  const std::vector<pipeline::Vec2d> expected = expected_in_right(left, matches, truth);
  f.asked = expected.size();
  const auto again =
      std::ranges::count_if(expected, [&places](const pipeline::Vec2d& at) { return repeated(at, places); });
  if (f.asked > 0) f.repeatability = double(again) / double(f.asked);
  const auto accepted =
      std::ranges::count_if(matches.matches, [](const pipeline::Match& m) { return m.rejected_by == 0; });
  if (f.left > 0) f.match_rate = double(accepted) / double(f.left);
  f.spread = spread_of(pair, left);
  return f;
}

}  // namespace relievo::firmware::compare
