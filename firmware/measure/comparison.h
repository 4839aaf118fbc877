// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Comparison: what came out of every set of algorithms on every pair, as plain data from which the page and
// the JSON are made. Pixels, millimetres, milliseconds, bytes; shares of 1.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "firmware/measure/disparity_map.h"
#include "firmware/measure/measurement.h"
#include "pipeline/algorithms.h"

namespace relievo::firmware::compare {

// Figures of match_figures.h, as plain data.
struct LeftRightFigures {
  std::size_t asked = 0;     // pixels of the left view with a disparity
  std::size_t answered = 0;  // whose partner has one too
  double median_px = 0;      // of the difference of the two
  double p95_px = 0;
  double within_1px = 0;  // share of the answered
};

struct PhotoFigures {
  std::size_t asked = 0;  // windows that the model fills
  double median = 0;      // correlation, -1 .. 1
  double p5 = 0;          // of a twentieth it is lower
};

struct NamedSet {
  std::string name;
  pipeline::AlgorithmSet set;
};

struct StageCost {
  std::string name;  // rectify, preprocess, select, match, judge, reconstruct, mesh, texture, assemble
  double ms = 0;
  std::size_t arena_peak_bytes = 0;
};

// What one constraint took away, and whether it was right to.
struct RuleFigures {
  std::string name;
  std::size_t rejected = 0;
  std::size_t judged = 0;  // of the rejected, with known truth
  std::size_t bad = 0;     // of these, truly off by more than the limit
};

struct MatchFigures {
  std::size_t keypoints = 0, matches = 0, accepted = 0;
  std::vector<RuleFigures> rules;
  std::size_t judged = 0, bad = 0;                    // of all matches, before any rule
  std::size_t accepted_judged = 0, accepted_bad = 0;  // of what the rules left
};

// How good the places are that a selector chose (Schmid, Mohr, Bauckhage 2000).
struct SelectorFigures {
  std::size_t left = 0, right = 0;      // places it chooses in either view
  std::optional<double> repeatability;  // of the left's that both views see: share with a partner in 1.5 px
  std::size_t asked = 0;                // how many that share is of
  double match_rate = 0;                // share whose match was accepted
  double spread = 0;                    // share of 16 x 16 cells of the region that hold one
  std::vector<pipeline::Vec2f> places_px;  // of the left view
};

// What a mesher made, as it looks: from in front and from the side, PNG.
struct SurfaceLook {
  std::size_t vertices = 0, measured = 0, triangles = 0;
  double mesh_ms = 0;
  std::vector<std::byte> front, side;
};

struct Run {
  std::size_t set = 0, pair = 0;  // indices
  std::string failure;            // empty: it worked; else at what and why
  std::string no_surface;         // why points of a list, which worked, are not the surface of a face
  std::vector<StageCost> stages;
  double match_ms = 0;               // preprocess to judge
  std::size_t arena_peak_bytes = 0;  // both arenas together
  std::size_t heap_peak_bytes = 0;   // what the process held besides, above what it held before; 0 unknown
  MatchFigures matches;
  DisparityMap map;                         // accepted
  std::vector<std::uint8_t> rejected_by;    // a pixel each: 0, or 1 + the first rule that took its match
  std::optional<SelectorFigures> selector;  // of scattered places
  std::optional<DisparityScore> score;
  // What needs no truth.
  std::optional<LeftRightFigures> left_right;  // of dense sets
  std::optional<PhotoFigures> photo;           // of models
  std::optional<double> epipolar_px;           // rms disagreement of the rows, where the matcher measures it
  std::optional<measure::Measurement> model;
  std::optional<SurfaceLook> surface;  // of models
};

struct PairFacts {
  std::string name;
  int width_px = 0, height_px = 0;   // of the rectified views
  double least_px = 0, most_px = 0;  // disparities that are looked for
  bool rectified = false;
  std::vector<std::uint8_t> grey;  // the left rectified view
  std::optional<DisparityTruth> truth;
};

struct Comparison {
  std::vector<NamedSet> sets;
  std::vector<PairFacts> pairs;
  std::vector<Run> runs;  // pair by pair, set by set
  double limit_px = 1;    // off by more is bad
};

}  // namespace relievo::firmware::compare
