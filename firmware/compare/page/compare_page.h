// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A comparison for people: one page of HTML that needs nothing beside it (see pipeline/report/page.h); and
// for programs: compare.json, whose keys are part of the product. And both of the tables 1 and 2, figures 6
// to 12 and 17 of Bardsley (2004), done again, with its own figures beside ours; one unit is 10 mm here.
// Errors: those of the picture encoder. Thread: any; the same input gives the same text.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/measure/comparison.h"
#include "hal/base/result.h"
#include "pipeline/model/geometry.h"

namespace relievo::firmware::compare {

// What is recorded of the dissertation's own figures; nothing else is.
namespace recorded {
inline constexpr double kBaselineUnits = 20;              // table 1: true,
inline constexpr double kFoundBaselineUnits = 19.284;     // and as calibrated
inline constexpr std::array kFoundFocalPx{771.6, 770.6};  // as calibrated
inline constexpr double kCubeUnits = 25;                  // table 2: about
inline constexpr double kDistanceUnits = 66;
inline constexpr double kWorstCornerUnits = 1;  // no corner is off by more
}  // namespace recorded

// Its six constraints, in its order.
inline constexpr std::array<std::string_view, 6> kDissertationRules{
    "similarity", "uniqueness", "continuity", "ordering", "left-right", "statistical"};

struct RigTable {
  double baseline_units = 0;
  double true_focal_px = 0;
  std::array<double, 2> focal_px{};  // left, right
  double pair_rms_px = 0;
};

struct CubeTable {
  struct Corner {
    pipeline::Vec3d truth, found;  // units, left camera's frame
    double off_units = 0;
  };
  std::vector<Corner> corners;
  double worst_units = 0;  // of these corners, one hand's
  double rms_units = 0;    // of a hundred hands' corners
  double side_units = 0;   // mean of the twelve edges
};

struct Dissertation {
  RigTable rig;
  CubeTable cube;
  Comparison rules;  // figures 6 to 12: the rule sets of set_run.h on one pair, matches only
  Comparison face;   // figure 17: its face sets on one calibrated pair
};

struct Figure {
  int number = 0;
  std::string title;
  const Comparison& of;
  std::vector<const Run*> runs;
};
// All of them, in their order. Of figures 7 to 12 each has one run: its rule is the last of the run's.
std::vector<Figure> figures_of(const Dissertation& dissertation);

Result<std::string> comparison_html(const Comparison& comparison, const std::string& product,
                                    const std::string& made_at);
std::string comparison_json(const Comparison& comparison, const std::string& made_at);
Result<std::string> dissertation_html(const Dissertation& dissertation, const std::string& product,
                                      const std::string& made_at);
std::string dissertation_json(const Dissertation& dissertation, const std::string& made_at);

}  // namespace relievo::firmware::compare
