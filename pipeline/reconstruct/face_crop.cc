// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/reconstruct/face_crop.h"

#include <algorithm>

#include "pipeline/match/region/face_reach.h"

namespace relievo::pipeline {
Result<void> crop_to_face(PointCloud& cloud, const RectifiedPair& pair, const FaceCropOptions& options,
                          StageContext& context) {
  if (!(pair.face_width_px > 0)) return {};
  Arena::Mark mark(context.scratch);
  std::pmr::vector<Vec3d> middle(&context.scratch);
  middle.reserve(cloud.points.size());
  for (const CloudPoint& p : cloud.points)
    if (may_be_nose(pair, double(p.left_px.x), double(p.left_px.y)))
      middle.push_back({double(p.at_mm.x), double(p.at_mm.y), double(p.at_mm.z)});
  if (middle.size() < 50)
    return Error{Errc::NoFace,
                 "nothing was measured in the middle of the face: more light, or nothing before the face"};
  const Vec3d tip = outstanding_tip(middle);
  const auto outside = [&](const CloudPoint& p) {
    const double dx = p.at_mm.x - tip.x;
    const double dy = p.at_mm.y - tip.y;
    const double dz = p.at_mm.z - tip.z;
    return dx * dx + dy * dy + dz * dz > options.radius_mm * options.radius_mm;
  };
  std::erase_if(cloud.points, outside);
  return {};
}

}  // namespace relievo::pipeline
