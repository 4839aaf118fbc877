// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/calibrator.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "hal/base/statistics.h"
#include "hal/base/words.h"
#include "pipeline/calibrate/file/calibration_file.h"
#include "pipeline/calibrate/fit/stereo_fit.h"
#include "pipeline/calibrate/quality/quality_measures.h"

namespace relievo::pipeline {
namespace {

// A corner this many standard deviations off is no noise; a board with more than this share of such
// corners was wrongly found, or its paper is loose.
constexpr double kStrayCorner = 6;
// Nor is a corner a stray that is as near as this: pixels do not show a sharp edge any better that runs
// exactly along them, however quiet the other corners are.
constexpr double kLeastStrayPx = 0.05;
constexpr double kLooseShare = 0.15;

Result<void> check_input(const CalibratorInput& input) {
  RELIEVO_TRY(input.pattern.check());
  if (input.width_px < 16 || input.height_px < 16 || input.width_px > 8192 || input.height_px > 8192)
    return invalid("pictures must have 16 to 8192 pixels a side");
  if (input.views.size() > kMaxBoardPairs) return invalid("more than 500 pairs; a few dozen are enough");
  const auto corners = std::size_t(input.pattern.corners());
  for (const BoardView& view : input.views)
    for (const BoardCorners* board : {&view.left, &view.right}) {
      if (!board->empty() && board->size() != corners)
        return invalid("a board with another number of corners than the pattern").at(view.name);
      if (!std::ranges::all_of(*board, [](const Vec2d& at) {
            return !seen(at) || (std::abs(at.x) < 1e5 && std::abs(at.y) < 1e5);
          }))
        return invalid("a corner far outside the picture").at(view.name);
    }
  return {};
}

std::vector<int> boards(const CalibratorInput& input, bool right) {
  std::vector<int> views;
  for (std::size_t i = 0; i < input.views.size(); ++i)
    if (!(right ? input.views[i].right : input.views[i].left).empty()) views.push_back(int(i));
  return views;
}

std::vector<CornerResidual> residuals(const BoardPattern& pattern, const CameraIntrinsics& camera,
                                      const bundle::Pose& camera_from_board, const BoardCorners& corners) {
  std::vector<CornerResidual> all;
  all.reserve(corners.size());
  for (int i = 0; i < pattern.corners(); ++i) {
    const Vec2d& at = corners[std::size_t(i)];
    const Vec2d put = bundle::project(camera, camera_from_board * bundle::on_board(pattern, i));
    // A corner that was not seen is not-a-number, and so is its residual.
    all.push_back({at, {at.x - put.x, at.y - put.y}});
  }
  return all;
}

struct Strays {
  double limit_px = 0;
  std::vector<std::vector<int>> of_view;  // corner numbers
};

Strays find_strays(const CalibratorInput& input, bool right, std::span<const int> views,
                   const CameraFit& fit) {
  std::vector<std::vector<double>> off(views.size());
  std::vector<double> all;
  for (std::size_t v = 0; v < views.size(); ++v) {
    const BoardView& view = input.views[std::size_t(views[v])];
    for (const CornerResidual& c :
         residuals(input.pattern, fit.camera(), fit.pose(views[v]), right ? view.right : view.left)) {
      off[v].push_back(seen(c.at) ? std::hypot(c.off.x, c.off.y) : 0);
      if (seen(c.at)) all.push_back(off[v].back());
    }
  }
  constexpr double kMedianOfDistance = 1.1774;  // in standard deviations of one coordinate
  Strays strays{std::max(kStrayCorner * median(all) / kMedianOfDistance, kLeastStrayPx), {}};
  for (const auto& view : off) {
    auto& of_view = strays.of_view.emplace_back();
    for (std::size_t i = 0; i < view.size(); ++i)
      if (view[i] > strays.limit_px) of_view.push_back(int(i));
  }
  return strays;
}

// One camera alone, without stray corners (set to not-a-number) and without boards that have many:
// the worst of these goes first, since it bends the fit of the others.
bool fit_without_strays(CalibratorInput& input, bool right, std::vector<int>& views, CameraFit& fit,
                        CalibrationQuality& quality) {
  for (std::size_t round = 0; round < kMaxBoardPairs; ++round) {
    if (views.size() < kMinBoardPairs || !fit_camera(input, right, views, fit)) return false;
    const Strays strays = find_strays(input, right, views, fit);
    const auto worst = std::ranges::max_element(
        strays.of_view, [](const auto& a, const auto& b) { return a.size() < b.size(); });
    if (worst->empty()) return true;
    if (double(worst->size()) > kLooseShare * input.pattern.corners()) {
      const auto at = worst - strays.of_view.begin();
      std::string& reason = quality.views[std::size_t(views[std::size_t(at)])].reason;
      if (!reason.empty()) reason += "; ";
      reason +=
          filled("{}: {} corners are more than {} px off any flat board",
                 {right ? "right" : "left", std::to_string(worst->size()), decimal(strays.limit_px, 2)});
      views.erase(views.begin() + at);
      continue;
    }
    for (std::size_t v = 0; v < views.size(); ++v) {
      BoardView& view = input.views[std::size_t(views[v])];
      for (const int corner : strays.of_view[v])
        (right ? view.right : view.left)[std::size_t(corner)] = {std::nan(""), std::nan("")};
      quality.views[std::size_t(views[v])].corners_dropped += int(strays.of_view[v].size());
    }
  }
  return true;
}

void name_left_out(const CalibratorInput& input, const Selection& selection, std::span<const int> pairs,
                   CalibrationQuality& quality) {
  for (const int pair : pairs) {
    ViewQuality& view = quality.views[std::size_t(pair)];
    if (view.used) continue;
    const double usual =
        std::sqrt(6 * selection.spread_px2 / double(corners_seen(input.views[std::size_t(pair)])));
    if (quality.moved_after >= 0 && view.excess_px < 2 * usual)
      view.reason = filled("taken on the other side of a camera's move ({})",
                           {quality.views[std::size_t(quality.moved_after)].name});
    else
      view.reason =
          filled("left and right disagree with the other views by {} px (usual here: {} px), epipolar {} px",
                 {decimal(view.excess_px, 2), decimal(usual, 2), decimal(view.epipolar_rms_px, 2)});
  }
}

// Another lens, another sensor or another focus changes a focal length by more than this.
constexpr double kSameLens = 0.01;

bool same_lens(const CameraIntrinsics& a, const CameraIntrinsics& b) {
  return a.width_px == b.width_px && a.height_px == b.height_px &&
         std::abs(a.focal_px.x / b.focal_px.x - 1) < kSameLens &&
         std::abs(a.focal_px.y / b.focal_px.y - 1) < kSameLens;
}

// A board's square size scales the baseline and leaves the lenses alone: by the lenses the rig is known
// again.
void expect_baseline(const CalibratorInput& input, const StereoCalibration& found,
                     CalibrationQuality& quality) {
  quality.expected_baseline_mm = input.expected_baseline_mm;
  if (input.expected_baseline_mm > 0 || !input.in_use) return;
  if (!same_lens(found.left, input.in_use->left) || !same_lens(found.right, input.in_use->right)) return;
  const Vec3d& t = input.in_use->right_from_left.translation_mm;
  quality.expected_baseline_mm = std::hypot(t.x, t.y, t.z);
  quality.expected_as_in_use = true;
}

std::vector<FittedView> fitted_views(std::size_t count, const StereoFit& fit) {
  std::vector<FittedView> views(count);
  const bundle::Problem& p = fit.problem;
  for (std::size_t k = 0; k < fit.views.size(); ++k) {
    const bundle::View& from = p.views[k];
    FittedView& view = views[std::size_t(fit.views[k])];
    const bundle::Pose& pose = from.left_from_board;
    if (from.seen[0] != nullptr) view.left = residuals(p.pattern, p.camera[0], pose, *from.seen[0]);
    if (from.seen[1] != nullptr)
      view.right = residuals(p.pattern, p.camera[1], p.right_from_left * pose, *from.seen[1]);
    if (!view.placed || from.seen[0] != nullptr) view.left_from_board = transform_of(pose);
    view.placed = true;
  }
  return views;
}

// How many pairs there were stands behind the sentence in every language: so without a word.
Error poor_geometry(Literal what, std::size_t pairs) {
  return Error{Errc::PoorGeometry, what}.at("n = " + std::to_string(pairs));
}

}  // namespace

Result<CalibratorOutput> calibrate(const CalibratorInput& given) {
  RELIEVO_TRY(check_input(given));
  CalibratorInput input = given;
  CalibratorOutput out;
  for (BoardView& view : input.views) {
    ViewQuality& q = out.quality.views.emplace_back();
    q.name = view.name;
    if (view.left.empty() && view.right.empty()) q.reason = "no board found in left and right";
    else if (view.left.empty()) q.reason = "no board found in left";
    else if (view.right.empty()) q.reason = "no board found in right";
    else pair_order(view.left, view.right, input.pattern);
  }
  std::vector<int> left = boards(input, false);
  std::vector<int> right = boards(input, true);
  const auto in_both = [&] {
    std::vector<int> both;
    std::ranges::set_intersection(left, right, std::back_inserter(both));
    return both;
  };
  std::vector<int> pairs = in_both();
  if (pairs.size() < kMinBoardPairs)
    return poor_geometry("the whole board is in both pictures of too few pairs; take at least 5, better 15",
                         pairs.size());

  CameraFit left_fit;
  CameraFit right_fit;
  const Error undetermined = poor_geometry(
      "these views do not determine the cameras; tilt the board, and fill the picture with it", pairs.size());
  if (!fit_without_strays(input, false, left, left_fit, out.quality) ||
      !fit_without_strays(input, true, right, right_fit, out.quality))
    return undetermined;
  pairs = in_both();
  if (pairs.size() < kMinBoardPairs)
    return poor_geometry("too few pairs show a flat board; is the print glued to something stiff?",
                         pairs.size());

  const CameraFits cameras{input, left_fit, right_fit};
  Selection selection;
  if (!select_views(cameras, pairs, selection)) return undetermined;
  const bundle::Problem& rig = selection.fit.problem;
  out.calibration = {.left = rig.camera[0],
                     .right = rig.camera[1],
                     .right_from_left = bundle::transform_of(rig.right_from_left),
                     .rms_px = selection.fit.rms_px()};
  const Vec3d stands = inverse(out.calibration.right_from_left).translation_mm;
  if (stands.x < 0 && -stands.x >= std::abs(stands.y))
    return poor_geometry("the left pictures come from the right camera; exchange the two", pairs.size());
  RELIEVO_TRY(check_calibration(out.calibration));
  measure_quality({cameras, pairs, selection}, out.quality);
  out.calibration.epipolar_shift_px = out.quality.held_out_shift_px;
  name_left_out(input, selection, pairs, out.quality);
  expect_baseline(input, out.calibration, out.quality);
  out.views = fitted_views(input.views.size(), selection.fit);
  judge_quality(out.quality);
  return out;
}

}  // namespace relievo::pipeline
