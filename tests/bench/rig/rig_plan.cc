// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/rig/rig_plan.h"

#include <cstdio>
#include <sstream>

namespace relievo::bench {

RigUnderTest recommended(bool portrait) { return {portrait, 110, 2320, 560, 1}; }

Stand as_people_stand(std::uint32_t person) {
  // Four corners of a box, no two on one side of it: with four people every rig is asked at its limits.
  const int k = static_cast<int>((person - 1) % 4);
  const double x = k < 2 ? 1 : -1, y = k % 2 == 0 ? 1 : -1, z = x * y;
  return {35 * x, 35 * y, 35 * z, 8 * z, -6 * x, 4 * y};
}

namespace {

void add(std::vector<Row>& rows, const std::string& panel, const RigUnderTest& rig, int persons) {
  for (int k = 1; k <= persons; ++k) {
    const auto person = static_cast<std::uint32_t>(k);
    rows.push_back({panel, rig, as_people_stand(person), person, {}});
  }
}

// One person, straight ahead, elsewhere: how much of the face do both cameras see? Nothing is
// photographed for that.
void add_volume(std::vector<Row>& rows, bool portrait) {
  const RigUnderTest rig = recommended(portrait);
  for (double back = -140; back <= 181; back += 20) {
    for (double down = -260; down <= 261; down += 20)
      rows.push_back({"volume-height", rig, {0, down, back, 0, 0, 0}, 2, {}});
    for (double right = -200; right <= 201; right += 20)
      rows.push_back({"volume-width", rig, {right, 0, back, 0, 0, 0}, 2, {}});
  }
}

void add_sweeps(std::vector<Row>& rows, bool portrait, int persons) {
  for (const double focal : {1300.0, 1650.0, 1950.0, 2320.0, 2800.0, 3400.0, 4000.0}) {
    // A lens so short that nothing leaves the picture does the same for both ways of turning it.
    if (!portrait && focal < 2000) continue;
    RigUnderTest rig = recommended(portrait);
    rig.focal_px = focal;
    add(rows, "focal", rig, persons);
  }
  // Orientation is a matter of the field of view; the rest is tried upright only.
  if (!portrait) return;
  for (const double baseline : {50.0, 75.0, 100.0, 120.0, 140.0, 170.0, 205.0, 245.0}) {
    RigUnderTest rig = recommended(portrait);
    rig.baseline_mm = baseline;
    add(rows, "baseline", rig, persons);
  }
  // At every distance the triangle and the field of view are kept: baseline and focal length grow with it.
  for (const double distance : {430.0, 490.0, 560.0, 660.0, 800.0}) {
    RigUnderTest rig = recommended(portrait);
    rig.baseline_mm *= distance / rig.distance_mm;
    rig.focal_px *= distance / rig.distance_mm;
    rig.distance_mm = distance;
    add(rows, "distance", rig, persons);
  }
  for (const double toe_in : {0.0, 0.5, 1.0, 1.5}) {
    RigUnderTest rig = recommended(portrait);
    rig.toe_in = toe_in;
    add(rows, "toe-in", rig, persons);
  }
  // The cameras look up or down at a face that looks straight ahead.
  for (double pitch = -30; pitch <= 31; pitch += 15)
    for (const std::uint32_t person : {1U, 2U})
      rows.push_back({"tilt", recommended(portrait), {0, 0, 0, 0, pitch, 0}, person, {}});
}

// The whole chain where the volume that the README states ends.
void add_edges(std::vector<Row>& rows) {
  for (const Stand& stand : {Stand{0, -150, 0},
                             {0, 150, 0},
                             {-80, 0, 0},
                             {80, 0, 0},
                             {0, 0, -60},
                             {0, 0, 140},
                             {-60, -140, 40},
                             {60, 140, 40}})
    for (const std::uint32_t person : {1U, 2U})
      rows.push_back({"edge", recommended(true), stand, person, {}});
}

}  // namespace

std::vector<Row> plan(int persons) {
  std::vector<Row> rows;
  for (const bool portrait : {true, false}) add_sweeps(rows, portrait, persons);
  add_edges(rows);
  for (const bool portrait : {true, false}) add_volume(rows, portrait);
  return rows;
}

bool only_geometry(const Row& row) { return row.panel.starts_with("volume"); }

std::string csv_header() {
  return "panel,portrait,baseline_mm,focal_px,distance_mm,toe_in,right_mm,down_mm,back_mm,yaw_deg,pitch_deg,"
         "roll_deg,person,scale,"
         "done,median_mm,p95_mm,seen_by_both,within_half_mm,matched\n";
}

std::string csv_line(const Row& r, double scale) {
  char text[400];
  std::snprintf(text, sizeof text,
                "%s,%d,%g,%g,%g,%g,%.3f,%.3f,%.3f,%.3f,%.3f,%.3f,%u,%g,%d,%.5f,%.5f,%.5f,%.5f,%.5f\n",
                r.panel.c_str(), r.rig.portrait ? 1 : 0, r.rig.baseline_mm, r.rig.focal_px, r.rig.distance_mm,
                r.rig.toe_in, r.stand.right_mm, r.stand.down_mm, r.stand.back_mm, r.stand.yaw_deg,
                r.stand.pitch_deg, r.stand.roll_deg, r.person, scale, r.result.done ? 1 : 0,
                r.result.median_mm, r.result.p95_mm, r.result.seen_by_both, r.result.within_half_mm,
                r.result.matched);
  return text;
}

std::vector<Row> parse_csv(const std::string& text) {
  std::vector<Row> rows;
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    const std::size_t comma = line.find(',');
    if (comma == std::string::npos) return {};
    Row r;
    r.panel = line.substr(0, comma);
    int portrait = 0, done = 0;
    double scale = 0;
    const int read = std::sscanf(
        line.c_str() + comma + 1, "%d,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%u,%lf,%d,%lf,%lf,%lf,%lf,%lf",
        &portrait, &r.rig.baseline_mm, &r.rig.focal_px, &r.rig.distance_mm, &r.rig.toe_in, &r.stand.right_mm,
        &r.stand.down_mm, &r.stand.back_mm, &r.stand.yaw_deg, &r.stand.pitch_deg, &r.stand.roll_deg,
        &r.person, &scale, &done, &r.result.median_mm, &r.result.p95_mm, &r.result.seen_by_both,
        &r.result.within_half_mm, &r.result.matched);
    if (read != 19) return {};
    r.rig.portrait = portrait != 0;
    r.result.done = done != 0;
    rows.push_back(r);
  }
  return rows;
}

}  // namespace relievo::bench
