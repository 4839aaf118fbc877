// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/sim/sheet/sheet_shape.h"

#include <cmath>

namespace relievo::hal::sim {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kStepMm = 1.5;  // on a radius of 30 mm an arc leaves its chord by 0.0094 mm
constexpr double kLeastRadiusMm = 30;

struct Arc {
  double across = 0, away = 0;
};

// The profile of constant curvature, s along it.
Arc arc(double s, double radius) {
  return {radius * std::sin(s / radius), radius * (1 - std::cos(s / radius))};
}

// Curvature cos(2 pi s / wave) / radius: its direction is known, its place is summed up (Simpson's rule).
Arc wave(double s, double radius, double length) {
  const auto slope = [&](double at) { return length / (2 * kPi * radius) * std::sin(2 * kPi * at / length); };
  const int steps = 2 * (1 + static_cast<int>(std::abs(s) / 2));
  const double h = s / steps;
  Arc sum;
  for (int k = 0; k <= steps; ++k) {
    const double weight = h / 3 * (k == 0 || k == steps ? 1 : (k % 2 == 1 ? 4 : 2));
    sum.across += weight * std::cos(slope(k * h));
    sum.away += weight * std::sin(slope(k * h));
  }
  return sum;
}

// Unrolled, a cone is a sector round its apex; the line through the middle stays where it is.
Vec3 cone(double s, double t, double radius, double apex) {
  const double half_angle = std::atan(std::abs(radius / apex)), sine = std::sin(half_angle),
               cosine = std::cos(half_angle);
  const double along = apex > 0 ? 1 : -1;
  const double slant = std::hypot(s, along * t + std::abs(apex));
  const double turn = std::atan2(s, along * t + std::abs(apex)) / sine;
  const double away = slant * sine * cosine * (1 - std::cos(turn));
  return {slant * sine * std::sin(turn),
          along * (slant * (sine * sine * std::cos(turn) + cosine * cosine) - std::abs(apex)),
          radius > 0 ? away : -away};
}

}  // namespace

Result<void> SheetBend::check() const {
  if (radius_mm != 0 && !(std::abs(radius_mm) >= kLeastRadiusMm))
    return Error{Errc::InvalidInput, "a sheet bends to a radius of 30 mm and no closer; 0 is flat"};
  if (!std::isfinite(radius_mm) || !std::isfinite(axis_deg))
    return Error{Errc::InvalidInput, "a sheet's bend must be finite"};
  if (apex_mm != 0 && !(std::abs(apex_mm) >= 250))
    return Error{Errc::InvalidInput, "a cone's apex lies 250 mm from the sheet's middle or further"};
  if (wave_mm != 0 && !(wave_mm >= 60))
    return Error{Errc::InvalidInput, "a sheet's wave is 60 mm long or longer"};
  if (apex_mm != 0 && wave_mm != 0)
    return Error{Errc::InvalidInput, "a sheet is bent to a cone or in waves, not both"};
  return {};
}

Vec3 bent(const SheetBend& bend, double u, double v) {
  if (bend.radius_mm == 0) return {u, v, 0};
  const double c = std::cos(radians(bend.axis_deg)), d = std::sin(radians(bend.axis_deg));
  const double s = c * u + d * v, t = -d * u + c * v;
  Vec3 p;
  if (bend.apex_mm != 0) {
    p = cone(s, t, bend.radius_mm, bend.apex_mm);
  } else {
    const Arc a = bend.wave_mm > 0 ? wave(s, bend.radius_mm, bend.wave_mm) : arc(s, bend.radius_mm);
    p = {a.across, t, a.away};
  }
  return {c * p.x - d * p.y, d * p.x + c * p.y, p.z};
}

SheetMesh make_sheet(const SheetSize& size, const SheetBend& bend) {
  const int columns = 1 + static_cast<int>(std::ceil(size.width_mm / kStepMm)),
            rows = 1 + static_cast<int>(std::ceil(size.height_mm / kStepMm));
  SheetMesh out;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const double u = size.width_mm * (static_cast<double>(i) / (columns - 1) - 0.5),
                   v = size.height_mm * (static_cast<double>(j) / (rows - 1) - 0.5);
      const Vec3 p = bent(bend, u, v);
      out.mesh.points.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
      out.paper_mm.push_back({static_cast<float>(u), static_cast<float>(v)});
    }
  for (int j = 0; j + 1 < rows; ++j)
    for (int i = 0; i + 1 < columns; ++i) {
      const auto a = static_cast<std::uint32_t>(j * columns + i),
                 below = a + static_cast<std::uint32_t>(columns);
      out.mesh.triangles.push_back({a, a + 1, below});
      out.mesh.triangles.push_back({a + 1, below + 1, below});
    }
  return out;
}

}  // namespace relievo::hal::sim
