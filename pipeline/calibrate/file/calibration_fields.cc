// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/file/calibration_fields.h"

#include <algorithm>
#include <cmath>

namespace relievo::pipeline {
namespace {

Result<int> whole_number(const YamlFields& fields, std::string_view name) {
  const auto found = fields.numbers.find(name);
  if (found == fields.numbers.end())
    return wrong("this field is missing or no number; the file is damaged or no calibration", name);
  const double number = found->second;
  if (!(number >= 1 && number <= 1e6) || number != std::floor(number))
    return wrong("must be a whole number of pixels", name);
  return int(number);
}

Result<const YamlMatrix*> find_any(const YamlFields& fields, const FieldNames& names) {
  const YamlMatrix* found = nullptr;
  for (const std::string_view name : names) {
    const auto at = fields.matrices.find(name);
    if (at == fields.matrices.end()) continue;
    if (found != nullptr) return wrong("this matrix is there twice, under two names; mend the file", name);
    found = &at->second;
  }
  if (found == nullptr)
    return wrong("this matrix is missing; the file is damaged or no stereo calibration", names.front());
  return found;
}

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

bool holds(const YamlFields& fields, const FieldNames& names) {
  return std::ranges::any_of(names, [&](std::string_view name) { return fields.matrices.contains(name); });
}

Result<const YamlMatrix*> find_matrix(const YamlFields& fields, const FieldNames& names, int rows, int cols) {
  RELIEVO_TRY_ASSIGN(const YamlMatrix* found, find_any(fields, names));
  if (found->rows != rows || found->cols != cols)
    return wrong("this matrix has the wrong size for a stereo calibration", names.front());
  return found;
}

Result<void> read_size(const YamlFields& fields, const CalibrationHints& hints, CameraIntrinsics& camera) {
  const bool silent = !fields.numbers.contains("image_width") && !fields.numbers.contains("image_height") &&
                      !fields.words.contains("image_width") && !fields.words.contains("image_height");
  if (silent && hints.width_px > 0) {
    camera.width_px = hints.width_px;
    camera.height_px = hints.height_px;
    return {};
  }
  if (silent)
    return wrong("the file does not say how large the pictures are: import it with --image-size WIDTHxHEIGHT",
                 "image_width, image_height");
  RELIEVO_TRY_ASSIGN(camera.width_px, whole_number(fields, "image_width"));
  RELIEVO_TRY_ASSIGN(camera.height_px, whole_number(fields, "image_height"));
  return {};
}

// A lens sits within a few hundredths of the picture before the sensor's middle; a picture of another
// size than the calibrated one puts it elsewhere.
Result<void> check_hinted_size(const CameraIntrinsics& camera, std::string_view name) {
  constexpr double kOffCentre = 0.125;
  if (std::abs(camera.centre_px.x / camera.width_px - 0.5) > kOffCentre ||
      std::abs(camera.centre_px.y / camera.height_px - 0.5) > kOffCentre)
    return wrong("the principal point does not fit pictures of this size; is the calibration for other ones?",
                 name);
  return {};
}

Result<void> read_camera_matrix(const YamlFields& fields, const FieldNames& names, CameraIntrinsics& camera) {
  RELIEVO_TRY_ASSIGN(const YamlMatrix* k, find_matrix(fields, names, 3, 3));
  const auto& v = k->values;
  if (v[1] != 0 || v[3] != 0 || v[6] != 0 || v[7] != 0 || v[8] != 1)
    return wrong("must be [fx 0 cx; 0 fy cy; 0 0 1]", names.front());
  camera.focal_px = {v[0], v[4]};
  camera.centre_px = {v[2], v[5]};
  return {};
}

Result<void> read_distortion(const YamlFields& fields, const FieldNames& names, CameraIntrinsics& camera) {
  RELIEVO_TRY_ASSIGN(const YamlMatrix* d, find_any(fields, names));
  const auto& v = d->values;
  if ((d->rows != 1 && d->cols != 1) ||
      (v.size() != 4 && v.size() != 5 && v.size() != 8 && v.size() != 12 && v.size() != 14))
    return wrong("distortion must be k1 k2 p1 p2 and perhaps k3", names.front());
  for (std::size_t i = 5; i < v.size(); ++i)
    if (v[i] != 0)
      return Error{Errc::Unsupported, "more than five distortion coefficients; calibrate with k1 k2 p1 p2 k3"}
          .at(names.front());
  for (std::size_t i = 0; i < 5; ++i) camera.distortion[i] = i < v.size() ? v[i] : 0;
  return {};
}

Result<void> check_rotation(const Rotation& r, std::string_view name) {
  const double* m = r.m;
  const Rotation still = product(r, transposed(r));
  for (int i = 0; i < 9; ++i)
    if (!(std::abs(still.m[i] - (i % 4 == 0 ? 1 : 0)) <= kRotationTolerance))
      return wrong("the matrix is no rotation; the file is damaged, calibrate again", name);
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
