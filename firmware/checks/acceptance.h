// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
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
#pragma once

#include <string>
#include <vector>

#include "firmware/checks/optical_target.h"
#include "firmware/checks/target_meter.h"

namespace relievo::firmware {

inline constexpr double kDiscardShare = 0.003;
inline constexpr double kCapDeg = 60;
inline constexpr double kRodMm = 12;
inline constexpr double kRimMm = 3;

struct AcceptanceLimits {  // mm; what may not be exceeded, either sign
  double form_mm = 0, size_mm = 0, spacing_mm = 0, flatness_mm = 0;
};
// For pictures `scale` (0.5 to 1) times 1920 x 1200: a pixel of smaller ones covers more. README.md
// says where the numbers come from.
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

}  // namespace relievo::firmware
