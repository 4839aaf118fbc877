// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/live/view_planner.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <Eigen/Cholesky>

#include "pipeline/calibrate/fit/stereo_fit.h"
#include "pipeline/calibrate/quality/rig_geometry.h"

namespace relievo::pipeline {
namespace {

constexpr double kDistances[] = {1, 0.8, 1.25};  // of the distance wanted
constexpr double kTiltRad = 0.7;                 // 40 degrees: enough for a full skew bar
constexpr int kTilts = 9;                        // facing, then eight ways round the compass
constexpr double kTurnRad = 0.6;                 // about the line of sight, in the middle only
constexpr double kEdgeShare = 0.03;              // of the picture stays free
constexpr int kOutSteps = 20;

using bundle::Globals;
using bundle::GlobalVector;
using bundle::Problem;

bundle::Pose pose_in(const Problem& rig, std::size_t eye, const bundle::Pose& left_from_board) {
  return eye == 0 ? left_from_board : rig.right_from_left * left_from_board;
}

// With the squares around the outer corners.
bool seen_whole(const Problem& rig, const bundle::Pose& left_from_board) {
  for (const std::size_t eye : {0U, 1U}) {
    const CameraIntrinsics& camera = rig.camera[eye];
    const double edge_px = kEdgeShare * camera.width_px;
    const bundle::Pose pose = pose_in(rig, eye, left_from_board);
    for (const double column : {-1, rig.pattern.columns})
      for (const double row : {-1, rig.pattern.rows}) {
        const Eigen::Vector3d corner = pose * bundle::on_board(rig.pattern, column, row);
        const Vec2d at = bundle::project(camera, corner);
        if (!(corner.z() >= 1 && at.x > edge_px && at.y > edge_px && at.x < camera.width_px - edge_px &&
              at.y < camera.height_px - edge_px))
          return false;
      }
  }
  return true;
}

// As far towards (across, down) from the picture's middle as it stays whole; false where it never is.
bool place(const Problem& rig, const Eigen::Matrix3d& rotation, double distance_mm, int across, int down,
           bundle::Pose& pose) {
  const CameraIntrinsics& camera = rig.camera[0];
  pose.rotation = rotation;
  for (int step = across == 0 && down == 0 ? 0 : kOutSteps; step >= 0; --step) {
    const double out = 0.5 * step / kOutSteps;
    const Vec2d at = {(0.5 + out * across) * camera.width_px, (0.5 + out * down) * camera.height_px};
    pose.translation_mm = distance_mm * ray_of(camera, at) - rotation * bundle::middle_of(rig.pattern);
    if (seen_whole(rig, pose)) return step > 0 || (across == 0 && down == 0);
  }
  return false;
}

Eigen::Matrix3d tilted(int tilt) {
  if (tilt == 0) return Eigen::Matrix3d::Identity();
  const double compass = (tilt - 1) * std::numbers::pi / 4;
  return bundle::rotation_of(kTiltRad * Eigen::Vector3d(std::cos(compass), std::sin(compass), 0));
}

Eigen::Matrix3d turned(double by_rad) { return bundle::rotation_of(by_rad * Eigen::Vector3d::UnitZ()); }

// A view is new that differs by so much (distance_between()); a candidate by more, since nobody hits it
// exactly.
constexpr double kNewDistance = 0.2, kSafelyNew = 1.5;
// A tenth of a bar counts as much as lowering the error by 5 %.
constexpr double kBarWorth = 0.5;
constexpr double kPastGoal = 0.2;  // what lowering the error counts when the goal is reached
// Tolerances of a target, in the axes' own units.
constexpr std::array<double, kBoardAxes> kTolerance = {0.04, 0.05, 0.07, 0.13, 0.13, 0.2};

// Of the depths of a field's nine points at kFaceMm, by steps of one `unit` of each global; `rig` without
// views.
DepthByGlobals depth_by_globals(const Problem& rig, const GlobalVector& unit) {
  const Probes probes = probes_of(rig, depth_field(kFaceMm));
  DepthByGlobals by;
  for (int i = 0; i < bundle::kGlobals; ++i) {
    const auto depths = [&](double step) -> Eigen::Matrix<double, 9, 1> {
      Problem moved = rig;
      bundle::step_globals(moved, step * unit[i] * GlobalVector::Unit(i));
      return cloud_of(moved, probes).row(2).transpose();
    };
    by.col(i) = 0.5 * (depths(1) - depths(-1));
  }
  return by;
}

// Mean variance of the depths, in units of the noise.
double variance_of(const DepthByGlobals& by, const Globals& even_information) {
  const Eigen::Matrix<double, bundle::kGlobals, 9> solved = even_information.ldlt().solve(by.transpose());
  return (by * solved).trace() / 9;
}

// The calibration's used views (the first of the input's) as a solved problem: it knows its information and
// covariance. False where they do not determine it.
bool solved_problem(const CalibratorInput& input, const CalibratorOutput& calibrated, Problem& solved) {
  const Problem rig = rig_problem(calibrated.calibration, input.pattern);
  solved = rig;
  for (std::size_t v = 0; v < std::min(input.views.size(), calibrated.quality.views.size()); ++v) {
    if (!calibrated.quality.views[v].used) continue;
    const BoardView& view = input.views[v];
    Problem one = rig;
    if (!lay_board(one, view.left, view.right)) return false;
    solved.views.push_back(one.views[0]);
  }
  solved.free.fill(true);
  for (const int eye : {0, 1}) set_priors(solved, eye);
  const double left = calibrated.quality.left_rms_px;
  const double right = calibrated.quality.right_rms_px;
  solved.noise_px2 = std::max(1e-6, 0.25 * (left * left + right * right));  // rms is of both coordinates
  return bundle::solve(solved);
}

}  // namespace

std::vector<CandidatePose> candidate_poses(const bundle::Problem& rig, double distance_mm,
                                           int quarter_turns) {
  std::vector<CandidatePose> poses;
  std::size_t number = 0;
  const auto add = [&](double distance, int across, int down, int tilt, double turn_rad) {
    ++number;
    bundle::Pose pose;
    const Eigen::Matrix3d rotation = tilted(tilt) * turned(turn_rad + quarter_turns * 0.5 * std::numbers::pi);
    if (!place(rig, rotation, distance * distance_mm, across, down, pose)) return;
    CandidatePose& candidate = poses.emplace_back(CandidatePose{number, pose, {}});
    for (const std::size_t eye : {0U, 1U})
      for (int i = 0; i < rig.pattern.corners(); ++i)
        candidate.corners[eye].push_back(
            bundle::project(rig.camera[eye], pose_in(rig, eye, pose) * bundle::on_board(rig.pattern, i)));
  };
  for (const double distance : kDistances)
    for (int tilt = 0; tilt < kTilts; ++tilt) {
      for (int down = -1; down <= 1; ++down)
        for (int across = -1; across <= 1; ++across) add(distance, across, down, tilt, 0);
      if (tilt % 2 == 1 || tilt == 0)
        for (const double turn : {-kTurnRad, kTurnRad}) add(distance, 0, 0, tilt, turn);
    }
  return poses;
}

LiveEnd end_of(const std::optional<ViewPlan>& plan, bool reached, double plateau_gain) {
  if (!plan || plan->best_bar_gain >= plateau_gain || (!reached && plan->best_gain >= plateau_gain))
    return LiveEnd::NotYet;
  return reached ? LiveEnd::GoalReached : LiveEnd::Plateau;
}

bool ViewPlanner::update(const CalibratorInput& input, const CalibratorOutput& now, double error_mm,
                         TakenViews taken, const std::array<Coverage, 2>& coverage,
                         const LiveOptions& options) {
  Problem solved;
  if (input.views.empty() || !solved_problem(input, now, solved)) return false;
  unit_ = (solved.noise_px2 * solved.covariance.diagonal().cwiseMax(1e-30)).cwiseSqrt();
  information_ = unit_.asDiagonal() * solved.information * unit_.asDiagonal();
  rig_ = std::move(solved);
  rig_.views.clear();
  depth_ = depth_by_globals(rig_, unit_);
  variance_ = variance_of(depth_, information_);
  options_ = options;
  error_mm_ = error_mm;
  taken_.assign(taken.begin(), taken.end());
  coverage_ = coverage;
  const BoardOutline outline = outline_of(input.views.back().left, input.pattern);
  const double angle = std::atan2(outline[1].y - outline[0].y, outline[1].x - outline[0].x);
  quarter_turns_ = int(std::lround(angle / (0.5 * std::numbers::pi)));
  return true;
}

ViewParameters ViewPlanner::parameters(const BoardCorners& left, const BoardCorners& right) const {
  const CameraIntrinsics& camera = rig_.camera[0];
  return {parameters_of(left, rig_.pattern, camera.width_px, camera.height_px),
          parameters_of(right, rig_.pattern, camera.width_px, camera.height_px)};
}

bool is_new(const ViewParameters& view, TakenViews taken, double times) {
  return std::ranges::all_of(taken, [&](const ViewParameters& other) {
    return std::max(distance_between(view[0], other[0]), distance_between(view[1], other[1])) >
           times * kNewDistance;
  });
}

// Share by which the view lowers the error.
double ViewPlanner::error_gain(const bundle::View& view) const {
  const Globals added = unit_.asDiagonal() * bundle::information_of(rig_, view) * unit_.asDiagonal();
  return 1 - std::sqrt(variance_of(depth_, information_ + added) / variance_);
}

double ViewPlanner::bar_gain(const ViewParameters& view) const {
  const auto sum = [full = options_.full_bar](const CoverageBars& bars) {
    return std::min(bars.x, full) + std::min(bars.y, full) + std::min(bars.size, full) +
           std::min(bars.skew, full);
  };
  return sum(lesser(coverage_[0].bars_with(view[0]), coverage_[1].bars_with(view[1]))) -
         sum(lesser(coverage_[0].bars(), coverage_[1].bars()));
}

double ViewPlanner::worth(double error_gain, double bar_gain) const {
  return (error_mm_ > options_.goal_mm ? 1 : kPastGoal) * error_gain + kBarWorth * bar_gain;
}

double ViewPlanner::worth(const BoardCorners& left, const BoardCorners& right) const {
  Problem one = rig_;
  if (!lay_board(one, left, right)) return 0;
  return worth(error_gain(one.views[0]), bar_gain(parameters(left, right)));
}

ViewPlan ViewPlanner::plan(std::span<const std::size_t> excluded) const {
  ViewPlan plan;
  for (const CandidatePose& pose : candidate_poses(rig_, kFaceMm, quarter_turns_)) {
    if (std::ranges::find(excluded, pose.number) != excluded.end()) continue;
    const ViewParameters view = parameters(pose.corners[0], pose.corners[1]);
    if (!is_new(view, taken_, kSafelyNew)) continue;
    const double error = error_gain({&pose.corners[0], &pose.corners[1], pose.left_from_board});
    const double bars = bar_gain(view);
    plan.best_gain = std::max(plan.best_gain, error);
    plan.best_bar_gain = std::max(plan.best_bar_gain, bars);
    if (plan.best && worth(error, bars) <= plan.best_worth) continue;
    plan.best_worth = worth(error, bars);
    const auto outline = [&](std::size_t eye) { return outline_of(pose.corners[eye], rig_.pattern); };
    plan.best = PlannedView{
        {.at = axes_of(view[0]), .tolerance = kTolerance, .outlines = std::array{outline(0), outline(1)}},
        pose.number};
  }
  return plan;
}

Problem rig_problem(const StereoCalibration& calibration, const BoardPattern& pattern) {
  Problem rig;
  rig.pattern = pattern;
  rig.camera = {calibration.left, calibration.right};
  rig.right_from_left = bundle::pose_of(calibration.right_from_left);
  return rig;
}

bool lay_board(Problem& rig, const BoardCorners& left, const BoardCorners& right) {
  // Where the board stands, from the left camera alone; good enough to start from.
  Problem one;
  one.pattern = rig.pattern;
  one.camera[0].width_px = rig.camera[0].width_px;
  one.camera[0].height_px = rig.camera[0].height_px;
  one.views.emplace_back(&left, nullptr, bundle::Pose{});
  bundle::first_guess(one);
  bundle::Pose pose = one.views[0].left_from_board;
  pose.translation_mm.z() *= rig.camera[0].focal_px.x / one.camera[0].focal_px.x;
  rig.views.emplace_back(&left, &right, pose);
  return bundle::solve_poses(rig);
}

}  // namespace relievo::pipeline
