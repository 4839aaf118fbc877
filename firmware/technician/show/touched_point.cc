// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/technician/show/touched_point.h"

#include <bit>
#include <cmath>

namespace relievo::firmware {
namespace {

void place(const pipeline::RectifiedPair& pair, ui::TechnicianPoint& point) {
  point.right_px = {point.left_px.x - point.disparity_px, point.left_px.y};
  point.left_x = point.left_px.x / static_cast<float>(pair.width_px);
  point.right_x = point.right_px.x / static_cast<float>(pair.width_px);
  point.y = point.left_px.y / static_cast<float>(pair.height_px);
}

// As RectifiedPair says it.
void reconstruct(const pipeline::RectifiedPair& pair, ui::TechnicianPoint& point) {
  const double z = pair.depth_mm(point.disparity_px);
  if (!std::isfinite(z) || z <= 0) return;
  const double across = (point.left_px.x - pair.left_centre_px.x) / pair.focal_px,
               down = (point.left_px.y - pair.left_centre_px.y) / pair.focal_px;
  const pipeline::Vec3d p =
      apply(transposed(pair.rectified_from_left), pipeline::Vec3d{across * z, down * z, z});
  point.at_mm = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
  const double slant = std::sqrt(1 + across * across + down * down);
  point.sigma_mm = static_cast<float>(z * z / (pair.focal_px * pair.baseline_mm) * point.sigma_px * slant);
}

}  // namespace

ui::TechnicianPoint nearest_match(const pipeline::RectifiedPair& pair, const pipeline::MatchSet& matches,
                                  const TechnicianFigures& figures, float x, float y) {
  ui::TechnicianPoint point = point_at(pair, x, y);
  const float reach = kFingerShare * static_cast<float>(pair.width_px);
  float best = reach * reach;
  const pipeline::Match* nearest = nullptr;
  for (const pipeline::Match& m : matches.matches) {
    const float dx = m.left_px.x - point.left_px.x, dy = m.left_px.y - point.left_px.y, d = dx * dx + dy * dy;
    if (d >= best) continue;
    best = d;
    nearest = &m;
  }
  if (nearest == nullptr) return point;
  set_match(pair, *nearest, point);
  const auto rule = static_cast<std::size_t>(std::countr_zero(nearest->rejected_by));
  if (nearest->rejected_by != 0)
    point.rejected_by = rule < figures.rule_count() ? std::string_view(figures.rule(rule)) : "?";
  return point;
}

ui::TechnicianPoint point_at(const pipeline::RectifiedPair& pair, float x, float y) {
  ui::TechnicianPoint point;
  point.touched = true;
  point.left_px = {pixel_at(x, pair.width_px), pixel_at(y, pair.height_px)};
  place(pair, point);
  return point;
}

void set_match(const pipeline::RectifiedPair& pair, const pipeline::Match& match,
               ui::TechnicianPoint& point) {
  point.matched = true;
  point.left_px = match.left_px;
  point.disparity_px = match.disparity_px;
  point.sigma_px = match.sigma_px;
  point.cost = match.cost;
  place(pair, point);
  reconstruct(pair, point);
}

}  // namespace relievo::firmware
