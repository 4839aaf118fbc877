// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/sim/optics/rig.h"

#include <iomanip>
#include <span>
#include <sstream>

#include "hal/base/whole_file.h"
#include "hal/sim/base/noise.h"

namespace relievo::hal::sim {
namespace {

struct Bent {
  double x, y;
};

Bent distort(const SimView& v, double x, double y) {
  const double r2 = x * x + y * y;
  const double s = 1 + r2 * (v.k1 + r2 * (v.k2 + r2 * v.k3));
  return {x * s + 2 * v.p1 * x * y + v.p2 * (r2 + 2 * x * x),
          y * s + v.p1 * (r2 + 2 * y * y) + 2 * v.p2 * x * y};
}

SimView make_view(const RigOptions& o, Random& random) {
  const double size = std::max(o.width_px, o.height_px) / 1920.0, p = o.perturbation;
  SimView v;
  v.width_px = o.width_px;
  v.height_px = o.height_px;
  v.fx_px = o.focal_px * size * (1 + 0.003 * p * random.normal_within(3));
  v.fy_px = v.fx_px * (1 + 0.0004 * p * random.normal_within(3));
  v.cx_px = (o.width_px - 1) / 2.0 + 9 * size * p * random.normal_within(2.5);
  v.cy_px = (o.height_px - 1) / 2.0 + 9 * size * p * random.normal_within(2.5);
  v.k1 = -0.105 + 0.004 * p * random.normal_within(3);
  v.k2 = 0.115 + 0.01 * p * random.normal_within(3);
  v.p1 = 3e-4 * p * random.normal_within(3);
  v.p2 = 3e-4 * p * random.normal_within(3);
  v.k3 = 0.01 * p * random.normal_within(3);
  return v;
}

void write_matrix(std::ostream& out, const char* name, int rows, std::span<const double> numbers) {
  out << name << ": !!opencv-matrix\n   rows: " << rows << "\n   cols: " << int(numbers.size()) / rows
      << "\n   dt: d\n   data: [ ";
  for (std::size_t i = 0; i < numbers.size(); ++i) out << (i == 0 ? "" : ", ") << numbers[i];
  out << " ]\n";
}
void write_view(std::ostream& out, const char* k, const char* d, const SimView& v) {
  write_matrix(out, k, 3, std::array{v.fx_px, 0.0, v.cx_px, 0.0, v.fy_px, v.cy_px, 0.0, 0.0, 1.0});
  write_matrix(out, d, 1, std::array{v.k1, v.k2, v.p1, v.p2, v.k3});
}

}  // namespace

Pixel SimView::project(Vec3 point_in_world) const {
  const Vec3 c = view_from_world * point_in_world + offset_mm;
  const Bent b = distort(*this, c.x / c.z, c.y / c.z);
  return {fx_px * b.x + cx_px, fy_px * b.y + cy_px};
}

Vec3 SimView::ray(double x_px, double y_px) const {
  const double xd = (x_px - cx_px) / fx_px, yd = (y_px - cy_px) / fy_px;
  double x = xd, y = yd;
  // The lens is nearly straight, so plain fixed-point iteration gains more than a digit a turn.
  for (int i = 0; i < 12; ++i) {
    const Bent b = distort(*this, x, y);
    x += xd - b.x;
    y += yd - b.y;
    if (std::abs(xd - b.x) + std::abs(yd - b.y) < 1e-12) break;
  }
  return normalised(view_from_world.transposed() * Vec3{x, y, 1});
}

Result<void> RigOptions::check() const {
  if (std::max(width_px, height_px) < 64 || std::min(width_px, height_px) < 40 ||
      std::max(width_px, height_px) > 8192)
    return invalid("the simulated picture must be between 64x40 and 8192x8192 px, or the same upright");
  if (!(focal_px > 100) || !(baseline_mm > 1) || !(convergence_mm > 50))
    return invalid(
        "the simulated rig needs a focal length over 100 px, a baseline over 1 mm and a distance over 50 mm");
  return {};
}

SimRig make_rig(const RigOptions& o) {
  Random random(o.seed);
  SimRig rig{make_view(o, random), make_view(o, random)};
  const double p = o.perturbation;
  const double baseline = o.baseline_mm + 1.5 * p * random.normal_within(2.5);
  const double half_toe = std::atan(baseline / 2 / o.convergence_mm);
  const Mat3 right_from_left =
      rotation(0.004 * p * random.normal_within(2.5), 2 * half_toe + 0.004 * p * random.normal_within(2.5),
               0.006 * p * random.normal_within(2.5));
  const Vec3 right_centre{baseline * std::cos(half_toe), 0.8 * p * random.normal_within(2.5),
                          baseline * std::sin(half_toe)};
  rig.right.view_from_world = right_from_left;
  rig.right.offset_mm = -(right_from_left * right_centre);
  return rig;
}

Result<void> write_rig(const std::filesystem::path& file, const SimRig& rig) {
  std::ostringstream out;
  out << std::setprecision(17) << "%YAML:1.0\n---\nimage_width: " << rig.left.width_px
      << "\nimage_height: " << rig.left.height_px << '\n';
  write_view(out, "K1", "D1", rig.left);
  write_view(out, "K2", "D2", rig.right);
  const auto& r = rig.right.view_from_world.row;
  const Vec3& t = rig.right.offset_mm;
  write_matrix(out, "R", 3,
               std::array{r[0].x, r[0].y, r[0].z, r[1].x, r[1].y, r[1].z, r[2].x, r[2].y, r[2].z});
  write_matrix(out, "T", 3, std::array{t.x, t.y, t.z});
  return write_whole_file(file, std::as_bytes(std::span(out.view())));
}

}  // namespace relievo::hal::sim
