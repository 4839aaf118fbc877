// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/checks/optical_check.h"

#include "firmware/checks/target_calibration.h"

namespace relievo::firmware {
namespace {

TargetShot series_of(const OpticalCheckOptions& options) {
  TargetShot shot;
  shot.targets = options.targets;
  shot.seed = options.seed;
  shot.scale = options.scale;
  return shot;
}

}  // namespace

Result<AcceptanceReport> measure_targets(const pipeline::StereoCalibration& calibration,
                                         const Photograph& photograph, const OpticalCheckOptions& options,
                                         const std::atomic<bool>& cancelled,
                                         const std::function<void()>& each) {
  RELIEVO_TRY_ASSIGN(TargetMeter meter, TargetMeter::make(calibration, cancelled));
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
  const auto shots = static_cast<float>(static_cast<std::size_t>(options_.boards) +
                                        options_.dumbbells.size() + options_.plates.size());
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

}  // namespace relievo::firmware
