// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/reconstruct/face_crop.h"

#include <algorithm>
#include <cmath>

namespace relievo::pipeline {
namespace {

constexpr double kMiddle = 0.25;     // of the face's width: 38 mm around the middle of the face hold every nose
constexpr double kNearest = 0.01;    // this share of the middle is the tip: a single stray point is not

}  // namespace

Result<void> FaceCropOptions::check() const {
  if (!(radius_mm > 0)) return Error{Errc::InvalidInput, "face: radius_mm must be positive"};
  return {};
}

Result<void> crop_to_face(PointCloud& cloud, const RectifiedPair& pair, const FaceCropOptions& options,
                          StageContext& context) {
  if (!(pair.face_width_px > 0)) return {};
  Arena::Mark mark(context.scratch);
  std::pmr::vector<Vec3f> middle(&context.scratch);
  middle.reserve(cloud.points.size());
  const double reach = kMiddle * pair.face_width_px;
  for (const CloudPoint& p : cloud.points)
    if (std::hypot(p.left_px.x - pair.face_centre_px.x, p.left_px.y - pair.face_centre_px.y) < reach) middle.push_back(p.at_mm);
  if (middle.size() < 50)
    return Error{Errc::NoFace, "nothing was measured in the middle of the face: more light, or nothing before the face"};
  const auto share = std::max<std::ptrdiff_t>(10, static_cast<std::ptrdiff_t>(kNearest * static_cast<double>(middle.size())));
  std::nth_element(middle.begin(), middle.begin() + share, middle.end(), [](const Vec3f& a, const Vec3f& b) { return a.z < b.z; });
  Vec3d tip;
  for (auto p = middle.begin(); p != middle.begin() + share; ++p) {
    tip.x += static_cast<double>(p->x) / static_cast<double>(share);
    tip.y += static_cast<double>(p->y) / static_cast<double>(share);
    tip.z += static_cast<double>(p->z) / static_cast<double>(share);
  }
  const auto outside = [&](const CloudPoint& p) {
    const double dx = p.at_mm.x - tip.x;
    const double dy = p.at_mm.y - tip.y;
    const double dz = p.at_mm.z - tip.z;
    return dx * dx + dy * dy + dz * dz > options.radius_mm * options.radius_mm;
  };
  cloud.points.erase(std::remove_if(cloud.points.begin(), cloud.points.end(), outside), cloud.points.end());
  return {};
}

}  // namespace relievo::pipeline
