// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// TechnicianView: everything the technician's picture pages may draw, as plain data. No person's name comes
// here. Everything is borrowed from firmware/technician for the length of one frame. Thread: main.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>

#include "pipeline/model/face_model.h"
#include "pipeline/model/geometry.h"
#include "pipeline/model/live_advice.h"
#include "pipeline/model/point_cloud.h"
#include "ui/draw/draw_list.h"
#include "ui/view/service_view.h"
#include "ui/view/staff_request.h"

namespace relievo::ui {

// What a set of algorithms made of a test capture, and what is known of a place that was touched.
// Pixels of the rectified views; millimetres in the left camera's frame. Texts are borrowed for a frame.
enum class TechnicianPhase : std::uint8_t { Empty, Capturing, Running, Ready, Failed };

inline constexpr std::size_t kStages = 5;  // Match, Reconstruct, Mesh, Texture, Assemble

inline constexpr std::size_t kTechnicianRules = 6;
struct TechnicianRule {
  std::string_view name;
  std::array<std::uint8_t, 3> rgb{};  // its colour in the picture
  std::uint64_t rejected = 0;
};

inline constexpr std::size_t kSigmaBins = 25;
inline constexpr float kSigmaBinMm = 0.02F;

// What a set of algorithms made of the capture.
struct TechnicianResult {
  bool there = false;
  std::string_view name;        // of the capture: the document's, else when it was taken
  std::string_view algorithms;  // what differs from the default, one "key = value" a line
  Fault failure;                // of a stage; empty: all are done
  std::size_t failed_at = 0;    // of the stages
  std::array<float, kStages> seconds{};
  std::array<std::uint64_t, kStages> made{};  // accepted matches, points, triangles, texels, landmarks
  float arena_peak_mib = 0;
  std::uint64_t matches = 0, accepted = 0;
  std::array<TechnicianRule, kTechnicianRules> rules{};
  std::size_t rule_count = 0;
  float median_sigma_mm = 0, coverage = 0;  // 0: no model
  // Percent of the measured vertices whose uncertainty lies in each bin of kSigmaBinMm; the last takes the
  // rest.
  std::array<float, kSigmaBins> sigma_percent{};
  float epipolar_px = -1;           // rms disagreement of the rows; below 0: not measured
  float photo_correlation = 0;      // median, of the right view predicted through the model
  std::uint64_t photo_windows = 0;  // that it is the median of; 0: not measured
};

// A place that was touched, and its partner.
struct TechnicianPoint {
  bool touched = false, matched = false, by_hand = false;
  bool waits_for_right = false;  // the left point of a match by hand is set
  pipeline::Vec2f left_px, right_px;
  float left_x = 0, right_x = 0, y = 0;  // shares of the pictures
  float disparity_px = 0, sigma_px = 0, cost = 0;
  std::string_view rejected_by;  // the rule; empty: accepted
  pipeline::Vec3f at_mm;
  float sigma_mm = 0;
  // Of a pair by hand, once it has been calculated with: by how much the surface there came nearer, measured
  // along z; NaN: not known, `new_surface` where there was none before.
  float moved_mm = std::numeric_limits<float>::quiet_NaN();
  bool new_surface = false;
};

inline constexpr std::size_t kMostPairs = 32;  // made on the page; a file may hold more

// What the pairs by hand changed: the surface with them against the one without.
struct TechnicianChange {
  bool known = false;
  float moved_mm2 = 0, new_mm2 = 0;  // area that moved by more than kMovedMm, and that was not there before
  float farthest_mm = 0;
  float full_colour_mm = 0;  // of the picture beside the surface's: nearer is red, farther blue
};
inline constexpr float kMovedMm = 0.05F;

// What the cameras say while they are watched, and a live calibration from its first pair to its verdict.
// Texts and pictures are borrowed for a frame.
struct TechnicianCamera {
  Picture picture;
  float mean = 0, clipped = 0;  // of the middle: 1 is white; the share that is burnt out
  float focus = 0;              // how sharp the middle is against the sharpest seen since the watch began
  float sharp_edges = 0;        // the share of the picture that is coloured, because it is in focus
  std::uint64_t frames = 0, lost = 0, damaged = 0;
};
struct TechnicianCameras {
  bool starting = false;  // wanted, and no pair has come yet
  bool watched = false;
  std::array<TechnicianCamera, 2> camera;  // left, right
  float skew_us = 0, pairs_per_second = 0;
  std::uint64_t pairs = 0, apart = 0;
  float exposure_us = 0;  // as asked for last
  bool can_be_set = false;
  bool relief_shown = false, edges_shown = false;
  Picture relief;  // near is bright, black is unknown
  Fault problem;   // why there is no relief
};

inline constexpr std::size_t kCalibrationRows = 6, kCoverageCells = 8;
struct TechnicianCalibrationRow {
  std::uint32_t revision = 0;
  bool active = false;
  std::string_view made_at;
  float depth_error_mm = 0;  // 0: not known
};
struct TechnicianCalibration {
  int columns = 10, rows = 7;
  float square_mm = 20;
  bool charuco = false;
  bool mounted_anew = false;  // the next one may find the cameras at another distance
  bool running = false, ended = false, stored = false;
  std::array<Picture, 2> pictures;  // with the corners and the wanted board drawn in
  pipeline::LiveAdvice advice = pipeline::LiveAdvice::ShowBoard;
  pipeline::LiveEnd end = pipeline::LiveEnd::NotYet;
  int views = 0, disagreeing = 0;
  bool enough = false;          // for a verdict
  std::array<float, 4> bars{};  // across, down, size, tilt: 0 to 1
  std::array<std::array<std::uint32_t, kCoverageCells * kCoverageCells>, 2>
      seen{};                       // corners in each part of the pictures, row by row
  float error_mm = 0, goal_mm = 0;  // predicted, of distances, one standard deviation
  pipeline::CalibrationVerdict verdict = pipeline::CalibrationVerdict::Refuse;  // once it has ended
  float depth_error_mm = 0, rms_px = 0, baseline_mm = 0;
  std::span<const float> views_px;  // disagreement with the board, each view of the fit; rms of both cameras
  std::span<const std::string> reasons;  // why it is good, doubted or refused, most important first; English
  std::string_view exported;             // the folder on the stick; empty: none was
  Fault problem;                         // what went wrong
  std::array<TechnicianCalibrationRow, kCalibrationRows> history{};
  std::size_t history_count = 0;  // of a page
  ListPlace place;
};

// Which algorithms there are, which are chosen, and the option that is being edited; and a page of a
// table of numbers. Texts are borrowed for a frame.
struct TechnicianName {
  std::string_view name;
  bool chosen = false;
};
struct TechnicianKind {
  std::string_view key, value, sentence;
  bool several = false;
};
struct TechnicianOption {
  std::string_view key, value, sentence;
  double least = 0, most = 0;
  bool text = false, changed = false;
};
struct TechnicianChoice {
  std::span<const TechnicianKind> kinds;
  std::size_t kind = 0;
  std::span<const TechnicianName> names;      // of the kind
  std::span<const TechnicianOption> options;  // of the kind's chosen algorithms
  const TechnicianOption* edited = nullptr;   // one of them
  std::string_view typed, refused;            // what was typed, and why it was not taken
};

struct TechnicianRows {
  TechnicianTable table = TechnicianTable::Matches;
  std::span<const std::string_view> heads;  // symbols and units
  std::span<const std::string_view> cells;  // row by row
  ListPlace place;  // of matches also filtered; 1: accepted, from 2 on rejected by that rule of the result
};

// The test capture, or all of the reconstruction, on its way to the stick; or a saved one on its way back.
struct TechnicianRecording : Work {
  std::string_view where;  // the folder on the stick; empty: nothing is there
};

inline constexpr std::size_t kSavedRows = 32;
struct TechnicianSaved {
  bool listed = false;                 // shown in place of the capture
  std::span<const std::string> names;  // the newest first, kSavedRows at most
};

// A surface against the present one, both as the left view sees them: positive where this one is nearer.
// Along the view's axis.
struct TechnicianDifference {
  bool known = false;
  float median_mm = 0;
  float most_mm = 0;  // 95 of 100 places differ by less, either way
  Picture map;
  const pipeline::TextureAtlas* colours = nullptr;  // the same on its surface
  std::uint32_t number = 0;                         // of the surface in these colours
};

// A result beside others: what it made of the stage that is shown.
inline constexpr std::size_t kCompared = 4;
struct TechnicianCompared {
  TechnicianResult result;
  Picture picture;                             // empty: the stage made none
  const pipeline::FaceModel* model = nullptr;  // of a surface: to be turned; missing: none, or too large
  std::uint32_t model_number = 0;
  TechnicianDifference difference{};  // not of the present one
};

// How a pose lies in the first one's frame, and how well it agrees with each of the others.
inline constexpr std::size_t kTechnicianPoses = 7;
struct TechnicianPose {
  bool joined = true;
  float turned_deg = 0;
  std::array<float, kTechnicianPoses> rms_mm{};  // 0: they show nothing in common
};

struct TechnicianView {
  TechnicianPhase phase = TechnicianPhase::Empty;
  bool calibrated = true;  // without it there is no test capture, unless it was loaded with its own
  float progress = 0;
  std::uint8_t working_on = 0;  // of the stages, while phase is Running
  Fault problem;
  TechnicianStage stage = TechnicianStage::Rectified;
  std::array<Picture, 2> shown{};  // of the stage; the second is empty where there is one only
  TechnicianPoint point;
  bool by_hand = false;  // touches make pairs; `point` is the chosen one
  std::span<const TechnicianPoint> pairs;
  bool pairs_changed = false;  // since they were calculated with
  TechnicianChange change;
  bool can_add_side = false;
  std::size_t sides = 0;  // that wait for the next calculation
  std::array<TechnicianPose, kTechnicianPoses> poses{};
  std::size_t pose_count = 0;
  float full_residual_mm = 0;  // of the picture of the poses: the ends of its scale
  bool can_record = false;     // there is a capture, and nobody is at work on it
  TechnicianRecording recording;
  TechnicianSaved saved;
  TechnicianResult result;                               // the present one
  std::array<TechnicianCompared, kCompared> compared{};  // those put aside, and behind them the present one
  std::size_t put_aside = 0;                             // so many of them
  bool differences = false;                              // they are shown
  float full_colour_mm = 0;                              // of all differences: the ends of their scale
  std::span<const std::array<std::uint8_t, 3>> scale;    // from farther to nearer
  bool applied = false;  // visitors are measured with the chosen algorithms now
  const pipeline::FaceModel* model = nullptr;
  const pipeline::PointCloud* cloud = nullptr;
  std::uint32_t model_number = 0;
  TechnicianChoice choice;
  TechnicianRows rows;
  TechnicianCameras cameras;
  TechnicianCalibration calibration;
};

}  // namespace relievo::ui
