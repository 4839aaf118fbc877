// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/sim/head/head_light.h"

#include "hal/sim/base/noise.h"

namespace relievo::hal::sim {
namespace {

double fifth(double v) { return v * v * v * v * v; }

}  // namespace

HeadLight::HeadLight(const HeadModel& model, const HeadPose& pose, ThreadPool& pool,
                     const HeadLighting& lighting)
    : panels_(lamp_panels(lighting)) {
  const Mat3 head_from_world = pose.world_from_head().transposed();
  const Vec3 origin = pose.origin_mm();
  for (Panel& p : panels_)
    p = {head_from_world * (p.centre - origin), head_from_world * p.half_x, head_from_world * p.half_y,
         p.power};
  eye_ = head_from_world * (Vec3{70, 0, 0} - origin);
  up_ = head_from_world * Vec3{0, -1, 0};
  for (std::size_t shell = 0; shell < HeadModel::BodyCount; ++shell)
    for (std::size_t panel = 0; panel < kPanels; ++panel) measure(model, shell, panel, pool);
}

void HeadLight::measure(const HeadModel& model, std::size_t shell_index, std::size_t panel_index,
                        ThreadPool& pool) {
  const int rays_a_side = panel_index < 2 ? 3 : 2;
  const Shell& shell = model.shells[shell_index];
  const Panel& panel = panels_[panel_index];
  std::vector<float>& seen = seen_[shell_index][panel_index];
  seen.assign(shell.mesh.points.size(), 0.0F);
  if (seen.empty()) return;
  pool.for_each_band(static_cast<int>(seen.size()), 64, [&](int begin, int end, int) {
    for (int i = begin; i < end; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const Vec3 p = point_of(shell.mesh, k), n = shell.normals[k];
      if (p.z < -35 || dot(n, panel.centre - p) < -0.3 * length(panel.centre - p)) continue;
      if (dot(n, normalised(eye_ - p)) < -0.45) continue;  // turned away from both cameras
      const std::uint32_t h = hash_cell(i, static_cast<int>(panel_index), 1, 9);
      int open = 0;
      for (int r = 0; r < rays_a_side * rays_a_side; ++r) {
        const double u = (r % rays_a_side + unit_from_hash(h)) / rays_a_side * 2 - 1,
                     v = (r / rays_a_side + unit_from_hash(h * 31 + 7)) / rays_a_side * 2 - 1;
        const Vec3 to = panel.centre + panel.half_x * u + panel.half_y * v - p;
        const double far = length(to);
        open += model.caster.blocked(p + n * 0.15, to * (1 / far), far) ? 0 : 1;
      }
      seen[k] = static_cast<float>(open) / static_cast<float>(rays_a_side * rays_a_side);
    }
  });
  smooth_over(shell.mesh, seen, 4);
}

std::array<double, HeadLight::kPanels> HeadLight::seen(std::size_t shell,
                                                       const std::array<std::uint32_t, 3>& corner, double u,
                                                       double v) const {
  std::array<double, kPanels> out{};
  for (std::size_t k = 0; k < kPanels; ++k)
    out[k] = static_cast<double>(blend_corners(seen_[shell][k], corner, u, v));
  return out;
}

double HeadLight::seen_from(const HeadModel& model, Vec3 p, std::size_t panel) const {
  const Vec3 to = panels_[panel].centre - p;
  const double far = length(to);
  return model.caster.blocked(p + to * (0.4 / far), to * (1 / far), far) ? 0.0 : 1.0;
}

Vec3 HeadLight::ambient(Vec3 normal, double openness, const Surface& s) const {
  const double sky = 0.5 + 0.5 * dot(normal, up_);
  const Vec3 light = mix(Vec3{0.065, 0.06, 0.058}, Vec3{0.13, 0.132, 0.14}, sky);
  // In hollows light has bounced off skin before it arrives, and comes red.
  const double o = std::max(openness, 0.02);
  const Vec3 hollow = s.translucent > 0
                          ? Vec3{mix(o, std::sqrt(o), 0.3), mix(o, o * o, 0.15), mix(o, o * o, 0.25)}
                          : Vec3{o, o, o};
  return s.colour * light * hollow;
}

// The panel seen in the surface: the point of it nearest to the mirrored ray stands for all of it.
double HeadLight::highlight(const Panel& panel, const Point& p, double roughness) const {
  const Vec3 mirrored = p.normal * (2 * dot(p.normal, p.to_eye)) - p.to_eye;
  const Vec3 n = cross(panel.half_x, panel.half_y);
  const double along = dot(panel.centre - p.at, n) / std::min(dot(mirrored, n), -1e-6 * length(n));
  Vec3 aim = panel.centre;
  if (along > 0) {
    const Vec3 from = p.at + mirrored * along - panel.centre;
    const double u = std::clamp(dot(from, panel.half_x) / dot(panel.half_x, panel.half_x), -1.0, 1.0);
    const double v = std::clamp(dot(from, panel.half_y) / dot(panel.half_y, panel.half_y), -1.0, 1.0);
    aim = panel.centre + panel.half_x * u + panel.half_y * v;
  }
  const Vec3 l = normalised(aim - p.at), half = normalised(l + p.to_eye);
  const double ndl = dot(p.normal, l), ndh = std::max(dot(p.normal, half), 0.0);
  if (ndl <= 0) return 0;
  const double a2 = roughness * roughness * roughness * roughness, q = ndh * ndh * (a2 - 1) + 1;
  const double widened = std::min(1.0, a2 * 6);  // an area light spreads and dims a sharp lobe
  const double fresnel = 0.028 + 0.972 * fifth(1 - std::max(dot(half, p.to_eye), 0.0));
  return fresnel * widened * a2 / (3.14159 * q * q) / std::max(a2, 0.02) * 0.35 * std::min(1.0, ndl * 4) *
         0.25;
}

Vec3 HeadLight::on(const Point& p, const Surface& s) const {
  Vec3 out = ambient(p.normal, p.openness, s);
  // Light enters skin and leaves it further on, red furthest: edges of shade are soft and warm.
  const Vec3 wrap = Vec3{0.22, 0.09, 0.06} * s.translucent;
  for (std::size_t k = 0; k < kPanels; ++k) {
    const Vec3 to = panels_[k].centre - p.at;
    const double d = length(to), ndl = dot(p.normal, to) / d;
    const double power = panels_[k].power * (kPanelReferenceMm / d) * (kPanelReferenceMm / d);
    const auto lit = [&](double w) { return std::max(0.0, (ndl + w) / ((1 + w) * (1 + w))); };
    const double v = p.seen[k];
    const Vec3 shade =
        s.translucent > 0 ? Vec3{mix(v, std::sqrt(v), 0.4), v, mix(v, v * v, 0.1)} : Vec3{v, v, v};
    out += s.colour * Vec3{lit(wrap.x), lit(wrap.y), lit(wrap.z)} * shade * power;
    const double shine = s.gloss * highlight(panels_[k], p, s.roughness) * power * v * 2.9;
    out += Vec3{shine, shine, shine};
  }
  return out;
}

Vec3 HeadLight::on_hair(const Point& p, Vec3 tangent, Vec3 colour) const {
  Vec3 out = colour * (0.14 * p.openness);
  for (std::size_t k = 0; k < kPanels; ++k) {
    const Vec3 to = panels_[k].centre - p.at, l = normalised(to);
    const double power = panels_[k].power * p.seen[k];
    const double tl = dot(tangent, l), tv = dot(tangent, p.to_eye);
    const double sl = std::sqrt(std::max(0.0, 1 - tl * tl)), sv = std::sqrt(std::max(0.0, 1 - tv * tv));
    const double facing = clamp01(0.35 + 0.65 * dot(p.normal, l));
    const double shine = std::pow(std::max(0.0, sl * sv - tl * tv), 40);
    out += colour * (sl * facing * power * 0.85) +
           (Vec3{0.035, 0.035, 0.035} + colour * 0.35) * (shine * facing * power);
  }
  return out;
}

}  // namespace relievo::hal::sim
