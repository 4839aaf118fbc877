// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>

#include "pipeline/calibrate/quality/rig_geometry.h"
#include "pipeline/calibrate/report/sections.h"
#include "pipeline/report/drawing.h"
#include "pipeline/report/text.h"

namespace relievo::pipeline::report {
namespace {

constexpr Size kSize{480, 462};
constexpr double kFieldMm = 160;  // of DepthUncertainty
constexpr double kNear = kFirstDepthMm;
constexpr double kFar = kFirstDepthMm + (kDepthSteps - 1) * kDepthStepMm;

// Seen from above, down the left camera's y: x to the right along the baseline, y (of the page) towards the
// rig.
class Plan {
 public:
  explicit Plan(const StereoCalibration& c, double farthest_mm) {
    const RigidTransform left_from_right = inverse(c.right_from_left);
    right_ = left_from_right.translation_mm;
    const double length = std::max(std::hypot(right_.x, right_.z), 1e-9);
    along_ = {right_.x / length, right_.z / length};
    constexpr double kBehind = 110;
    scale_ = (kSize.height - 8) / (farthest_mm + kBehind);
    origin_ = {0.5 * kSize.width - 0.5 * length * scale_, kSize.height - 4 - kBehind * scale_};
  }
  Vec2d operator()(const Vec3d& p) const {
    return {origin_.x + scale_ * (p.x * along_.x + p.z * along_.y),
            origin_.y - scale_ * (p.z * along_.x - p.x * along_.y)};
  }
  double scale() const { return scale_; }
  const Vec3d& right_camera() const { return right_; }

 private:
  Vec3d right_;
  Vec2d along_;
  Vec2d origin_;
  double scale_ = 1;
};

struct Camera {
  const CameraIntrinsics& lens;
  RigidTransform left_from_camera;

  // On the middle row, `column` pixels from the left rim, at a distance along the camera's axis.
  Vec3d at(double column, double distance_mm) const {
    const Eigen::Vector3d ray = ray_of(lens, {column - 0.5, lens.centre_px.y});
    return apply(left_from_camera, {ray.x() * distance_mm, ray.y() * distance_mm, distance_mm});
  }
};

void draw_field(Drawing& d, const Plan& plan, const Camera& camera, std::string_view style, double reach_mm) {
  const std::array<Vec2d, 3> wedge = {plan(camera.at(0, 0)), plan(camera.at(0, reach_mm)),
                                      plan(camera.at(camera.lens.width_px, reach_mm))};
  Strokes field;
  field.outline(wedge);
  d.strokes("field " + std::string(style), field);
}

void draw_camera(Drawing& d, const Plan& plan, const Camera& camera, std::string_view style) {
  const auto at = [&](double x, double z) { return plan(apply(camera.left_from_camera, {x, 0, z})); };
  Strokes body;
  body.outline(std::array<Vec2d, 4>{at(-16, -6), at(16, -6), at(16, -44), at(-16, -44)});
  body.outline(std::array<Vec2d, 4>{at(-9, 0), at(9, 0), at(9, -6), at(-9, -6)});
  d.strokes("camera " + std::string(style), body);
}

void draw_boards(Drawing& d, const Plan& plan, const CalibrationReport& r) {
  const BoardPattern& board = r.input.pattern;
  const double s = board.square_mm;
  for (std::size_t v = 0; v < r.output.views.size(); ++v) {
    const FittedView& view = r.output.views[v];
    if (!view.placed) continue;
    const auto at = [&](double x, double y) { return plan(apply(view.left_from_board, {x, y, 0})); };
    Strokes outline;
    outline.outline(std::array<Vec2d, 4>{at(-s, -s), at(board.columns * s, -s),
                                         at(board.columns * s, board.rows * s), at(-s, board.rows * s)});
    d.strokes(r.output.quality.views[v].used ? "board used" : "board other", outline);
  }
}

void draw_faces(Drawing& d, const Plan& plan) {
  constexpr double kHalf = kFieldMm / 2;
  Strokes volume;
  volume.outline(std::array<Vec2d, 4>{plan({-kHalf, 0, kNear}), plan({kHalf, 0, kNear}),
                                      plan({kHalf, 0, kFar}), plan({-kHalf, 0, kFar})});
  d.strokes("volume", volume);
}

// Over everything else, where boards may lie.
void name_faces(Drawing& d, const Plan& plan) {
  for (const double mm : {kNear, kFar}) {
    const Vec2d at = plan({kFieldMm / 2, 0, mm});
    d.text("tick begin halo", {at.x + 6, at.y + 4.5}, figure(mm, 0) + " mm");
  }
}

void draw_measures(Drawing& d, const Plan& plan, double baseline_mm) {
  const Vec2d a = plan({0, 0, 0});
  const Vec2d b = plan(plan.right_camera());
  d.line("measure", a, b);
  d.text("tick middle", {0.5 * (a.x + b.x), std::max(a.y, b.y) + 44 * plan.scale() + 24},
         figure(baseline_mm, 1) + " mm");
  d.text("tick end", {a.x - 20, a.y + 16}, "left");
  d.text("tick begin", {b.x + 20, b.y + 16}, "right");
  const double length = 100 * plan.scale();
  const double y = kSize.height - 14;
  d.line("ruler", {8, y}, {8 + length, y});
  d.line("ruler", {8, y - 4}, {8, y + 4});
  d.line("ruler", {8 + length, y - 4}, {8 + length, y + 4});
  d.text("tick begin", {14 + length, y + 4.5}, "100 mm");
}

}  // namespace

std::string rig_plan(const CalibrationReport& r) {
  const StereoCalibration& c = r.output.calibration;
  double farthest = kFar + 60;
  for (const ViewQuality& view : r.output.quality.views)
    if (view.used) farthest = std::max(farthest, view.distance_mm + 80);
  const Plan plan(c, farthest);
  const std::array<Camera, 2> cameras = {Camera{c.left, {}}, Camera{c.right, inverse(c.right_from_left)}};
  Drawing d(kSize, "The rig from above, to scale: cameras, their fields of view, and the boards");
  for (const std::size_t eye : {0U, 1U}) draw_field(d, plan, cameras[eye], kCameraStyles[eye], 2 * farthest);
  draw_faces(d, plan);
  draw_boards(d, plan, r);
  name_faces(d, plan);
  draw_measures(d, plan, r.output.quality.baseline_mm);
  for (const std::size_t eye : {0U, 1U}) draw_camera(d, plan, cameras[eye], kCameraStyles[eye]);
  return figure_of(
      d.svg(), "The rig from above",
      "To scale. The cameras with their fields of view; the boards of the pairs used and, in grey, of those left out; "
      "dashed, the volume that the depth uncertainty is worked out for.");
}

}  // namespace relievo::pipeline::report
