// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/sim/head/shape/head_field.h"

namespace relievo::hal::sim {

MouthForm::MouthForm(const HeadTraits& traits, const SkullForm& skull) : t_(traits) {
  const double smile = t_.expression.smile;
  half_width_ = t_.mouth_width / 2 * (1 + 0.22 * smile);
  sto_ = stomion_y(t_);
  upper_mm_ = (7.0 + 1.5 * t_.lip_fullness) * (1 - 0.25 * smile);  // drawn out, lips are thinner
  lower_mm_ = (9.0 + 1.6 * t_.lip_fullness) * (1 - 0.2 * smile);
  bow_ = {{0, 0.84}, {0.11, 0.90}, {0.21, 1.0}, {0.33, 0.92}, {0.6, 0.60}, {0.85, 0.24}, {1, 0.02}};
  front_ = skull.front_z(0, sto_) + 3.4;
  const double w = half_width_, u = upper_mm_, l = lower_mm_;
  // Follows the arch of the teeth behind.
  const auto arch = [&](double x, double y, double out, double r) {
    const double z = skull.front_z(x, y) + 3.4 * gauss(x / 23) + out - r;
    return Bead{{x, y, z}, r};
  };
  const double g = 0.25 * t_.lip_fullness;
  upper_ =
      BeadString({arch(-6, sto_ + 0.47 * u, 1.5 + g, 3.6), arch(0, sto_ + 0.36 * u, 2.0 + g, 3.5),
                  arch(6, sto_ + 0.47 * u, 1.5 + g, 3.6), arch(0.55 * w, sto_ + 0.31 * u, 1.0 + g, 3.0),
                  arch(0.8 * w, line_y(0.8 * w) + 0.12 * u, 0.5, 2.0), arch(w - 0.5, line_y(w), -0.9, 1.0)},
                 3);
  lower_ =
      BeadString({arch(-8, sto_ - 0.46 * l, 1.5 + g, 4.3), arch(0, sto_ - 0.46 * l, 1.4 + g, 4.4),
                  arch(8, sto_ - 0.46 * l, 1.5 + g, 4.3), arch(0.55 * w, sto_ - 0.38 * l, 0.8 + g, 3.6),
                  arch(0.8 * w, line_y(0.8 * w) - 0.20 * l, 0.1, 2.4), arch(w - 0.5, line_y(w), -1.1, 1.0)},
                 3);
  line_ = BeadString({arch(-6, line_y(6), 1.5, 0.7), arch(0, line_y(0), 1.7, 0.7),
                      arch(6, line_y(6), 1.5, 0.7), arch(0.5 * w, line_y(0.5 * w), 0.9, 0.7),
                      arch(0.8 * w, line_y(0.8 * w), 0.2, 0.6), arch(w + 0.3, line_y(w + 0.3), -0.2, 0.4)},
                     3);
}

double MouthForm::line_y(double x) const {
  const double s = std::abs(x) / half_width_;
  // A small dip in the middle, and corners that go their person's way.
  return sto_ - 0.7 * gauss(s / 0.2) + 0.35 * gauss((s - 0.33) / 0.2) +
         (-0.6 + 1.1 * t_.mouth_curve + 5.5 * t_.expression.smile) * s * s;
}

double MouthForm::upper_edge(double x) const {
  const double s = std::min(std::abs(x) / half_width_, 1.0);
  return line_y(x) + upper_mm_ * bow_(s);
}

double MouthForm::lower_edge(double x) const {
  const double s = std::min(std::abs(x) / half_width_, 1.0);
  return line_y(x) - lower_mm_ * std::pow(1 - s * s, 0.75) * (1 - 0.12 * gauss(s / 0.15));
}

double MouthForm::vermilion(Vec3 p) const {
  if (std::abs(p.x) > half_width_ + 1 || p.z < front_ - 30) return 0;
  const double up = upper_edge(p.x) - p.y, low = p.y - lower_edge(p.x);
  return smoothstep(-0.8, 1.2, up) * smoothstep(-1.3, 2.0, low) *
         smoothstep(half_width_ + 0.5, half_width_ - 5.0, std::abs(p.x));
}

double MouthForm::dropped(double x, double z) const {
  const double s = std::abs(x) / half_width_;
  return s < 1 ? t_.expression.jaw_mm * (1 - s * s) * smoothstep(-10, 80, z) : 0;
}

Vec3 MouthForm::closed(Vec3 p) const {
  const double jaw = t_.expression.jaw_mm;
  if (jaw <= 0) return p;
  const double line = line_y(std::min(std::abs(p.x), half_width_)), below = line - p.y;
  if (below <= 0) return p;
  const double lip = dropped(p.x, p.z);
  if (below < lip) return {p.x, line, p.z};
  // Beside and below the lip the skin stretches until it has gone as far as the chin, then back on the neck.
  const double chin = jaw * smoothstep(-10, 80, p.z), gn = gnathion_y(t_) - jaw;
  return {p.x, p.y + mix(lip, chin, smoothstep(0, 34, below - lip)) * smoothstep(gn - 70, gn - 8, p.y), p.z};
}

double MouthForm::gape(Vec3 p) const {
  const double line = line_y(std::min(std::abs(p.x), half_width_)), lip = dropped(p.x, p.z);
  if (lip < 0.3) return 10;
  return std::max(
      {0.9 * (p.y - line), 0.9 * (line - lip - p.y), std::abs(p.x) - half_width_, front_ - 30 - p.z});
}

double MouthForm::add_to(double field, Vec3 p) const {
  const Vec3 q{std::abs(p.x), p.y, p.z};
  if (q.x > half_width_ + 12 || std::abs(q.y - sto_) > 24 || q.z < front_ - 36) return field;
  const double lips = join(upper_.distance(q), lower_.distance(q), 0.7);
  double d = join(field, lips, 4.2);
  d = cut(d, -line_.distance(q), 1.6);
  // The white roll that borders the vermilion.
  d -= 0.22 * gauss((q.y - upper_edge(q.x) - 0.5) / 0.8) * smoothstep(half_width_, half_width_ - 7, q.x);
  return d;
}

}  // namespace relievo::hal::sim
