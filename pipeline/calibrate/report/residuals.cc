// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "hal/base/statistics.h"
#include "pipeline/calibrate/board/board_finder.h"
#include "pipeline/calibrate/quality/rig_geometry.h"
#include "pipeline/calibrate/report/sections.h"
#include "pipeline/model/vector3.h"
#include "pipeline/report/drawing.h"
#include "pipeline/report/page.h"

namespace relievo::pipeline::report {
namespace {

constexpr Size kSize{480, 462};
constexpr double kFieldMm = 160;  // of DepthUncertainty
constexpr double kNear = kFirstDepthMm;
constexpr double kFar = kFirstDepthMm + (kDepthSteps - 1) * kDepthStepMm;

// Seen from above, down the left camera's y or, where pictures lie on their sides, along its x: x to the
// right along the baseline, y (of the page) towards the rig.
class Plan {
 public:
  explicit Plan(const StereoCalibration& c, double farthest_mm)
      : right_(inverse(c.right_from_left).translation_mm) {
    if (std::abs(right_.y) > std::hypot(right_.x, right_.z)) aside_ = {0, std::copysign(1.0, right_.y), 0};
    const double across = dot(right_, aside_), length = std::max(std::hypot(across, right_.z), 1e-9);
    along_ = {across / length, right_.z / length};
    constexpr double kBehind = 110;
    scale_ = (kSize.height - 8) / (farthest_mm + kBehind);
    origin_ = {0.5 * kSize.width - 0.5 * length * scale_, kSize.height - 4 - kBehind * scale_};
  }
  Vec2d operator()(const Vec3d& p) const {
    const double across = dot(p, aside_);
    return {origin_.x + scale_ * (across * along_.x + p.z * along_.y),
            origin_.y - scale_ * (p.z * along_.x - across * along_.y)};
  }
  // So far to the side of a camera's axis and before it, in the plane of the plan.
  Vec3d place(double aside_mm, double before_mm) const {
    return {aside_mm * aside_.x, aside_mm * aside_.y, before_mm};
  }
  bool lies() const { return aside_.x == 0; }
  double scale() const { return scale_; }
  const Vec3d& right_camera() const { return right_; }

 private:
  Vec3d right_;
  Vec3d aside_{1, 0, 0};  // of a camera's axes
  Vec2d along_;
  Vec2d origin_;
  double scale_ = 1;
};

struct Camera {
  const CameraIntrinsics& lens;
  RigidTransform left_from_camera;

  // On a rim of the picture in the plane of the plan, at a distance along the camera's axis.
  Vec3d rim(const Plan& plan, bool far, double distance_mm) const {
    const Vec2d at = plan.lies() ? Vec2d{lens.centre_px.x, (far ? lens.height_px : 0) - 0.5}
                                 : Vec2d{(far ? lens.width_px : 0) - 0.5, lens.centre_px.y};
    const Eigen::Vector3d ray = ray_of(lens, at);
    return apply(left_from_camera, {ray.x() * distance_mm, ray.y() * distance_mm, distance_mm});
  }
};

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

// Over everything else, where boards may lie.
void draw_measures(Drawing& d, const Plan& plan, double baseline_mm) {
  for (const double mm : {kNear, kFar}) {
    const Vec2d at = plan(plan.place(kFieldMm / 2, mm));
    d.text("tick begin halo", {at.x + 6, at.y + 4.5}, figure(mm, 0) + " mm");
  }
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

constexpr double kKey = 34;
constexpr double kUsualLength = 0.045;  // of the picture's width: what all but the longest arrows stay below

template <typename Use>
void for_each_used(const CalibrationReport& r, std::size_t eye, const Use& use) {
  for (std::size_t v = 0; v < r.output.views.size(); ++v)
    if (r.output.quality.views[v].used)
      for (const CornerResidual& corner : r.output.views[v].corners(eye))
        if (seen(corner.at)) use(corner);
}

void arrow(Strokes& strokes, Vec2d base, Vec2d by) {
  const Vec2d tip{base.x + by.x, base.y + by.y};
  constexpr double kBack = 0.32;
  constexpr double kAside = 0.16;
  strokes.from(base).to(tip);
  strokes.from({tip.x - kBack * by.x - kAside * by.y, tip.y - kBack * by.y + kAside * by.x}).to(tip);
  strokes.to({tip.x - kBack * by.x + kAside * by.y, tip.y - kBack * by.y - kAside * by.x});
}

std::string camera_figure(const CalibrationReport& r, std::size_t eye, double magnified, double usual) {
  const CameraIntrinsics& camera = camera_of(r, eye);
  const double scale = kFigureWidth / camera.width_px;
  const double height = scale * camera.height_px;
  Drawing d({kFigureWidth, height + kKey}, "Residuals as arrows, in the frame of the picture");
  const std::size_t stride = corner_stride(r);
  Strokes arrows;
  std::size_t count = 0;
  for_each_used(r, eye, [&](const CornerResidual& c) {
    if (count++ % stride != 0) return;
    arrow(arrows, {(c.at.x + 0.5) * scale, (c.at.y + 0.5) * scale},
          {c.off.x * scale * magnified, c.off.y * scale * magnified});
  });
  const std::string style = "arrows " + std::string(kCameraStyles[eye]);
  d.strokes(style, arrows);
  d.box("frame", {{0.5, 0.5}, {kFigureWidth - 1, height - 1}});
  const double shown = rounded_down(usual);
  Strokes key;
  arrow(key, {1, height + 20}, {shown * scale * magnified, 0});
  d.strokes(style, key);
  d.text("tick begin", {10 + shown * scale * magnified, height + 24.5},
         figure(shown, tick_decimals(shown)) + " px");
  return figure_of(d.svg(), kCameraNames[eye], counted(int(count), "corner.", "corners."));
}

constexpr Size kHistogramSize{480, 190};
constexpr Box kHistogramPlot{{4, 10}, {472, 136}};
constexpr int kBins = 41;
constexpr double kReach = 4;  // standard deviations

// Both coordinates of every corner of the pairs used.
std::vector<double> coordinates(const CalibrationReport& r, std::size_t eye) {
  std::vector<double> all;
  for_each_used(r, eye, [&](const CornerResidual& c) { all.insert(all.end(), {c.off.x, c.off.y}); });
  return all;
}

double deviation(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / std::max<double>(1, double(values.size())));
}

void ticks(Drawing& d, const Axis& x) {
  d.line("axis", {kHistogramPlot.corner.x, kHistogramPlot.bottom()},
         {kHistogramPlot.right(), kHistogramPlot.bottom()});
  const double step = tick_step(x.high - x.low, 9);
  const int last = int(x.high / step);
  for (int i = -last; i <= last; ++i) {
    d.line("axis", {x(i * step), kHistogramPlot.bottom()}, {x(i * step), kHistogramPlot.bottom() + 5});
    d.text("tick middle", {x(i * step), kHistogramPlot.bottom() + 20}, figure(i * step, tick_decimals(step)));
  }
  d.text("label middle",
         {0.5 * (kHistogramPlot.corner.x + kHistogramPlot.right()), kHistogramSize.height - 6},
         "residual of one coordinate, px");
}

std::string camera_figure(const CalibrationReport& r, std::size_t eye, double reach) {
  const std::vector<double> values = coordinates(r, eye);
  const double sigma = std::max(deviation(values), 1e-12);
  std::array<int, kBins> bins{};
  int beyond = 0;
  for (const double value : values) {
    const double bin = std::floor((value / reach + 1) / 2 * kBins);
    if (bin < 0 || bin >= kBins) ++beyond;
    else ++bins[std::size_t(bin)];
  }
  // What a normal distribution of the same size would put into the bin around `value`.
  const double width = 2 * reach / kBins;
  const auto normal = [&](double value) {
    constexpr double kRoot = 2.5066282746310002;
    return double(values.size()) * width / (kRoot * sigma) * std::exp(-0.5 * value * value / (sigma * sigma));
  };
  const double top = std::max<double>(*std::ranges::max_element(bins), normal(0)) * 1.04;
  const Axis x{-reach, reach, kHistogramPlot.corner.x, kHistogramPlot.right()};
  const Axis y{0, std::max(top, 1.0), kHistogramPlot.bottom(), kHistogramPlot.corner.y};
  Drawing d(kHistogramSize,
            std::string(kCameraNames[eye]) + ": histogram of the residuals with a normal distribution");
  const std::string style(kCameraStyles[eye]);
  for (int i = 0; i < kBins; ++i) {
    const double left = x(-reach + i * width);
    const double count = bins[std::size_t(i)];
    if (count > 0)
      d.box("bar " + style,
            {{left + 0.5, y(count)}, {x(-reach + (i + 1) * width) - left - 1, y(0) - y(count)}});
  }
  Strokes curve;
  constexpr int kPoints = 120;
  for (int i = 0; i <= kPoints; ++i) {
    const double value = -reach + 2 * reach * i / kPoints;
    const Vec2d at{x(value), y(normal(value))};
    i == 0 ? curve.from(at) : curve.to(at);
  }
  d.strokes("curve", curve);
  ticks(d, x);
  std::string caption = "Standard deviation " + figure(sigma, 3) + " px a coordinate";
  if (beyond > 0) caption += "; " + counted(beyond, "lies", "lie") + " beyond the ends";
  return figure_of(d.svg(), "", caption + ".");
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
  for (const std::size_t eye : {0U, 1U}) {
    const Camera& camera = cameras[eye];
    Strokes field;
    field.outline(std::array<Vec2d, 3>{plan(camera.left_from_camera.translation_mm),
                                       plan(camera.rim(plan, false, 2 * farthest)),
                                       plan(camera.rim(plan, true, 2 * farthest))});
    d.strokes("field " + std::string(kCameraStyles[eye]), field);
  }
  constexpr double kHalf = kFieldMm / 2;  // where faces are
  Strokes volume;
  volume.outline(std::array<Vec2d, 4>{plan(plan.place(-kHalf, kNear)), plan(plan.place(kHalf, kNear)),
                                      plan(plan.place(kHalf, kFar)), plan(plan.place(-kHalf, kFar))});
  d.strokes("volume", volume);
  draw_boards(d, plan, r);
  draw_measures(d, plan, r.output.quality.baseline_mm);
  for (const std::size_t eye : {0U, 1U}) {
    const auto at = [&](double x, double z) {
      return plan(apply(cameras[eye].left_from_camera, plan.place(x, z)));
    };
    Strokes body;
    body.outline(std::array<Vec2d, 4>{at(-16, -6), at(16, -6), at(16, -44), at(-16, -44)});
    body.outline(std::array<Vec2d, 4>{at(-9, 0), at(9, 0), at(9, -6), at(-9, -6)});
    d.strokes("camera " + std::string(kCameraStyles[eye]), body);
  }
  return figure_of(
      d.svg(), "The rig from above",
      "To scale. The cameras with their fields of view; the boards of the pairs used and, in grey, of those left out; "
      "dashed, the volume that the depth uncertainty is worked out for.");
}

std::string residual_arrows(const CalibrationReport& r) {
  std::vector<double> lengths;
  for (const std::size_t eye : {0U, 1U})
    for_each_used(r, eye, [&](const CornerResidual& c) { lengths.push_back(std::hypot(c.off.x, c.off.y)); });
  // Below it 95 % of all residuals stay, px.
  const double usual = lengths.empty() ? 1 : std::max(percentile(lengths, 0.95), 1e-9);
  const double magnified = rounded_down(kUsualLength * r.output.calibration.left.width_px / usual);
  const double reach = kReach * std::max({deviation(coordinates(r, 0)), deviation(coordinates(r, 1)), 1e-9});
  const std::string lead =
      "At every corner of the pairs used, an arrow from where the fit puts it towards where it was seen, " +
      number(magnified, 3) +
      " times as long as it is. They must point everywhere at random: a common "
      "direction in one place is a lens, or a board, that the fit does not describe.";
  return "<section>\n<h2>What is left over</h2>\n<p class=\"lead\">" + lead + "</p>\n" +
         side_by_side(camera_figure(r, 0, magnified, usual), camera_figure(r, 1, magnified, usual)) +
         side_by_side(camera_figure(r, 0, reach), camera_figure(r, 1, reach)) + "</section>\n";
}

}  // namespace relievo::pipeline::report
