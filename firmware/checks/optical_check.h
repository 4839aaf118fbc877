// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// OpticalCheckJob: the optical self-test from the first board to the last plate: calibrate, photograph
// every target, measure it. What comes out is judged by AcceptanceReport::lines().
// Errors: the rig's, calibration's and stages' own, with the target's name; Cancelled.
// Thread: made and read by main, run by the worker.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/base/boot_memory.h"
#include "firmware/checks/target_calibration.h"
#include "firmware/jobs/job_thread.h"
#include "pipeline/calibrate/calibrator.h"
#include "pipeline/model/vector3.h"
#include "pipeline/pipeline.h"

namespace relievo::firmware {

// An acceptance test of the whole chain on known targets, in the spirit of VDI/VDE 2634 part 2
// (optical systems that measure areas from a single view). Of a reading's points 3 in 1000, those
// furthest off, may be discarded; spheres and planes are least-squares fits, the radius free.
//   probing error, form   range of the radial deviations of a sphere's points
//   probing error, size   measured minus certified diameter
//   sphere spacing        measured minus certified distance of the two centres
//   flatness              range of the distances from the fitted plane
// Evaluated is what the targets' certificate covers: of a sphere the cap that the left camera sees at
// no more than kCapDeg from its normal, but not within kRodMm of the rod's axis, which shades and
// hides it; of the plate all but kRimMm along the edge.
// Thread: worker.

// TargetMeter: measures a target as the product measures a face: rectify, match, triangulate, reject
// outliers, mesh, with the default algorithms. Only what knows of faces stays out: no face is looked
// for (a ball around the target is the region instead, so nothing is cropped), the mesher accepts less
// surface than a face has, and the texture stage with its head frame is not run.
// Left camera's frame, millimetres.
// Memory: 0.9 GiB of address space, touched as far as the pictures need; one pool of threads.
// Errors: the stages' own; PoorGeometry (nothing measured there). Thread: worker; one caller.
class TargetMeter {
 public:
  static Result<TargetMeter> make(const pipeline::StereoCalibration& calibration,
                                  const std::atomic<bool>& cancelled);
  TargetMeter(TargetMeter&&) noexcept;
  ~TargetMeter();

  // Rectifies the pair; it is borrowed until the next one is taken.
  Result<void> take(const TargetPictures& pictures);
  // The measured vertices of the mesh (never the bridged ones) within `reach_mm` of `centre_mm` as the
  // left rectified view shows it.
  Result<std::vector<pipeline::Vec3d>> surface_around(const pipeline::Vec3d& centre_mm, double reach_mm);
  // The rectified left view around the target, beside it the same with every point coloured by its
  // deviation: blue -range, white 0, red +range, and the scale below.
  hal::Picture picture_of(const pipeline::Vec3d& centre_mm, double reach_mm,
                          const std::vector<pipeline::Vec3d>& points_mm,
                          const std::vector<double>& deviations_mm, double range_mm) const;

 private:
  struct Circle {
    double x_px = 0, y_px = 0, radius_px = 0;
  };
  TargetMeter();
  Circle circle_around(const pipeline::Vec3d& centre_mm, double reach_mm) const;

  struct Room;  // memory, threads and the rectified pair: they stay where they are
  std::unique_ptr<Room> room_;
};

inline constexpr double kDiscardShare = 0.003;
inline constexpr double kCapDeg = 60;
inline constexpr double kRodMm = 12;
inline constexpr double kRimMm = 3;

struct AcceptanceLimits {  // mm; what may not be exceeded, either sign
  double form_mm = 0, size_mm = 0, spacing_mm = 0, flatness_mm = 0;
};
// For pictures `scale` (0.5 to 1) times 1920 x 1200: a pixel of smaller ones covers more.
// firmware/FIGURES.md says where the numbers come from.
AcceptanceLimits limits_at(double scale);

struct TargetReading {
  std::string name;  // "dumbbell 1 left", "plate 3"
  TargetKind kind = TargetKind::Dumbbell;
  std::size_t measured = 0;  // points the mesh holds there; used + discarded of them were evaluated
  std::size_t used = 0, discarded = 0;
  double range_mm = 0;  // form, or flatness
  double rms_mm = 0;
  double size_mm = 0;         // sphere only
  pipeline::Vec3d centre_mm;  // sphere only
};

struct SpacingReading {
  std::string name;  // "dumbbell 1"
  double error_mm = 0;
};

struct AcceptanceLine {  // the worst reading of a measure
  std::string measure;
  std::string where;
  double value_mm = 0, limit_mm = 0;
  bool held() const;  // false for what is no number
};

struct AcceptanceReport {
  std::vector<TargetReading> targets;
  std::vector<SpacingReading> spacings;
  std::vector<AcceptanceLine> lines(const AcceptanceLimits& limits) const;
  // PoorGeometry, with the first measure that is over its limit and where.
  Result<void> verdict(const AcceptanceLimits& limits) const;
};

// Where the targets stand: seven ways for the dumbbell, six for the plate, spread over the capture
// volume. Nothing of it depends on the rig.
std::vector<TargetPlace> dumbbell_places();
std::vector<TargetPlace> plate_places();

// Called with a picture of every target (DeviationPicture); may be empty.
using ShowTarget = std::function<Result<void>(const std::string& name, const hal::Picture& picture)>;

// Measures one target that was taken by the meter, and adds its readings to the report.
// Errors: as TargetMeter, and PoorGeometry where too few points lie on the target; each names it.
Result<void> measure_dumbbell(TargetMeter& meter, const TargetShot& shot, double picture_range_mm,
                              const ShowTarget& show, AcceptanceReport& report);
Result<void> measure_plate(TargetMeter& meter, const TargetShot& shot, double picture_range_mm,
                           const ShowTarget& show, AcceptanceReport& report);

struct OpticalCheckOptions {
  std::uint32_t seed = 1;
  double scale = 1;  // of the pictures
  int boards = 14;
  std::vector<TargetPlace> dumbbells = dumbbell_places();
  std::vector<TargetPlace> plates = plate_places();
  OpticalTargets targets;
  ShowTarget show;  // empty: no pictures
};

// Every target of the options, with this calibration. `each` is called after every one.
Result<AcceptanceReport> measure_targets(const pipeline::StereoCalibration& calibration,
                                         const Photograph& photograph, const OpticalCheckOptions& options,
                                         const std::atomic<bool>& cancelled,
                                         const std::function<void()>& each);

class OpticalCheckJob final : public Job {
 public:
  OpticalCheckJob(Photograph photograph, OpticalCheckOptions options)
      : photograph_(std::move(photograph)), options_(std::move(options)) {}
  Result<void> run(JobControl& control) override;
  std::string_view stage() const { return measuring_.load() ? "Measure" : "Calibrate"; }  // any thread
  const pipeline::CalibratorOutput& calibration() const { return calibration_; }
  const AcceptanceReport& report() const { return report_; }

 private:
  Photograph photograph_;
  OpticalCheckOptions options_;
  std::atomic<bool> measuring_{false};
  pipeline::CalibratorOutput calibration_;
  AcceptanceReport report_;
};

// The optical self-test as report.json, and as lines for a terminal. The keys are part of the product.

std::string acceptance_json(const AcceptanceReport& report, const OpticalCheckOptions& options,
                            const pipeline::CalibrationQuality& calibration);
std::vector<std::string> acceptance_table(const AcceptanceReport& report, const OpticalCheckOptions& options,
                                          const pipeline::CalibrationQuality& calibration);

}  // namespace relievo::firmware
