// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/technician/show/surface_difference.h"

#include <algorithm>
#include <cmath>

#include "firmware/base/budget.h"
#include "firmware/checks/deviation_picture.h"
#include "firmware/measure/match_figures.h"
#include "hal/base/statistics.h"

namespace relievo::firmware {
namespace {

constexpr int kSide = budget::kTechnicianPictureSidePx;
constexpr int kColours = 256;  // of the texture: the first is of what is not known, the second like the third

float texel_of(float share) {
  const float at =
      std::isnan(share) ? 0 : 2 + std::round((kColours - 3) * (std::clamp(share, -1.0F, 1.0F) + 1) / 2);
  return (at + 0.5F) / kColours;
}

}  // namespace

compare::DisparityMap depths_of(const pipeline::RectifiedPair& pair, const pipeline::FaceMesh& mesh) {
  compare::DisparityMap map = compare::model_view(pair, mesh);
  for (float& d : map.values)
    if (!std::isnan(d)) d = float(pair.depth_mm(double(d)));
  return map;
}

void draw_nearer(const pipeline::RectifiedPair& pair, const std::function<float(int x, int y)>& nearer_mm,
                 float full_colour_mm, StageCanvas& canvas) {
  draw_photograph(pair, 0.5, canvas);
  paint(pair, canvas, [&](int x, int y) -> std::optional<std::array<std::uint8_t, 3>> {
    const float nearer = nearer_mm(x, y);
    if (std::isnan(nearer)) return std::nullopt;
    return deviation_colour(double(nearer / full_colour_mm));
  });
}

std::span<const std::array<std::uint8_t, 3>> difference_scale() {
  static const auto kScale = [] {
    std::array<std::array<std::uint8_t, 3>, 21> scale;
    for (std::size_t i = 0; i < scale.size(); ++i)
      scale[i] = deviation_colour(2 * double(i) / (scale.size() - 1) - 1);
    return scale;
  }();
  return kScale;
}

void SurfaceDifference::measure(const pipeline::RectifiedPair& pair, const pipeline::FaceMesh& surface,
                                const compare::DisparityMap& other, std::uint32_t number) {
  forget();
  nearer_ = depths_of(pair, surface);
  if (nearer_.values.size() != other.values.size()) return forget();
  std::vector<float> known;
  for (std::size_t i = 0; i < nearer_.values.size(); ++i) {
    nearer_.values[i] = other.values[i] - nearer_.values[i];
    if (!std::isnan(nearer_.values[i])) known.push_back(nearer_.values[i]);
  }
  if (known.empty()) return;
  figures_.known = true;
  figures_.number = number;
  figures_.median_mm = float(percentile(known, 0.5));
  for (float& d : known) d = std::abs(d);
  figures_.most_mm = float(percentile(known, 0.95));
}

void SurfaceDifference::draw(const pipeline::RectifiedPair& pair, const pipeline::FaceMesh& surface,
                             float full_colour_mm) {
  rgb_.assign(std::size_t{3} * kSide * kSide, 0);
  StageCanvas canvas(rgb_.data(), kSide);
  draw_nearer(
      pair, [this](int x, int y) { return nearer_mm(x, y); }, full_colour_mm, canvas);
  figures_.map = {
      {reinterpret_cast<const std::byte*>(rgb_.data()), kSide, kSide, 3 * kSide, PixelFormat::Rgb8},
      figures_.number};
  colours_.width_px = kColours, colours_.height_px = 1;
  colours_.rgb.assign(std::size_t{3} * kColours, 128);
  for (int i = 1; i < kColours; ++i)
    std::ranges::copy(deviation_colour(2.0 * (std::max(i, 2) - 2) / (kColours - 3) - 1),
                      colours_.rgb.begin() + 3 * i);
  std::vector<float> share(surface.vertices_mm.size());
  for (std::size_t i = 0; i < share.size(); ++i) {
    const auto& v = surface.vertices_mm[i];
    const auto p = apply(pair.rectified_from_left, pipeline::Vec3d{v.x, v.y, v.z});
    share[i] = nearer_mm(int(std::lround(pair.left_centre_px.x + pair.focal_px * p.x / p.z)),
                         int(std::lround(pair.left_centre_px.y + pair.focal_px * p.y / p.z))) /
               full_colour_mm;
  }
  // Between a known and an unknown corner lies no colour of the scale.
  colours_.uv.clear();
  for (const auto& t : surface.triangles) {
    const float sum = share[t[0]] + share[t[1]] + share[t[2]];
    for (const std::uint32_t at : t)
      colours_.uv.push_back({texel_of(std::isnan(sum) ? sum : share[at]), 0.5F});
  }
}

ui::TechnicianDifference SurfaceDifference::view() const {
  ui::TechnicianDifference view = figures_;
  view.colours = colours_.uv.empty() ? nullptr : &colours_;
  return view;
}

}  // namespace relievo::firmware
