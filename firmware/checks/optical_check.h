// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// check_optically(): the optical self-test from the first board to the last plate: calibrate, photograph
// every target, measure it. What comes out is judged by AcceptanceReport::lines().
// Errors: the rig's, calibration's and stages' own, with the target's name; Cancelled.
// Thread: worker.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "firmware/jobs/job_thread.h"
#include "hal/base/result.h"
#include "hal/picture_file.h"
#include "pipeline/calibrate/calibrator.h"
#include "pipeline/model/geometry.h"

namespace relievo::firmware {

// What the optical self-test puts before the cameras, and how it is photographed. Plain data: the
// simulated rig stands behind Photograph in main.cc and in tests, nothing here knows it.
// Target frame: origin in the middle of the target, x along the dumbbell's rod or the plate's width,
// y along the plate's height, z into the target; mm. Places are given in the left camera's frame.
struct OpticalTargets {                    // what their certificate says
  int board_columns = 10, board_rows = 7;  // inner corners
  double square_mm = 20;
  double sphere_diameter_mm = 60;  // of both spheres of the dumbbell
  double sphere_spacing_mm = 120;  // between their centres
  double rod_diameter_mm = 8;      // between them
  double plate_width_mm = 240, plate_height_mm = 180;
};

struct TargetPlace {
  double right_mm = 0, down_mm = 0, distance_mm = 560;  // of the middle
  double pitch_deg = 0, yaw_deg = 0, roll_deg = 0;      // about x, then y, then z of the camera
};

enum class TargetKind : std::uint8_t { Board, Dumbbell, Plate };

struct TargetShot {
  TargetKind kind = TargetKind::Board;
  int number = 0;       // of its kind; a board's place follows from it and from `count`
  int count = 0;        // boards in the series
  TargetPlace place{};  // of dumbbell and plate
  OpticalTargets targets{};
  std::uint32_t seed = 1;  // the rig's tolerances, the speckle, the noise
  double scale = 1;        // of the pictures' width and height
};

struct TargetPictures {
  hal::Picture left, right;
};

// Errors: the rig's own (PoorGeometry: the target does not fit into the views).
using Photograph = std::function<Result<TargetPictures>(const TargetShot&)>;

pipeline::Vec3d left_from_target(const TargetPlace& place, const pipeline::Vec3d& p);

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
  std::string name;  // "dumbbell 1 a", "plate 3"
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

struct OpticalCheckOptions {
  std::uint32_t seed = 1;
  double scale = 1;  // of the pictures
  int boards = 14;
  std::vector<TargetPlace> dumbbells = dumbbell_places();
  std::vector<TargetPlace> plates = plate_places();
  OpticalTargets targets;
  ShowTarget show;  // empty: no pictures
};

// The calibration with which the targets are measured: made from photographed boards by the product's own
// finder and calibrator, never taken from the rig's truth. `each` is called after every board. Errors: the
// rig's, the finder's and the calibrator's; PoorGeometry where its verdict is refuse; Cancelled.
Result<pipeline::CalibratorOutput> calibrate_on_boards(const Photograph& photograph, const TargetShot& series,
                                                       int boards, const std::atomic<bool>& cancelled,
                                                       const std::function<void()>& each);

// Every target of the options, with this calibration. `each` is called after every one.
Result<AcceptanceReport> measure_targets(const pipeline::StereoCalibration& calibration,
                                         const Photograph& photograph, const OpticalCheckOptions& options,
                                         const std::atomic<bool>& cancelled,
                                         const std::function<void()>& each);

struct OpticalCheck {
  pipeline::CalibratorOutput calibration;
  AcceptanceReport report;
};
// Both, one after the other; `at` becomes the name of what is under way.
Result<OpticalCheck> check_optically(const Photograph& photograph, const OpticalCheckOptions& options,
                                     std::atomic<const char*>& at, JobControl& control);

// The optical self-test as report.json, and as lines for a terminal. The keys are part of the product.

std::string acceptance_json(const AcceptanceReport& report, const OpticalCheckOptions& options,
                            const pipeline::CalibrationQuality& calibration);
std::vector<std::string> acceptance_table(const AcceptanceReport& report, const OpticalCheckOptions& options,
                                          const pipeline::CalibrationQuality& calibration);

}  // namespace relievo::firmware
