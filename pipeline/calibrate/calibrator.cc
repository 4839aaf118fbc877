// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/calibrator.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>

#include "pipeline/calibrate/calibration_file.h"
#include "pipeline/calibrate/quality_measures.h"
#include "pipeline/calibrate/stereo_fit.h"
#include "pipeline/calibrate/view_selection.h"

namespace relievo::pipeline {
namespace {

// A board whose corners fit no flat board at all: wrongly found, or the paper is loose.
constexpr double kLooseBoard = 4;    // times the median rms of the camera's boards
constexpr double kLooseBoardPx = 0.5;

Result<void> check_input(const CalibratorInput& input) {
  RELIEVO_TRY(input.pattern.check());
  if (input.width_px < 16 || input.height_px < 16 || input.width_px > 8192 || input.height_px > 8192)
    return Error{Errc::InvalidInput, "pictures must have 16 to 8192 pixels a side"};
  if (input.views.size() > kMaxBoardPairs) return Error{Errc::InvalidInput, "more than 500 pairs; a few dozen are enough"};
  const auto corners = static_cast<std::size_t>(input.pattern.corners());
  for (const BoardView& view : input.views)
    for (const BoardCorners* seen : {&view.left, &view.right}) {
      if (!seen->empty() && seen->size() != corners)
        return Error{Errc::InvalidInput, "a board with another number of corners than the pattern"}.at(view.name);
      if (!std::all_of(seen->begin(), seen->end(), [](const Vec2d& at) { return std::abs(at.x) < 1e5 && std::abs(at.y) < 1e5; }))
        return Error{Errc::InvalidInput, "a corner far outside the picture"}.at(view.name);
    }
  return {};
}

std::vector<int> boards(const CalibratorInput& input, bool right) {
  std::vector<int> views;
  for (std::size_t i = 0; i < input.views.size(); ++i)
    if (!(right ? input.views[i].right : input.views[i].left).empty()) views.push_back(static_cast<int>(i));
  return views;
}

// Takes boards out that no pose explains; says so in the view's reason.
bool fit_without_loose(const CalibratorInput& input, bool right, int terms, std::vector<int>& views, CameraFit& fit,
                       CalibrationQuality& quality) {
  for (int round = 0; round < 3; ++round) {
    if (!fit_camera(input, right, views, terms, fit)) return false;
    std::vector<double> rms;
    for (const int view : views) rms.push_back(std::sqrt(fit.squared_px(view) / input.pattern.corners()));
    std::vector<double> sorted = rms;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    const double limit = std::max(kLooseBoard * *middle, kLooseBoardPx);
    std::vector<int> kept;
    for (std::size_t i = 0; i < views.size(); ++i) {
      if (rms[i] <= limit) {
        kept.push_back(views[i]);
        continue;
      }
      char text[160];
      std::snprintf(text, sizeof text, "%s: corners %.2f px off any flat board (others %.2f px)", right ? "right" : "left", rms[i], *middle);
      quality.views[static_cast<std::size_t>(views[i])].reason = text;
    }
    if (kept.size() == views.size()) return true;
    views = std::move(kept);
    if (views.size() < kMinBoardPairs) return false;
  }
  return fit_camera(input, right, views, terms, fit);
}

void name_views(const CalibratorInput& input, CalibrationQuality& quality) {
  for (const BoardView& view : input.views) {
    ViewQuality& q = quality.views.emplace_back();
    q.name = view.name;
    if (view.left.empty() && view.right.empty()) q.reason = "no board found in left and right";
    else if (view.left.empty()) q.reason = "no board found in left";
    else if (view.right.empty()) q.reason = "no board found in right";
  }
}

void name_left_out(const Selection& selection, std::span<const int> pairs, CalibrationQuality& quality) {
  for (const int pair : pairs) {
    ViewQuality& view = quality.views[static_cast<std::size_t>(pair)];
    if (view.used) continue;
    const double usual = std::sqrt(6 * selection.spread_px2 / (2.0 * selection.fit.problem.pattern.corners()));
    char text[160];
    std::snprintf(text, sizeof text, "left and right disagree with the other views by %.2f px (usual here: %.2f px), epipolar %.2f px",
                  view.excess_px, usual, view.epipolar_rms_px);
    view.reason = text;
  }
}

StereoCalibration calibration_of(const StereoFit& fit) {
  StereoCalibration calibration;
  calibration.left = fit.problem.camera[0];
  calibration.right = fit.problem.camera[1];
  calibration.right.width_px = calibration.left.width_px;
  calibration.right.height_px = calibration.left.height_px;
  const bundle::Pose& relation = fit.problem.right_from_left;
  for (int i = 0; i < 9; ++i) calibration.right_from_left.rotation.m[i] = relation.rotation(i / 3, i % 3);
  const Eigen::Vector3d& t = relation.translation_mm;
  calibration.right_from_left.translation_mm = {t.x(), t.y(), t.z()};
  calibration.rms_px = fit.rms_px();
  return calibration;
}

Error too_few(Literal what, std::size_t count) {
  return Error{Errc::PoorGeometry, what}.at(std::to_string(count) + " pairs");
}

}  // namespace

Result<CalibratorOutput> calibrate(const CalibratorInput& given) {
  RELIEVO_TRY(check_input(given));
  CalibratorInput input = given;
  for (BoardView& view : input.views)
    if (!view.left.empty() && !view.right.empty()) pair_order(view.left, view.right, input.pattern);
  CalibratorOutput out;
  name_views(input, out.quality);
  std::vector<int> left = boards(input, false);
  std::vector<int> right = boards(input, true);
  std::vector<int> pairs;
  std::set_intersection(left.begin(), left.end(), right.begin(), right.end(), std::back_inserter(pairs));
  if (pairs.size() < kMinBoardPairs)
    return too_few("the whole board is in both pictures of too few pairs; take at least 5, better 15", pairs.size());

  constexpr int kFirstTerms = 2;
  CameraFit left_fit;
  CameraFit right_fit;
  const Error undetermined = too_few("these views do not determine the cameras; tilt the board, and fill the picture with it", pairs.size());
  if (!fit_without_loose(input, false, kFirstTerms, left, left_fit, out.quality) ||
      !fit_without_loose(input, true, kFirstTerms, right, right_fit, out.quality))
    return undetermined;
  const int terms = choose_distortion_terms(input, left, right);
  if (!fit_camera(input, false, left, terms, left_fit) || !fit_camera(input, true, right, terms, right_fit)) return undetermined;
  pairs.clear();
  std::set_intersection(left.begin(), left.end(), right.begin(), right.end(), std::back_inserter(pairs));
  if (pairs.size() < kMinBoardPairs) return too_few("too few pairs show a flat board; is the print glued to something stiff?", pairs.size());

  const CameraFits cameras{left_fit, right_fit, terms};
  Selection selection;
  if (!select_views(input, cameras, pairs, selection)) return undetermined;
  out.calibration = calibration_of(selection.fit);
  RELIEVO_TRY(check_calibration(out.calibration));
  measure_quality({input, cameras, pairs, selection}, out.quality);
  name_left_out(selection, pairs, out.quality);
  judge_quality(out.quality);
  return out;
}

}  // namespace relievo::pipeline
