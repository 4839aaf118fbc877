// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/technician/show/hand_change.h"

#include <string.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "firmware/measure/self_agreement.h"

namespace relievo::firmware {
namespace {

constexpr float kLeastFullColourMm = 0.5F;

void wipe(compare::DisparityMap& map) {
  if (!map.values.empty()) explicit_bzero(map.values.data(), map.values.size() * sizeof(float));
  map = {};
}

compare::DisparityMap depths(const pipeline::RectifiedPair& pair, const pipeline::FaceMesh& mesh) {
  compare::DisparityMap map = compare::model_view(pair, mesh);
  for (float& d : map.values)
    if (!std::isnan(d)) d = static_cast<float>(pair.depth_mm(static_cast<double>(d)));
  return map;
}

}  // namespace

void HandChange::forget() {
  wipe(before_);
  wipe(now_);
  set_.clear();
  figures_ = {};
}

void HandChange::before(const pipeline::AlgorithmSet& set, const pipeline::RectifiedPair& pair,
                        const pipeline::FaceMesh& mesh) {
  wipe(before_);
  before_ = depths(pair, mesh);
  set_ = set.to_text();
}

void HandChange::measure(const Making& making, const Products& products) {
  figures_ = {};
  wipe(now_);
  if (!products.pair || !products.model) return;
  const pipeline::RectifiedPair& pair = *products.pair;
  if (making.by_hand.empty()) return before(making.set, pair, products.model->mesh);
  if (!has_before(making.set)) return;
  now_ = depths(pair, products.model->mesh);
  if (before_.values.size() != now_.values.size()) return;
  figures_.known = true;
  const auto focal = static_cast<float>(pair.focal_px);
  for (int y = 0; y < now_.height_px; ++y)
    for (int x = 0; x < now_.width_px; ++x) {
      if (!now_.known(x, y)) continue;
      const float pixel_mm = now_.at(x, y) / focal, nearer = nearer_mm(x, y);
      if (!before_.known(x, y)) figures_.new_mm2 += pixel_mm * pixel_mm;
      if (!(std::abs(nearer) > ui::kMovedMm)) continue;
      figures_.moved_mm2 += pixel_mm * pixel_mm;
      if (std::abs(nearer) > std::abs(figures_.farthest_mm)) figures_.farthest_mm = nearer;
    }
  figures_.full_colour_mm = std::max(kLeastFullColourMm, std::abs(figures_.farthest_mm));
}

float HandChange::nearer_mm(int x, int y) const {
  const bool both = figures_.known && now_.holds(x, y) && now_.known(x, y) && before_.known(x, y);
  return both ? before_.at(x, y) - now_.at(x, y) : std::numeric_limits<float>::quiet_NaN();
}

void HandChange::tell(std::span<ui::TechnicianPoint> points) const {
  if (!figures_.known) return;
  for (ui::TechnicianPoint& point : points) {
    const int x = static_cast<int>(std::lround(point.left_px.x)),
              y = static_cast<int>(std::lround(point.left_px.y));
    point.moved_mm = nearer_mm(x, y);
    point.new_surface = now_.holds(x, y) && now_.known(x, y) && !before_.known(x, y);
  }
}

}  // namespace relievo::firmware
