// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "pipeline/calibrate/file/calibration_fields.h"

namespace relievo::pipeline {
namespace {

constexpr int kMinSidePx = 16;
constexpr int kMaxSidePx = 8192;
// 0.2: a view of 136 degrees; 50: the lens of a telescope. Faces are taken with 1 to 4.
constexpr double kMinFocalPerSide = 0.2;
constexpr double kMaxFocalPerSide = 50;
constexpr double kMaxCoefficient = 1e4;
constexpr double kMaxTangential = 0.2;
constexpr double kRotationTolerance = 1e-5;
constexpr double kMinBaselineMm = 1;
constexpr double kMaxBaselineMm = 10'000;

// Distorted radius over undistorted radius must rise up to the middle of the farther edge, or two
// rays share one pixel. (The corners may be extrapolated; no face is there.)
bool unfolded(const CameraIntrinsics& camera) {
  const double* k = camera.distortion;
  const double edge_x =
      std::max(camera.centre_px.x, camera.width_px - camera.centre_px.x) / camera.focal_px.x;
  const double edge_y =
      std::max(camera.centre_px.y, camera.height_px - camera.centre_px.y) / camera.focal_px.y;
  const double edge = std::max(edge_x, edge_y);
  constexpr int kSteps = 2000;
  for (int i = 1; i <= kSteps; ++i) {
    const double r = 2 * edge * i / kSteps;
    const double r2 = r * r;
    const double distorted = r * (1 + r2 * (k[0] + r2 * (k[1] + r2 * k[4])));
    const double slope = 1 + r2 * (3 * k[0] + r2 * (5 * k[1] + r2 * 7 * k[4]));
    if (slope <= 0.05) return false;
    if (distorted >= edge) return true;
  }
  return false;
}

Result<void> check_camera(const CameraIntrinsics& c, const char* matrix, const char* distortion) {
  if (c.width_px < kMinSidePx || c.height_px < kMinSidePx || c.width_px > kMaxSidePx ||
      c.height_px > kMaxSidePx)
    return wrong("pictures must have 16 to 8192 pixels a side", "image_width, image_height");
  const double side = std::max(c.width_px, c.height_px);
  for (const double f : {c.focal_px.x, c.focal_px.y})
    if (!(f >= kMinFocalPerSide * side && f <= kMaxFocalPerSide * side))
      return wrong("the focal length does not fit the picture size; calibrate again", matrix);
  if (!(c.focal_px.x < 2 * c.focal_px.y && c.focal_px.y < 2 * c.focal_px.x))
    return wrong("the two focal lengths differ by more than a factor of two; calibrate again", matrix);
  if (!(std::abs(c.centre_px.x - 0.5 * c.width_px) <= c.width_px) ||
      !(std::abs(c.centre_px.y - 0.5 * c.height_px) <= c.height_px))
    return wrong("the principal point lies far outside the picture; calibrate again", matrix);
  for (const double k : c.distortion)
    if (!(std::abs(k) <= kMaxCoefficient))
      return wrong("a distortion coefficient is beyond any lens; calibrate again", distortion);
  if (std::abs(c.distortion[2]) > kMaxTangential || std::abs(c.distortion[3]) > kMaxTangential)
    return wrong("the tangential distortion is beyond any lens; calibrate again", distortion);
  if (!unfolded(c))
    return wrong("the distortion folds the picture over before its edge; calibrate again", distortion);
  return {};
}

bool are_words(const std::string& text) {
  return text.size() <= kMaxCameraWords &&
         std::ranges::all_of(text, [](char c) { return c >= ' ' && c <= '~'; });
}

}  // namespace

Result<void> check_rotation(const Rotation& r, std::string_view name) {
  const double* m = r.m;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) {
      const double dot = m[3 * i] * m[3 * j] + m[3 * i + 1] * m[3 * j + 1] + m[3 * i + 2] * m[3 * j + 2];
      if (!(std::abs(dot - (i == j ? 1 : 0)) <= kRotationTolerance))
        return wrong("the matrix is no rotation; the file is damaged, calibrate again", name);
    }
  const double determinant = m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) +
                             m[2] * (m[3] * m[7] - m[4] * m[6]);
  if (!(determinant > 0)) return wrong("the matrix mirrors; the file is damaged, calibrate again", name);
  if (!(m[8] > 0)) return wrong("the cameras look away from each other; calibrate again", name);
  return {};
}

Result<void> check_calibration(const StereoCalibration& calibration) {
  RELIEVO_TRY(check_camera(calibration.left, "K1", "D1"));
  RELIEVO_TRY(check_camera(calibration.right, "K2", "D2"));
  RELIEVO_TRY(check_rotation(calibration.right_from_left.rotation, "R"));
  const Vec3d t = calibration.right_from_left.translation_mm;
  const double baseline = std::sqrt(t.x * t.x + t.y * t.y + t.z * t.z);
  if (!(baseline >= kMinBaselineMm && baseline <= kMaxBaselineMm))
    return wrong("the cameras must stand 1 mm to 10 m apart; is the file in millimetres?", "T");
  const Vec3d right = inverse(calibration.right_from_left).translation_mm;
  // Above or below: sensors that lie on their side, for a field of view higher than wide.
  if (std::hypot(right.x, right.y) < 0.5 * baseline)
    return wrong("the cameras must stand beside each other, not behind", "T");
  if (right.x < 0 && -right.x >= std::abs(right.y))
    return wrong("the right camera stands left of the left one; exchange the two", "T");
  if (!(calibration.rms_px >= 0 && calibration.rms_px < 1000)) return wrong("no possible rms", "pair_rms_px");
  if (!(calibration.epipolar_shift_px >= 0 && calibration.epipolar_shift_px < 1000))
    return wrong("no possible shift", "epipolar_shift_px");
  if (!are_words(calibration.cameras.left))
    return wrong("no possible name of a camera; calibrate again", "left_camera");
  if (!are_words(calibration.cameras.right))
    return wrong("no possible name of a camera; calibrate again", "right_camera");
  return {};
}

}  // namespace relievo::pipeline
