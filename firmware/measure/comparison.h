// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Comparison: what came out of every set of algorithms on every pair, as plain data from which the page and
// the JSON are made. Pixels, millimetres, milliseconds, bytes; shares of 1.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "firmware/measure/measurement.h"
#include "hal/base/result.h"
#include "pipeline/algorithms.h"
#include "pipeline/base/kinds.h"
#include "pipeline/base/stage.h"
#include "pipeline/model/face_mesh.h"
#include "pipeline/model/match_set.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::firmware::compare {

// DisparityMap: a disparity for every pixel of the left rectified view, or none: what all matchers, dense or
// sparse, are compared by. Pixels; row by row; NaN where nothing is known. Thread: any. No errors.

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

// How well a result agrees with its own two pictures (left_right_figures(), photo_figures()).
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

// Those of the figures above that need more than a map: of matches and the places they are asked for, and
// how well a result agrees with its own two pictures. Pixels of the rectified views. Thread: worker. Errors:
// those of the steps that are run once more.

// What the constraints took away, rule by rule, and whether they were right to. Thread: any. No errors.
MatchFigures figures_of(const NamedSet& set, const pipeline::Keypoints& keypoints,
                        const pipeline::MatchSet& matches, const std::optional<DisparityTruth>& truth,
                        double limit_px);

// A pixel each: 0, or 1 + the rule that took the match there. On a lattice every node stands for its cell,
// a scattered match for 9 x 9 pixels.
std::vector<std::uint8_t> rejected_map(const pipeline::MatchSet& matches, int width_px, int height_px);

// How good a selector's places are. Repeatability (Schmid, Mohr, Bauckhage 2000): the selector is asked for
// the right view as well; of the left's places, those that both views see by the truth (without one: whose
// match was accepted) should be chosen there again, within kRepeatedPx.
inline constexpr double kRepeatedPx = 1.5;

// Places of the right view, by its own axes: the selector is given the pair with its views exchanged.
// A face region goes with it, brought over by `map`. Errors: the selector's.
Result<pipeline::Keypoints> select_in_right(const pipeline::KeypointSelector& selector,
                                            const pipeline::RectifiedPair& pair, const DisparityMap& map,
                                            pipeline::StageContext& context);

SelectorFigures selector_figures(const pipeline::RectifiedPair& pair, const pipeline::Keypoints& left,
                                 const pipeline::Keypoints& right, const pipeline::MatchSet& matches,
                                 const std::optional<DisparityTruth>& truth);

// What can be said where nothing is known to be true. None of it sees an error that both views share (a wrong
// calibration, motion along the rows).

// The same pair seen in a mirror, so that the right view is the left one: x becomes width - 1 - x,
// disparities keep their sign and size. The region comes over by `map`, the left view's disparities.
pipeline::RectifiedPair mirrored(const pipeline::RectifiedPair& pair, const DisparityMap& map);

// What the mesh (mm, left camera's frame) shows the left view.
DisparityMap model_view(const pipeline::RectifiedPair& pair, const pipeline::FaceMesh& mesh);

// Matches the mirrored pair with the set's own algorithms and compares each pixel's disparity with that of
// its partner. `map` holds accepted matches of a lattice; `model`, where there is one, the part of it that
// was kept.
Result<LeftRightFigures> left_right_figures(const pipeline::RectifiedPair& pair,
                                            const pipeline::AlgorithmSet& set, const DisparityMap& map,
                                            const std::optional<DisparityMap>& model,
                                            pipeline::StageContext& context);

// The right view is predicted from the left through the model and compared with what the camera saw, as it
// was given to the matcher: zero-mean normalised correlation in windows of kPhotoWindowPx.
inline constexpr int kPhotoWindowPx = 15;
PhotoFigures photo_figures(const pipeline::RectifiedPair& pair, const DisparityMap& model,
                           pipeline::StageContext& context);

}  // namespace relievo::firmware::compare
