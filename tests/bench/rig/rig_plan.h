// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the sweep tries: panels of rigs, and how people stand before them. A row is one trial; the CSV
// has one line a row, and the chart is drawn from those lines alone.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/bench/rig/rig_trial.h"

namespace relievo::bench {

struct Row {
  std::string
      panel;  // "baseline", "focal", "distance", "toe-in", "tilt", "edge", "volume-height", "volume-width"
  RigUnderTest rig;
  Stand stand;
  std::uint32_t person = 1;
  TrialResult result;
};

// The rig from which one thing at a time is changed, and which the README recommends.
RigUnderTest recommended(bool portrait);

// As people stand who were asked to look at a mark: 35 mm off it in every direction and a little turned,
// one way or another; the same for every rig.
Stand as_people_stand(std::uint32_t person);

std::vector<Row> plan(int persons);
bool only_geometry(const Row& row);  // what both cameras see is asked for, no pictures

std::string csv_header();
std::string csv_line(const Row& row, double scale);
// Empty where the text is not such a file.
std::vector<Row> parse_csv(const std::string& text);

}  // namespace relievo::bench
