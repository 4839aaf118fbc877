// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/checks/optical_check.h"

#include <cmath>
#include <cstdio>
#include <numbers>

#include "firmware/base/boot_memory.h"
#include "firmware/checks/deviation_picture.h"
#include "firmware/jobs/job_thread.h"
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
// Errors: the stages' own; PoorGeometry (nothing measured there).
class TargetMeter {
 public:
  TargetMeter(pipeline::Pipeline stages, const std::atomic<bool>& cancelled)
      : context_{output_, scratch_, pool_, progress_, cancelled}, pipeline_(std::move(stages)) {}

  // Rectifies the pair; it is borrowed until the next one is taken.
  Result<void> take(const TargetPictures& pictures) {
    pair_.reset();
    output_.reset();
    RELIEVO_TRY_ASSIGN(pair_, pipeline_.rectify({pictures.left.view(), pictures.right.view()}, context_));
    return {};
  }
  // The measured vertices of the mesh (never the bridged ones) within `reach_mm` of `centre_mm` as the
  // left rectified view shows it.
  Result<std::vector<Vec3d>> surface_around(const Vec3d& centre_mm, double reach_mm);
  // The rectified left view around the target, beside it the same with every point coloured by its
  // deviation: blue -range, white 0, red +range, and the scale below.
  hal::Picture picture_of(const Vec3d& centre_mm, double reach_mm, const std::vector<Vec3d>& points_mm,
                          const std::vector<double>& deviations_mm, double range_mm) const;

 private:
  struct Circle {
    double x_px = 0, y_px = 0, radius_px = 0;
  };
  Circle circle_around(const Vec3d& centre_mm, double reach_mm) const {
    const Vec3d c = apply(pair_->rectified_from_left, centre_mm);
    const double scale = pair_->focal_px / c.z;
    return {scale * c.x + pair_->left_centre_px.x, scale * c.y + pair_->left_centre_px.y, scale * reach_mm};
  }

  BootMemory memory_{0, budget::kLargestPlan.products, budget::kLargestPlan.scratch};
  Arena output_{memory_.output()}, scratch_{memory_.scratch()};
  ThreadPool pool_{pool_size()};
  pipeline::Progress progress_;
  pipeline::StageContext context_;
  pipeline::Pipeline pipeline_;
  std::optional<pipeline::RectifiedPair> pair_;
};

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

hal::Picture TargetMeter::picture_of(const Vec3d& centre_mm, double reach_mm,
                                     const std::vector<Vec3d>& points_mm,
                                     const std::vector<double>& deviations_mm, double range_mm) const {
  const pipeline::RectifiedPair& pair = *pair_;
  const Circle circle = circle_around(centre_mm, reach_mm);
  DeviationPicture picture(pair.left.rgb, pair.width_px, pair.height_px,
                           {int(circle.x_px - circle.radius_px), int(circle.y_px - circle.radius_px),
                            int(circle.x_px + circle.radius_px), int(circle.y_px + circle.radius_px)});
  for (std::size_t i = 0; i < points_mm.size(); ++i) {
    const Vec3d p = apply(pair.rectified_from_left, points_mm[i]);
    picture.mark(pair.focal_px * p.x / p.z + pair.left_centre_px.x,
                 pair.focal_px * p.y / p.z + pair.left_centre_px.y, deviations_mm[i] / range_mm);
  }
  return picture.finish();
}

template <typename Form>
Result<void> show_reading(const TargetMeter& meter, const TargetReading& reading, const Form& form,
                          const std::vector<Vec3d>& points, const Vec3d& centre_mm, double reach_mm,
                          double range_mm, const ShowTarget& show) {
  if (!show) return {};
  std::vector<double> deviations;
  deviations.reserve(points.size());
  for (const Vec3d& p : points) deviations.push_back(deviation(form, p));
  return show(reading.name, meter.picture_of(centre_mm, reach_mm, points, deviations, range_mm));
}

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

Result<TargetReading> measure_sphere(TargetMeter& meter, const TargetShot& shot, const Vec3d& centre_mm,
                                     const Vec3d& rod, const std::string& name, double picture_range_mm,
                                     const ShowTarget& show) {
  const double radius = shot.targets.sphere_diameter_mm / 2;
  auto surface = meter.surface_around(centre_mm, radius + kMarginMm);
  if (!surface) return at_target(surface.error(), name);
  const std::vector<Vec3d> cap = cap_of(*surface, centre_mm, rod);
  const auto read = pipeline::best_fit::read_sphere(cap, kDiscardShare);
  if (!read) return at_target(read.error(), name);
  const double size_mm = 2 * read->form.radius_mm - shot.targets.sphere_diameter_mm;
  const TargetReading reading{
      name,           TargetKind::Dumbbell, surface->size(), read->used,          read->discarded,
      read->range_mm, read->rms_mm,         size_mm,         read->form.centre_mm};
  RELIEVO_TRY(
      show_reading(meter, reading, read->form, cap, centre_mm, radius + kMarginMm, picture_range_mm, show));
  return reading;
}

// Measures one target that was taken by the meter, and adds its readings to the report.
// Errors: as TargetMeter, and PoorGeometry where too few points lie on the target; each names it.
Result<void> measure_dumbbell(TargetMeter& meter, const TargetShot& shot, double picture_range_mm,
                              const ShowTarget& show, AcceptanceReport& report) {
  const std::string name = "dumbbell " + std::to_string(shot.number + 1);
  const Vec3d along = minus(left_from_target(shot.place, {1, 0, 0}), left_from_target(shot.place, {0, 0, 0}));
  Vec3d centres[2];
  for (const int side : {0, 1}) {
    const double out = side == 0 ? -1 : 1;
    const Vec3d nominal = left_from_target(shot.place, {out * shot.targets.sphere_spacing_mm / 2, 0, 0});
    RELIEVO_TRY_ASSIGN(const TargetReading reading,
                       measure_sphere(meter, shot, nominal, times(along, -out),
                                      name + (side == 0 ? " a" : " b"), picture_range_mm, show));
    centres[side] = reading.centre_mm;
    report.targets.push_back(reading);
  }
  report.spacings.push_back({name, distance(centres[0], centres[1]) - shot.targets.sphere_spacing_mm});
  return {};
}

Result<void> measure_plate(TargetMeter& meter, const TargetShot& shot, double picture_range_mm,
                           const ShowTarget& show, AcceptanceReport& report) {
  const std::string name = "plate " + std::to_string(shot.number + 1);
  const Vec3d middle = left_from_target(shot.place, {0, 0, 0});
  const Vec3d x = minus(left_from_target(shot.place, {1, 0, 0}), middle),
              y = minus(left_from_target(shot.place, {0, 1, 0}), middle);
  const double half_width = shot.targets.plate_width_mm / 2, half_height = shot.targets.plate_height_mm / 2;
  const double reach = std::hypot(half_width, half_height) + kMarginMm;
  auto surface = meter.surface_around(middle, reach);
  if (!surface) return at_target(surface.error(), name);
  std::vector<Vec3d> inside;
  for (const Vec3d& p : *surface) {
    const Vec3d from = minus(p, middle);
    if (std::abs(dot(from, x)) < half_width - kRimMm && std::abs(dot(from, y)) < half_height - kRimMm)
      inside.push_back(p);
  }
  const auto read = pipeline::best_fit::read_plane(inside, kDiscardShare);
  if (!read) return at_target(read.error(), name);
  const TargetReading reading{
      name, TargetKind::Plate, surface->size(), read->used, read->discarded, read->range_mm, read->rms_mm, 0,
      {}};
  RELIEVO_TRY(show_reading(meter, reading, read->form, inside, middle, reach, picture_range_mm, show));
  report.targets.push_back(reading);
  return {};
}

TargetShot series_of(const OpticalCheckOptions& options) {
  TargetShot shot;
  shot.targets = options.targets;
  shot.seed = options.seed;
  shot.scale = options.scale;
  return shot;
}

// No board is a finding, anything else an error.
Result<pipeline::BoardCorners> look(const hal::Picture& picture, const pipeline::BoardPattern& pattern) {
  auto corners = pipeline::find_board(picture.view(), pattern);
  if (!corners && corners.error().code == Errc::NotFound) return pipeline::BoardCorners{};
  return corners;
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
    RELIEVO_TRY_ASSIGN(view.left, look(pictures.left, input.pattern));
    RELIEVO_TRY_ASSIGN(view.right, look(pictures.right, input.pattern));
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
  TargetMeter meter(std::move(stages), cancelled);
  AcceptanceReport report;
  TargetShot shot = series_of(options);
  for (const TargetKind kind : {TargetKind::Dumbbell, TargetKind::Plate}) {
    const auto& places = kind == TargetKind::Dumbbell ? options.dumbbells : options.plates;
    const AcceptanceLimits limits = limits_at(options.scale);
    shot.kind = kind;
    shot.number = 0;
    for (const TargetPlace& place : places) {
      if (cancelled.load()) return Error{Errc::Cancelled, "cancelled: nothing was written"};
      shot.place = place;
      RELIEVO_TRY_ASSIGN(const TargetPictures pictures, photograph(shot));
      RELIEVO_TRY(meter.take(pictures));
      // A quarter of what is allowed fills the colours: a good reading then still shows its pattern.
      if (kind == TargetKind::Dumbbell) {
        RELIEVO_TRY(measure_dumbbell(meter, shot, limits.form_mm / 4, options.show, report));
      } else {
        RELIEVO_TRY(measure_plate(meter, shot, limits.flatness_mm / 4, options.show, report));
      }
      ++shot.number;
      each();
    }
  }
  return report;
}

Result<void> OpticalCheckJob::run(JobControl& control) {
  const auto shots = float(std::size_t(options_.boards) + options_.dumbbells.size() + options_.plates.size());
  float done = 0;
  const auto each = [&] { control.progress.done.store(++done / shots); };
  RELIEVO_TRY_ASSIGN(calibration_, calibrate_on_boards(photograph_, series_of(options_), options_.boards,
                                                       control.cancelled, each));
  measuring_.store(true);
  RELIEVO_TRY_ASSIGN(
      report_, measure_targets(calibration_.calibration, photograph_, options_, control.cancelled, each));
  if (control.cancelled.load()) return Error{Errc::Cancelled, "cancelled: nothing was written"};
  return {};
}

std::vector<std::string> acceptance_table(const AcceptanceReport& report, const OpticalCheckOptions& options,
                                          const pipeline::CalibrationQuality& calibration) {
  char text[200];
  std::vector<std::string> lines;
  std::snprintf(text, sizeof text, "calibrated on %d of %zu boards, pair rms %.3f px, baseline %.2f mm",
                calibration.used, calibration.views.size(), calibration.pair_rms_px, calibration.baseline_mm);
  lines.emplace_back(text);
  lines.emplace_back("target         points    used    out  form/flat   size    rms (mm; out: discarded)");
  for (const TargetReading& t : report.targets) {
    char size[16] = "";
    if (t.kind == TargetKind::Dumbbell) std::snprintf(size, sizeof size, "%+.3f", t.size_mm);
    std::snprintf(text, sizeof text, "%-13s %7zu %7zu %6zu %8.3f %8s %8.3f", t.name.c_str(), t.measured,
                  t.used, t.discarded, t.range_mm, size, t.rms_mm);
    lines.emplace_back(text);
  }
  for (const SpacingReading& s : report.spacings) {
    std::snprintf(text, sizeof text, "%-13s spacing %+.3f mm", s.name.c_str(), s.error_mm);
    lines.emplace_back(text);
  }
  for (const AcceptanceLine& line : report.lines(limits_at(options.scale))) {
    std::snprintf(text, sizeof text, "%-20s %+.3f mm, limit %.3f mm: %s (%s)", line.measure.c_str(),
                  line.value_mm, line.limit_mm, line.held() ? "pass" : "FAIL", line.where.c_str());
    lines.emplace_back(text);
  }
  return lines;
}

}  // namespace relievo::firmware
