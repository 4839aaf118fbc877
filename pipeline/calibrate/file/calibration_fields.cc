// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/file/calibration_fields.h"

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
  for (const std::string_view name : {names.usual, names.second, names.third}) {
    const auto at = fields.matrices.find(name);
    if (at == fields.matrices.end()) continue;
    if (found != nullptr) return wrong("this matrix is there twice, under two names; mend the file", name);
    found = &at->second;
  }
  if (found == nullptr)
    return wrong("this matrix is missing; the file is damaged or no stereo calibration", names.usual);
  return found;
}

}  // namespace

bool holds(const YamlFields& fields, const FieldNames& names) {
  for (const std::string_view name : {names.usual, names.second, names.third})
    if (fields.matrices.contains(name)) return true;
  return false;
}

Result<const YamlMatrix*> find_matrix(const YamlFields& fields, const FieldNames& names, int rows, int cols) {
  RELIEVO_TRY_ASSIGN(const YamlMatrix* found, find_any(fields, names));
  if (found->rows != rows || found->cols != cols)
    return wrong("this matrix has the wrong size for a stereo calibration", names.usual);
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
    return wrong("must be [fx 0 cx; 0 fy cy; 0 0 1]", names.usual);
  camera.focal_px = {v[0], v[4]};
  camera.centre_px = {v[2], v[5]};
  return {};
}

Result<void> read_distortion(const YamlFields& fields, const FieldNames& names, CameraIntrinsics& camera) {
  RELIEVO_TRY_ASSIGN(const YamlMatrix* d, find_any(fields, names));
  const auto& v = d->values;
  if ((d->rows != 1 && d->cols != 1) ||
      (v.size() != 4 && v.size() != 5 && v.size() != 8 && v.size() != 12 && v.size() != 14))
    return wrong("distortion must be k1 k2 p1 p2 and perhaps k3", names.usual);
  for (std::size_t i = 5; i < v.size(); ++i)
    if (v[i] != 0)
      return Error{Errc::Unsupported, "more than five distortion coefficients; calibrate with k1 k2 p1 p2 k3"}
          .at(names.usual);
  for (std::size_t i = 0; i < 5; ++i) camera.distortion[i] = i < v.size() ? v[i] : 0;
  return {};
}

}  // namespace relievo::pipeline
