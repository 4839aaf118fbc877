// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/reconstruct/face_crop.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "hal/base/statistics.h"
#include "pipeline/match/region/face_reach.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

constexpr double kFurthestFromMostMm = 150;  // also of a head that is turned away

}  // namespace

Result<void> crop_to_face(PointCloud& cloud, const RectifiedPair& pair, const FaceCropOptions& options,
                          StageContext& context) {
  if (!(pair.face_width_px > 0)) return {};
  Arena::Mark mark(context.scratch);
  std::pmr::vector<Vec3d> middle(&context.scratch);
  middle.reserve(cloud.points.size());
  for (const CloudPoint& p : cloud.points)
    if (may_be_nose(pair, double(p.left_px.x), double(p.left_px.y))) middle.push_back(wide(p.at_mm));
  if (middle.size() < 50)
    return Error{Errc::NoFace,
                 "nothing was measured in the middle of the face: more light, or nothing before the face"};
  // A window finds false partners by the thousand: what lies far from most of it is none of the face.
  std::pmr::vector<double> depths(&context.scratch);
  depths.reserve(middle.size());
  for (const Vec3d& p : middle) depths.push_back(p.z);
  const double most = median(depths);
  const auto strays = std::partition(middle.begin(), middle.end(), [&](const Vec3d& p) {
    return std::abs(p.z - most) < kFurthestFromMostMm;
  });
  const Vec3d tip = outstanding_tip(std::span(middle.begin(), strays));
  std::erase_if(cloud.points, [&](const CloudPoint& p) {
    return squared_distance(wide(p.at_mm), tip) > options.radius_mm * options.radius_mm;
  });
  return {};
}

}  // namespace relievo::pipeline
