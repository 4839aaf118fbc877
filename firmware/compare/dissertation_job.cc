// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <random>

#include "firmware/base/boot_memory.h"
#include "firmware/calibrate/calibrate_command.h"
#include "firmware/compare/set_run.h"
#include "pipeline/algorithms.h"
#include "pipeline/base/stage.h"
#include "pipeline/calibrate/file/calibration_file.h"
#include "pipeline/model/calibration.h"
#include "pipeline/model/vector3.h"

namespace relievo::firmware::compare {
namespace {

using pipeline::CameraIntrinsics;
using pipeline::Vec2d;
using pipeline::Vec3d;

constexpr double kUnitMm = 10;
constexpr int kBoards = 8;
constexpr std::size_t kHands = 100;

// Where a camera sees a point of its frame.
Vec2d seen(const CameraIntrinsics& c, const Vec3d& p) {
  return pipeline::pixel_of_ray(c, {p.x / p.z, p.y / p.z});
}

// Turned about y by 34 and about x by 26 degrees, so that three faces look at the cameras. Corners whose
// numbers differ in one bit share an edge.
std::vector<Vec3d> cube_corners(const Vec3d& middle) {
  const double half = 0.5 * recorded::kCubeUnits * kUnitMm;
  const double cy = std::cos(0.6), sy = std::sin(0.6), cx = std::cos(0.45), sx = std::sin(0.45);
  std::vector<Vec3d> corners;
  for (unsigned i = 0; i < 8; ++i) {
    const auto at = [&](unsigned bit) { return (i & bit) != 0 ? half : -half; };
    const Vec3d a{at(1) * cy + at(4) * sy, at(2), at(4) * cy - at(1) * sy};
    corners.push_back({a.x + middle.x, a.y * cx - a.z * sx + middle.y, a.y * sx + a.z * cx + middle.z});
  }
  return corners;
}

// A hand's click in the photograph: on a whole pixel, half a pixel of tremble.
class Hand {
 public:
  Vec2d click(const Vec2d& at) {
    const double x = std::round(at.x + tremble_(random_));
    return {x, std::round(at.y + tremble_(random_))};
  }

 private:
  std::mt19937 random_{7};
  std::normal_distribution<double> tremble_{0, 0.5};
};

// Two clicks as a match of the rectified pair.
pipeline::Match match_of(const pipeline::RectifiedPair& pair, const pipeline::StereoCalibration& c,
                         const Vec2d& left, const Vec2d& right) {
  const auto rectified = [&pair](const pipeline::Rotation& turn, const Vec2d& ray, const Vec2d& centre) {
    const Vec3d p = pipeline::apply(turn, {ray.x, ray.y, 1});
    return Vec2d{pair.focal_px * p.x / p.z + centre.x, pair.focal_px * p.y / p.z + centre.y};
  };
  const Vec2d l =
      rectified(pair.rectified_from_left, pipeline::ray_of_pixel(c.left, left), pair.left_centre_px);
  const Vec2d r =
      rectified(pair.rectified_from_right, pipeline::ray_of_pixel(c.right, right), pair.right_centre_px);
  return {.left_px = {float(l.x), float(l.y)}, .disparity_px = float(l.x - r.x), .sigma_px = 0.5F};
}

// The cloud holds every hand's corners, one hand after the other; the table is the first hand's.
CubeTable table_of(const std::vector<Vec3d>& truth, const pipeline::PointCloud& cloud) {
  const auto units = [](const Vec3d& p) { return Vec3d{p.x / kUnitMm, p.y / kUnitMm, p.z / kUnitMm}; };
  CubeTable table;
  double squares = 0;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const pipeline::Vec3f& at = cloud.points[i].at_mm;
    CubeTable::Corner corner{units(truth[i % truth.size()]), units({at.x, at.y, at.z})};
    corner.off_units = length(minus(corner.found, corner.truth));
    squares += corner.off_units * corner.off_units;
    if (i >= truth.size()) continue;
    table.worst_units = std::max(table.worst_units, corner.off_units);
    table.corners.push_back(corner);
  }
  table.rms_units = std::sqrt(squares / double(cloud.points.size()));
  for (std::size_t i = 0; i < truth.size(); ++i)
    for (const std::size_t bit : {1U, 2U, 4U})
      if ((i & bit) == 0)
        table.side_units += length(minus(table.corners[i].found, table.corners[i | bit].found)) / 12;
  return table;
}

Result<void> go_on(const JobControl& control) {
  if (control.cancelled.load()) return Error{Errc::Cancelled, "cancelled: nothing was written"};
  return {};
}

Result<Comparison> compared(const ComparedPair& pair, std::vector<NamedSet> sets, const RunOptions& options,
                            JobControl& control) {
  std::atomic<std::size_t> at{0};
  return compare_sets({pair}, std::move(sets), options, at, control);
}

// Tables 1 and 2: a virtual rig of 20 units' baseline is calibrated from photographed boards; then the
// corners of a cube are matched by hand and triangulated by linear least squares.
struct VirtualRig {
  pipeline::StereoCalibration truth, found;
  double pair_rms_px = 0;
};

// Pictures and calibrations lie in `folder` afterwards.
Result<VirtualRig> calibrate_virtual_rig(const Simulate& simulate, const Path& folder) {
  SimulateArgs args;
  args.board = true;
  args.printed = {.corners_across = 10, .corners_down = 7, .square_mm = 20};
  args.pairs = kBoards;
  args.rig = IdealRigArgs{.width_px = 640,
                          .height_px = 480,
                          .focal_px = 771,
                          .baseline_mm = recorded::kBaselineUnits * kUnitMm,
                          .convergence_mm = recorded::kDistanceUnits * kUnitMm};
  RELIEVO_TRY(simulate(args, folder));
  VirtualRig rig;
  RELIEVO_TRY_ASSIGN(rig.truth, pipeline::read_calibration(folder / "rig.yml"));
  const Tell nobody = [](const std::string&) { return Result<void>(); };
  RELIEVO_TRY_ASSIGN(const auto made, run_calibrate({.pictures = folder,
                                                     .board = args.printed,
                                                     .output = folder / "calibrated.yml",
                                                     .report = {},
                                                     .store = {}},
                                                    nobody));
  rig.found = made.calibration;
  rig.pair_rms_px = made.quality.pair_rms_px;
  return rig;
}

Result<CubeTable> cube_table(const VirtualRig& rig, pipeline::StageContext& context) {
  const std::vector<std::byte> blank(std::size_t(rig.found.left.width_px) *
                                     std::size_t(rig.found.left.height_px));
  const ImageView view{blank.data(), rig.found.left.width_px, rig.found.left.height_px,
                       rig.found.left.width_px, PixelFormat::Grey8};
  const pipeline::RectifierOptions volume{.near_mm = 400, .far_mm = 950};
  RELIEVO_TRY_ASSIGN(const pipeline::RectifiedPair pair,
                     volume.rectify({view, view, 0, 0}, rig.found, context));
  const Vec3d right_camera = pipeline::inverse(rig.truth.right_from_left).translation_mm;
  const std::vector<Vec3d> corners = cube_corners(
      {right_camera.x / 2, right_camera.y / 2, right_camera.z / 2 + recorded::kDistanceUnits * kUnitMm});
  pipeline::MatchSet matches(&context.output);
  Hand hand;
  for (std::size_t i = 0; i < kHands * corners.size(); ++i) {
    const Vec3d& corner = corners[i % corners.size()];
    const Vec2d left = hand.click(seen(rig.truth.left, corner));
    const Vec2d right = hand.click(seen(rig.truth.right, pipeline::apply(rig.truth.right_from_left, corner)));
    matches.matches.push_back(match_of(pair, rig.found, left, right));
  }
  pipeline::AlgorithmSet set;
  RELIEVO_TRY(set.set("triangulator", "linear-least-squares"));
  RELIEVO_TRY_ASSIGN(const auto algorithms, pipeline::make_algorithms(set));
  RELIEVO_TRY_ASSIGN(const pipeline::PointCloud cloud, algorithms.triangulator(pair, matches, context));
  if (cloud.points.size() != kHands * corners.size())
    return Error{Errc::TooFewMatches,
                 "a corner of the cube lies beyond what the virtual rig sees: a fault of this program"};
  return table_of(corners, cloud);
}

Result<void> make_tables(const DissertationOrder& order, const Simulate& simulate, JobControl& control,
                         Dissertation& made) {
  RELIEVO_TRY_ASSIGN(const VirtualRig rig, calibrate_virtual_rig(simulate, order.work / "virtual rig"));
  made.rig = {.baseline_units = length(rig.found.right_from_left.translation_mm) / kUnitMm,
              .true_focal_px = rig.truth.left.focal_px.x,
              .focal_px = {rig.found.left.focal_px.x, rig.found.right.focal_px.x},
              .pair_rms_px = rig.pair_rms_px};
  BootMemory memory(0, std::size_t{64} << 20, std::size_t{32} << 20);
  Arena output(memory.output());
  Arena scratch(memory.scratch());
  ThreadPool pool(pool_size());
  pipeline::StageContext context{output, scratch, pool, control.progress, control.cancelled};
  RELIEVO_TRY_ASSIGN(made.cube, cube_table(rig, context));
  return {};
}

Result<ComparedPair> simulated_person(const DissertationOrder& order, const Simulate& simulate,
                                      JobControl& control) {
  const Path folder = order.work / "simulated person";
  SimulateArgs args;
  args.truth = true;
  RELIEVO_TRY(simulate(args, folder));
  RELIEVO_TRY(go_on(control));
  CompareArgs read;
  read.pictures = {folder / "left.png", folder / "right.png"};
  read.calibrations = {folder / "rig.yml"};
  read.truths = {folder};
  RELIEVO_TRY_ASSIGN(auto pairs, read_pairs(read));
  return std::move(pairs.front());
}

}  // namespace

Result<Dissertation> do_again(const DissertationOrder& order, const Simulate& simulate,
                              std::atomic<const char*>& at, JobControl& control) {
  Dissertation made;
  RELIEVO_TRY(make_tables(order, simulate, control, made));
  RELIEVO_TRY(go_on(control));
  std::optional<ComparedPair> person;
  if (!order.pair || !order.pair->calibration) {
    at = "simulated person";
    RELIEVO_TRY_ASSIGN(person, simulated_person(order, simulate, control));
  }
  at = "figures 6 to 12";
  RELIEVO_TRY_ASSIGN(made.rules, compared(order.pair ? *order.pair : *person, order.rule_sets,
                                          {order.whole_view, order.limit_px, false}, control));
  // Of what was never rectified there is nothing to draw.
  if (made.rules.pairs.front().width_px == 0)
    return invalid("so no set could be tried on this pair: choose another")
        .at(made.rules.runs.front().failure);
  at = "figure 17";
  RELIEVO_TRY_ASSIGN(made.face, compared(person ? *person : *order.pair, order.face_sets,
                                         {!person && order.whole_view, order.limit_px}, control));
  return made;
}

}  // namespace relievo::firmware::compare
