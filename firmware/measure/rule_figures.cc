// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/measure/rule_figures.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace relievo::firmware::compare {
namespace {

// The names as AlgorithmSet has them: joined by '+', or none.
std::vector<RuleFigures> rules_of(const pipeline::AlgorithmSet& set) {
  std::vector<RuleFigures> rules;
  const std::string names = set.get("constraints");
  for (std::size_t begin = 0; begin <= names.size();) {
    const std::size_t end = std::min(names.find('+', begin), names.size());
    const std::string name = names.substr(begin, end - begin);
    if (name != "none") rules.push_back({name});
    begin = end + 1;
  }
  return rules;
}

enum class Judgement : std::uint8_t { Unknown, Good, Bad };

Judgement judge(const pipeline::Match& match, const std::optional<DisparityTruth>& truth, double limit_px) {
  if (!truth) return Judgement::Unknown;
  const int x = static_cast<int>(std::lround(match.left_px.x));
  const int y = static_cast<int>(std::lround(match.left_px.y));
  if (!truth->map.holds(x, y) || !truth->map.known(x, y)) return Judgement::Unknown;
  const auto error = static_cast<double>(match.disparity_px - truth->map.at(x, y));
  return std::abs(error) > limit_px ? Judgement::Bad : Judgement::Good;
}

}  // namespace

MatchFigures figures_of(const NamedSet& set, const pipeline::Keypoints& keypoints,
                        const pipeline::MatchSet& matches, const std::optional<DisparityTruth>& truth,
                        double limit_px) {
  MatchFigures f;
  f.keypoints = keypoints.points.size();
  f.matches = matches.matches.size();
  f.rules = rules_of(set.set);
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
    const auto rule = static_cast<std::size_t>(std::countr_zero(match.rejected_by));
    if (rule >= f.rules.size()) continue;
    ++f.rules[rule].rejected;
    f.rules[rule].judged += judged;
    f.rules[rule].bad += bad;
  }
  return f;
}

std::vector<std::uint8_t> rejected_map(const pipeline::MatchSet& matches, int width_px, int height_px) {
  std::vector<std::uint8_t> map(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px), 0);
  constexpr int kScatteredPx = 9;
  const int cell = matches.lattice_step_px > 0 ? matches.lattice_step_px : kScatteredPx;
  const int before = matches.lattice_step_px > 0 ? 0 : kScatteredPx / 2;
  for (const pipeline::Match& match : matches.matches) {
    if (match.rejected_by == 0) continue;
    const auto rule = static_cast<std::uint8_t>(1 + std::countr_zero(match.rejected_by));
    const int left = static_cast<int>(std::lround(match.left_px.x)) - before;
    const int top = static_cast<int>(std::lround(match.left_px.y)) - before;
    for (int y = std::max(0, top); y < std::min(height_px, top + cell); ++y)
      for (int x = std::max(0, left); x < std::min(width_px, left + cell); ++x)
        map[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px) + static_cast<std::size_t>(x)] =
            rule;
  }
  return map;
}

}  // namespace relievo::firmware::compare
