// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/checks/optical_check.h"

#include <cmath>
#include <numbers>

#include "firmware/base/boot_memory.h"
#include "firmware/checks/deviation_picture.h"
#include "hal/base/words.h"
#include "pipeline/calibrate/board/board_finder.h"
#include "pipeline/model/vector3.h"
#include "pipeline/pipeline.h"
#include "pipeline/reconstruct/best_fit.h"

namespace relievo::firmware {
namespace {

using pipeline::Vec3d;

// How far around a target a surface is looked for: its edge must not be the region's.
constexpr double kMarginMm = 4;

const char* const kNothing = "nothing was measured";

AcceptanceLine worst_of(std::string measure, double limit_mm) {
  return {std::move(measure), kNothing, std::nan(""), limit_mm};
}

// What is no number is worse than any.
void keep_worse(AcceptanceLine& line, const std::string& where, double value_mm) {
  const bool first = line.where == kNothing;
  if (!first && (std::isnan(line.value_mm) || std::abs(value_mm) <= std::abs(line.value_mm))) return;
  line.where = where;
  line.value_mm = value_mm;
}

Error at_target(const Error& error, const std::string& name) {
  return error.code == Errc::Cancelled ? error : error.at(name);
}

Result<pipeline::Pipeline> stages_for_targets(const pipeline::StereoCalibration& calibration) {
  pipeline::AlgorithmSet set;
  RELIEVO_TRY(set.set("preprocessor", "none"));      // a target is no skin
  RELIEVO_TRY(set.set("grid.min_area_mm2", "300"));  // a sphere of 20 mm, seen within 60 degrees
  return pipeline::Pipeline::make(set, calibration, {}, pipeline::Region::All);
}

// TargetMeter: measures a target as the product measures a face: rectify, match, triangulate, reject
// outliers, mesh, with the default algorithms. Only what knows of faces stays out: no face is looked
// for (a ball around the target is the region instead, so nothing is cropped), the mesher accepts less
// surface than a face has, and the texture stage with its head frame is not run.
// Left camera's frame, millimetres.
// Memory: 0.9 GiB of address space, touched as far as the pictures need; one pool of threads.
// Errors: the stages' own; PoorGeometry (nothing, or too little, measured there); each names the target.
class TargetMeter {
 public:
  TargetMeter(pipeline::Pipeline stages, const OpticalCheckOptions& options,
              const std::atomic<bool>& cancelled)
      : context_{output_, scratch_, pool_, progress_, cancelled},
        pipeline_(std::move(stages)),
        targets_(options.targets),
        limits_(limits_at(options.scale)),
        show_(options.show) {}

  // Rectifies the pair; it is borrowed until the next one is taken.
  Result<void> take(const TargetPictures& pictures) {
    pair_.reset();
    output_.reset();
    RELIEVO_TRY_ASSIGN(pair_, pipeline_.rectify({pictures.left.view(), pictures.right.view()}, context_));
    return {};
  }
  // Of the pair taken, a target that stands there: into the report.
  Result<void> measure_dumbbell(const TargetPlace& place, const std::string& name);
  Result<void> measure_plate(const TargetPlace& place, const std::string& name);
  AcceptanceReport report;

 private:
  struct Circle {
    double x_px = 0, y_px = 0, radius_px = 0;
  };
  Circle circle_around(const Vec3d& centre_mm, double reach_mm) const {
    const Vec3d c = apply(pair_->rectified_from_left, centre_mm);
    const double scale = pair_->focal_px / c.z;
    return {scale * c.x + pair_->left_centre_px.x, scale * c.y + pair_->left_centre_px.y, scale * reach_mm};
  }
  // The measured vertices of the mesh (never the bridged ones) within `reach_mm` of `centre_mm` as the
  // left rectified view shows it.
  Result<std::vector<Vec3d>> surface_around(const Vec3d& centre_mm, double reach_mm);
  template <typename Form>
  Result<void> show(const std::string& name, const Form& form, const std::vector<Vec3d>& points_mm,
                    const Vec3d& centre_mm, double reach_mm, double limit_mm) const;
  Result<Vec3d> measure_sphere(const Vec3d& centre_mm, const Vec3d& rod, const std::string& name);

  BootMemory memory_{0, budget::kLargestPlan.products, budget::kLargestPlan.scratch};
  Arena output_{memory_.output()}, scratch_{memory_.scratch()};
  ThreadPool pool_{pool_size()};
  pipeline::Progress progress_;
  pipeline::StageContext context_;
  pipeline::Pipeline pipeline_;
  const OpticalTargets& targets_;
  AcceptanceLimits limits_;
  const ShowTarget& show_;
  std::optional<pipeline::RectifiedPair> pair_;
};

// What of the surface the certificate covers. `rod` points along the rod, unit length.
std::vector<Vec3d> cap_of(const std::vector<Vec3d>& surface, const Vec3d& centre_mm, const Vec3d& rod) {
  const double least = std::cos(kCapDeg * std::numbers::pi / 180);
  std::vector<Vec3d> cap;
  for (const Vec3d& p : surface) {
    const Vec3d out = minus(p, centre_mm);
    const bool faces = -dot(out, p) > least * length(out) * length(p);
    const bool at_rod = dot(out, rod) > 0 && length(cross(out, rod)) < kRodMm;
    if (faces && !at_rod) cap.push_back(p);
  }
  return cap;
}

Result<std::vector<Vec3d>> TargetMeter::surface_around(const Vec3d& centre_mm, double reach_mm) {
  pipeline::RectifiedPair& pair = *pair_;
  const Circle circle = circle_around(centre_mm, reach_mm);
  const auto width = std::size_t(pair.width_px);
  pair.region.resize(width * std::size_t(pair.height_px));
  for (int y = 0; y < pair.height_px; ++y)
    for (int x = 0; x < pair.width_px; ++x)
      pair.region[std::size_t(y) * width + std::size_t(x)] =
          std::hypot(x - circle.x_px, y - circle.y_px) < circle.radius_px ? 1 : 0;
  const Arena::Mark mark(output_);  // the pair stays for the target's other parts
  RELIEVO_TRY_ASSIGN(const auto matches, pipeline_.match(pair, context_));
  RELIEVO_TRY_ASSIGN(const auto cloud, pipeline_.reconstruct(pair, matches, context_));
  RELIEVO_TRY_ASSIGN(const auto mesh, pipeline_.mesh(cloud, pair, context_));
  std::vector<Vec3d> points;
  for (std::size_t i = 0; i < mesh.vertices_mm.size(); ++i)
    if (mesh.measured[i] != 0) points.push_back(wide(mesh.vertices_mm[i]));
  return points;
}

// The rectified left view around the target, beside it the same with every point coloured by its deviation:
// blue below, white 0, red above, and the scale below.
template <typename Form>
Result<void> TargetMeter::show(const std::string& name, const Form& form, const std::vector<Vec3d>& points_mm,
                               const Vec3d& centre_mm, double reach_mm, double limit_mm) const {
  if (!show_) return {};
  const pipeline::RectifiedPair& pair = *pair_;
  const Circle circle = circle_around(centre_mm, reach_mm);
  DeviationPicture picture(pair.left.rgb, pair.width_px, pair.height_px,
                           {int(circle.x_px - circle.radius_px), int(circle.y_px - circle.radius_px),
                            int(circle.x_px + circle.radius_px), int(circle.y_px + circle.radius_px)});
  // A quarter of what is allowed fills the colours: a good reading then still shows its pattern.
  const double range_mm = limit_mm / 4;
  for (const Vec3d& point : points_mm) {
    const Vec3d p = apply(pair.rectified_from_left, point);
    picture.mark(pair.focal_px * p.x / p.z + pair.left_centre_px.x,
                 pair.focal_px * p.y / p.z + pair.left_centre_px.y, deviation(form, point) / range_mm);
  }
  return show_(name, picture.finish());
}

// Where its centre is.
Result<Vec3d> TargetMeter::measure_sphere(const Vec3d& centre_mm, const Vec3d& rod, const std::string& name) {
  const double reach_mm = targets_.sphere_diameter_mm / 2 + kMarginMm;
  auto surface = surface_around(centre_mm, reach_mm);
  if (!surface) return at_target(surface.error(), name);
  const std::vector<Vec3d> cap = cap_of(*surface, centre_mm, rod);
  const auto read = pipeline::best_fit::read_sphere(cap, kDiscardShare);
  if (!read) return at_target(read.error(), name);
  const double size_mm = 2 * read->form.radius_mm - targets_.sphere_diameter_mm;
  report.targets.push_back({name, TargetKind::Dumbbell, surface->size(), read->used, read->discarded,
                            read->range_mm, read->rms_mm, size_mm, read->form.centre_mm});
  RELIEVO_TRY(show(name, read->form, cap, centre_mm, reach_mm, limits_.form_mm));
  return read->form.centre_mm;
}

Result<void> TargetMeter::measure_dumbbell(const TargetPlace& place, const std::string& name) {
  const Vec3d along = minus(left_from_target(place, {1, 0, 0}), left_from_target(place, {0, 0, 0}));
  const double half_mm = targets_.sphere_spacing_mm / 2;
  RELIEVO_TRY_ASSIGN(const Vec3d a,
                     measure_sphere(left_from_target(place, {-half_mm, 0, 0}), along, name + " a"));
  RELIEVO_TRY_ASSIGN(const Vec3d b,
                     measure_sphere(left_from_target(place, {half_mm, 0, 0}), times(along, -1), name + " b"));
  report.spacings.push_back({name, distance(a, b) - targets_.sphere_spacing_mm});
  return {};
}

Result<void> TargetMeter::measure_plate(const TargetPlace& place, const std::string& name) {
  const Vec3d middle = left_from_target(place, {0, 0, 0});
  const Vec3d x = minus(left_from_target(place, {1, 0, 0}), middle),
              y = minus(left_from_target(place, {0, 1, 0}), middle);
  const double half_width = targets_.plate_width_mm / 2, half_height = targets_.plate_height_mm / 2;
  const double reach_mm = std::hypot(half_width, half_height) + kMarginMm;
  auto surface = surface_around(middle, reach_mm);
  if (!surface) return at_target(surface.error(), name);
  std::vector<Vec3d> inside;
  for (const Vec3d& p : *surface) {
    const Vec3d from = minus(p, middle);
    if (std::abs(dot(from, x)) < half_width - kRimMm && std::abs(dot(from, y)) < half_height - kRimMm)
      inside.push_back(p);
  }
  const auto read = pipeline::best_fit::read_plane(inside, kDiscardShare);
  if (!read) return at_target(read.error(), name);
  report.targets.push_back({name,
                            TargetKind::Plate,
                            surface->size(),
                            read->used,
                            read->discarded,
                            read->range_mm,
                            read->rms_mm,
                            0,
                            {}});
  return show(name, read->form, inside, middle, reach_mm, limits_.flatness_mm);
}

TargetShot series_of(const OpticalCheckOptions& options) {
  return {.targets = options.targets, .seed = options.seed, .scale = options.scale};
}

}  // namespace

Vec3d left_from_target(const TargetPlace& place, const Vec3d& p) {
  constexpr double kRadians = std::numbers::pi / 180;
  const double a = place.pitch_deg * kRadians, b = place.yaw_deg * kRadians, c = place.roll_deg * kRadians;
  const Vec3d x{p.x, p.y * std::cos(a) - p.z * std::sin(a), p.y * std::sin(a) + p.z * std::cos(a)};
  const Vec3d y{x.x * std::cos(b) + x.z * std::sin(b), x.y, x.z * std::cos(b) - x.x * std::sin(b)};
  return {y.x * std::cos(c) - y.y * std::sin(c) + place.right_mm,
          y.x * std::sin(c) + y.y * std::cos(c) + place.down_mm, y.z + place.distance_mm};
}

Result<pipeline::CalibratorOutput> calibrate_on_boards(const Photograph& photograph, const TargetShot& series,
                                                       int boards, const std::atomic<bool>& cancelled,
                                                       const std::function<void()>& each) {
  pipeline::CalibratorInput input;
  input.pattern = {series.targets.board_columns, series.targets.board_rows, series.targets.square_mm};
  TargetShot shot = series;
  shot.kind = TargetKind::Board;
  shot.count = boards;
  for (shot.number = 0; shot.number < boards; ++shot.number) {
    if (cancelled.load()) return Error{Errc::Cancelled, "cancelled: nothing was written"};
    RELIEVO_TRY_ASSIGN(const TargetPictures pictures, photograph(shot));
    input.width_px = pictures.left.width_px;
    input.height_px = pictures.left.height_px;
    pipeline::BoardView& view = input.views.emplace_back();
    view.name = std::to_string(shot.number);
    RELIEVO_TRY_ASSIGN(view.left, pipeline::look_for_board(pictures.left.view(), input.pattern));
    RELIEVO_TRY_ASSIGN(view.right, pipeline::look_for_board(pictures.right.view(), input.pattern));
    each();
  }
  RELIEVO_TRY_ASSIGN(auto output, pipeline::calibrate(input));
  if (output.quality.verdict == pipeline::CalibrationVerdict::Refuse)
    return Error{Errc::PoorGeometry,
                 "the calibration on the boards is refused: there is nothing to measure targets with"};
  return output;
}

AcceptanceLimits limits_at(double scale) {
  const double coarser = 1 / scale;
  return {0.8 * coarser, 0.1 * coarser, 0.05 * coarser, 0.8 * coarser};
}

bool AcceptanceLine::held() const { return std::abs(value_mm) <= limit_mm; }

std::vector<AcceptanceLine> AcceptanceReport::lines(const AcceptanceLimits& limits) const {
  std::vector<AcceptanceLine> all{
      worst_of("probing error, form", limits.form_mm), worst_of("probing error, size", limits.size_mm),
      worst_of("sphere spacing", limits.spacing_mm), worst_of("flatness", limits.flatness_mm)};
  for (const TargetReading& target : targets) {
    if (target.kind == TargetKind::Plate) {
      keep_worse(all[3], target.name, target.range_mm);
    } else {
      keep_worse(all[0], target.name, target.range_mm);
      keep_worse(all[1], target.name, target.size_mm);
    }
  }
  for (const SpacingReading& spacing : spacings) keep_worse(all[2], spacing.name, spacing.error_mm);
  return all;
}

Result<void> AcceptanceReport::verdict(const AcceptanceLimits& limits) const {
  for (const AcceptanceLine& line : lines(limits))
    if (!line.held())
      return Error{Errc::PoorGeometry,
                   "over the limit: the chain does not measure as it should; look at the table and at the "
                   "pictures of -o"}
          .at(line.measure + ", " + line.where);
  return {};
}

// right, down, distance; pitch, yaw, roll.
std::vector<TargetPlace> dumbbell_places() {
  return {{0, 0, 560, 0, 0, 0},    {0, 0, 560, 0, 0, 90},   {-25, 0, 520, 0, 0, 45}, {25, 0, 620, 0, 0, -45},
          {0, -20, 560, 0, 30, 0}, {0, 20, 560, 0, -30, 0}, {15, 0, 590, 30, 0, 90}};
}

std::vector<TargetPlace> plate_places() {
  return {{0, 0, 560, 0, 0, 0},  {0, 0, 530, 0, 0, 0},   {0, 0, 650, 0, 0, 90},
          {0, 0, 570, 0, 30, 0}, {0, 0, 570, 0, -30, 0}, {0, 0, 580, 30, 0, 0}};
}

Result<AcceptanceReport> measure_targets(const pipeline::StereoCalibration& calibration,
                                         const Photograph& photograph, const OpticalCheckOptions& options,
                                         const std::atomic<bool>& cancelled,
                                         const std::function<void()>& each) {
  RELIEVO_TRY_ASSIGN(auto stages, stages_for_targets(calibration));
  TargetMeter meter(std::move(stages), options, cancelled);
  TargetShot shot = series_of(options);
  for (const bool plate : {false, true}) {
    shot.kind = plate ? TargetKind::Plate : TargetKind::Dumbbell;
    shot.number = 0;
    for (const TargetPlace& place : plate ? options.plates : options.dumbbells) {
      if (cancelled.load()) return Error{Errc::Cancelled, "cancelled: nothing was written"};
      shot.place = place;
      RELIEVO_TRY_ASSIGN(const TargetPictures pictures, photograph(shot));
      RELIEVO_TRY(meter.take(pictures));
      const std::string number = std::to_string(++shot.number);
      RELIEVO_TRY(plate ? meter.measure_plate(place, "plate " + number)
                        : meter.measure_dumbbell(place, "dumbbell " + number));
      each();
    }
  }
  return std::move(meter.report);
}

Result<OpticalCheck> check_optically(const Photograph& photograph, const OpticalCheckOptions& options,
                                     std::atomic<const char*>& at, JobControl& control) {
  at = "Calibrate";
  const auto shots = float(std::size_t(options.boards) + options.dumbbells.size() + options.plates.size());
  float done = 0;
  const auto each = [&] { control.progress.done.store(++done / shots); };
  OpticalCheck check;
  RELIEVO_TRY_ASSIGN(check.calibration, calibrate_on_boards(photograph, series_of(options), options.boards,
                                                            control.cancelled, each));
  at = "Measure";
  RELIEVO_TRY_ASSIGN(check.report, measure_targets(check.calibration.calibration, photograph, options,
                                                   control.cancelled, each));
  if (control.cancelled.load()) return Error{Errc::Cancelled, "cancelled: nothing was written"};
  return check;
}

std::vector<std::string> acceptance_table(const AcceptanceReport& report, const OpticalCheckOptions& options,
                                          const pipeline::CalibrationQuality& calibration) {
  std::vector<std::string> lines{
      printed("calibrated on %d of %zu boards, pair rms %.3f px, baseline %.2f mm", calibration.used,
              calibration.views.size(), calibration.pair_rms_px, calibration.baseline_mm),
      "target         points    used    out  form/flat   size    rms (mm; out: discarded)"};
  for (const TargetReading& t : report.targets) {
    const std::string size = t.kind == TargetKind::Dumbbell ? printed("%+.3f", t.size_mm) : "";
    lines.push_back(printed("%-13s %7zu %7zu %6zu %8.3f %8s %8.3f", t.name.c_str(), t.measured, t.used,
                            t.discarded, t.range_mm, size.c_str(), t.rms_mm));
  }
  for (const SpacingReading& s : report.spacings)
    lines.push_back(printed("%-13s spacing %+.3f mm", s.name.c_str(), s.error_mm));
  for (const AcceptanceLine& line : report.lines(limits_at(options.scale)))
    lines.push_back(printed("%-20s %+.3f mm, limit %.3f mm: %s (%s)", line.measure.c_str(), line.value_mm,
                            line.limit_mm, line.held() ? "pass" : "FAIL", line.where.c_str()));
  return lines;
}

}  // namespace relievo::firmware
