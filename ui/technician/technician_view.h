// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// TechnicianView: everything the technician's picture pages may draw, as plain data. No person's name comes
// here. Everything is borrowed from firmware/technician for the length of one frame. Thread: main.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "pipeline/model/face_model.h"
#include "pipeline/model/point_cloud.h"
#include "ui/technician/technician_cameras.h"
#include "ui/technician/technician_result.h"
#include "ui/view/list_place.h"
#include "ui/view/service_view.h"

namespace relievo::ui {

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

// The pages that have something under way only while they are open.
enum class TechnicianPage : std::uint8_t { Stages, Model, Tables, Algorithms, Compare, Cameras, Calibrate };

// The test capture, or all of the reconstruction, on its way to the stick; or a saved one on its way back.
struct TechnicianRecording : Work {
  std::string_view where;  // the folder on the stick; empty: nothing is there
};

inline constexpr std::size_t kSavedRows = 6;
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
  TechnicianPicture map;
  const pipeline::TextureAtlas* colours = nullptr;  // the same on its surface
  std::uint32_t number = 0;                         // of the surface in these colours
};

// A result beside others: what it made of the stage that is shown.
inline constexpr std::size_t kCompared = 4;
struct TechnicianCompared {
  TechnicianResult result;
  TechnicianPicture picture;                   // empty: the stage made none
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
  std::array<TechnicianPicture, 2> shown{};  // of the stage; the second is empty where there is one only
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
