// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a set of algorithms made of a test capture, and what is known of a place that was touched.
// Pixels of the rectified views; millimetres in the left camera's frame. Texts are borrowed for a frame.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>

#include "hal/base/image_view.h"
#include "pipeline/model/geometry.h"
#include "ui/view/fault.h"
#include "ui/view/staff_request.h"

namespace relievo::ui {

enum class TechnicianPhase : std::uint8_t { Empty, Capturing, Running, Ready, Failed };

struct TechnicianPicture {
  ImageView pixels;  // Rgb8; empty: there is none
  std::uint32_t version = 0;
};

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

}  // namespace relievo::ui
