// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// HeadChart: a head laid flat, as a camera at its back would see the skin of the face from inside: directions
// from a point 220 mm behind the tip of the nose on an azimuthal equidistant map (Snyder 1987) about the way
// the face looks. Columns run to the person's right, rows down. From there a face is seen about at right
// angles, wherever cameras stood and however it was turned: what they did not see has its full width, and the
// face's other side is the map read backwards. Thread: any.
#pragma once

#include <cmath>

#include "pipeline/model/vector3.h"

namespace relievo::pipeline {

struct HeadChart {
  // In the head's frame (head_frame.h): above the tip of the nose, so that its underside and the chin's are
  // seen, too.
  static constexpr Vec3d kCentreMm{0, 10, -220};
  static constexpr double kRadiusMm = 210;  // about the skin's: turns angles into the map's millimetres

  explicit HeadChart(const RigidTransform& head_from_camera)
      : head_from_axes(head_from_camera.rotation), centre_mm(apply(inverse(head_from_camera), kCentreMm)) {}

  // Points run from the centre, along the left camera's axes.
  Vec3d in_head(const Vec3f& from_centre) const {
    return plus(apply(head_from_axes, wide(from_centre)), kCentreMm);
  }
  // Millimetres on the map. The direction straight backwards has no place.
  Vec2d place(const Vec3f& from_centre) const {
    return place_in_head(apply(head_from_axes, wide(from_centre)));
  }
  // The same from the centre along the head's own axes.
  static Vec2d place_in_head(const Vec3d& from_centre) {
    const double aside = std::hypot(from_centre.x, from_centre.y);
    const double scale = aside > 1e-9 ? kRadiusMm * std::atan2(aside, from_centre.z) / aside : 0;
    return {-from_centre.x * scale, -from_centre.y * scale};
  }
  Vec3f at(const Vec2d& place, double radius_mm) const {
    const double angle = std::hypot(place.x, place.y) / kRadiusMm;
    const double scale =
        angle > 1e-9 ? radius_mm * std::sin(angle) / (angle * kRadiusMm) : radius_mm / kRadiusMm;
    return narrow(apply(transposed(head_from_axes),
                        Vec3d{-place.x * scale, -place.y * scale, radius_mm * std::cos(angle)}));
  }

  Rotation head_from_axes;  // of the left camera
  Vec3d centre_mm;          // in the left camera's frame
};

// The outline that every face is cut to, a closed curve in the head's frame: where an ellipsoid around the
// tip of the nose meets the skin, along the hairline and before the ears, and along the jaw below the chin,
// whose height follows the person's and what was seen of it. Elsewhere it knows nothing of where a picture's
// measurements end: what they do not reach is left to the edge of what was measured. Thread: any.
struct FaceOutline {
  HeadChart chart;
  double below_mm = 92;  // of the tip of the nose, on the plane of symmetry; so much where no chin is found

  // How far inside the curve a point lies, about in mm near it; negative outside.
  float depth_mm(const Vec3f& from_chart_centre_mm) const;
};

}  // namespace relievo::pipeline
