// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory_resource>
#include <span>
#include <utility>

#include "pipeline/calibrate/file/calibration_fields.h"
#include "pipeline/match/rectify/rectifier.h"

namespace relievo::pipeline {
namespace {

constexpr double kMmPerMetre = 1000;
constexpr double kSame = 1e-5;  // of numbers written with a few decimals

struct CameraInfo {
  CameraIntrinsics camera;
  Rotation rectified_from_camera;
  double focal_px = 0;  // of the projection
  double offset = 0;    // minus the distance from the left camera along the rows, metres
};

Result<void> read_model(const YamlFields& fields) {
  const auto model = fields.words.find("distortion_model");
  if (model == fields.words.end())
    return wrong("this field is missing; the file is damaged or no camera_info", "distortion_model");
  if (model->second != "plumb_bob" && model->second != "rational_polynomial")
    return Error{Errc::Unsupported, "this lens model is not known here; calibrate with plumb_bob"}.at(
        "distortion_model");
  return {};
}

Result<void> read_projection(const YamlFields& fields, CameraInfo& info) {
  RELIEVO_TRY_ASSIGN(const YamlMatrix* matrix, find_matrix(fields, {"projection_matrix"}, 3, 4));
  const auto& p = matrix->values;
  const bool form = p[1] == 0 && p[4] == 0 && p[8] == 0 && p[9] == 0 && p[10] == 1 && p[11] == 0 && p[0] > 0;
  if (!form || std::abs(p[5] - p[0]) > kSame * p[0])
    return wrong("must be [f 0 cx Tx; 0 f cy 0; 0 0 1 0]: give the files of a stereo calibration",
                 "projection_matrix");
  if (p[7] != 0)
    return wrong("the cameras stand above each other; only cameras side by side are measured with",
                 "projection_matrix");
  info.focal_px = p[0];
  info.offset = p[3] / p[0];
  return {};
}

Result<CameraInfo> read_info(const YamlFields& fields, const CalibrationHints& hints) {
  CameraInfo info;
  RELIEVO_TRY(read_size(fields, hints, info.camera));
  RELIEVO_TRY(read_camera_matrix(fields, {"camera_matrix"}, info.camera));
  RELIEVO_TRY(read_model(fields));
  RELIEVO_TRY(read_distortion(fields, {"distortion_coefficients"}, info.camera));
  RELIEVO_TRY_ASSIGN(const YamlMatrix* r, find_matrix(fields, {"rectification_matrix"}, 3, 3));
  std::ranges::copy(r->values, info.rectified_from_camera.m);
  RELIEVO_TRY(read_projection(fields, info));
  return info;
}

void append(std::string& text, const char* name, int rows, int cols, std::span<const double> values) {
  char word[64];
  std::snprintf(word, sizeof word, "%s:\n  rows: %d\n  cols: %d\n  data: [", name, rows, cols);
  text += word;
  for (std::size_t i = 0; i < values.size(); ++i) {
    std::snprintf(word, sizeof word, i == 0 ? "%.17g" : ", %.17g", values[i]);
    text += word;
  }
  text += "]\n";
}

struct Eye {
  const char* name = "";
  const CameraIntrinsics& camera;
  const Rotation& rectified_from_camera;
  Vec2d centre_px;         // of the rectified picture
  double baseline_mm = 0;  // from the left camera to this one
};

std::string text_of(const Eye& eye, double focal_px) {
  const CameraIntrinsics& c = eye.camera;
  char head[128];
  std::snprintf(head, sizeof head, "image_width: %d\nimage_height: %d\ncamera_name: %s\n", c.width_px,
                c.height_px, eye.name);
  std::string text = head;
  const double k[9] = {c.focal_px.x, 0, c.centre_px.x, 0, c.focal_px.y, c.centre_px.y, 0, 0, 1};
  append(text, "camera_matrix", 3, 3, k);
  text += "distortion_model: plumb_bob\n";
  append(text, "distortion_coefficients", 1, 5, c.distortion);
  append(text, "rectification_matrix", 3, 3, eye.rectified_from_camera.m);
  const double shift = eye.baseline_mm == 0 ? 0 : -focal_px * eye.baseline_mm / kMmPerMetre;
  const double p[12] = {focal_px, 0, eye.centre_px.x, shift, 0, focal_px, eye.centre_px.y, 0, 0, 0, 1, 0};
  append(text, "projection_matrix", 3, 4, p);
  return text;
}

}  // namespace

bool is_camera_info(const YamlFields& fields) {
  return holds(fields, {"camera_matrix", "projection_matrix", "rectification_matrix"});
}

Result<StereoCalibration> read_camera_infos(const YamlFields& one, const YamlFields& other,
                                            const CalibrationHints& hints) {
  RELIEVO_TRY_ASSIGN(CameraInfo left, read_info(one, hints));
  RELIEVO_TRY_ASSIGN(CameraInfo right, read_info(other, hints));
  if (left.offset != 0) std::swap(left, right);
  if (left.offset != 0 || right.offset == 0)
    return wrong(
        "one camera must stand at the origin and one beside it: give left and right of one stereo calibration",
        "projection_matrix");
  if (std::abs(left.focal_px - right.focal_px) > kSame * left.focal_px)
    return wrong("left and right are rectified to different focal lengths: they are not of one calibration",
                 "projection_matrix");
  if (left.camera.width_px != right.camera.width_px || left.camera.height_px != right.camera.height_px)
    return wrong("left and right have pictures of different sizes; both cameras must be of one kind",
                 "image_width");
  for (const CameraInfo* info : {&left, &right})
    RELIEVO_TRY(check_rotation(info->rectified_from_camera, "rectification_matrix"));
  StereoCalibration calibration;
  calibration.left = left.camera;
  calibration.right = right.camera;
  const Rotation back = transposed(right.rectified_from_camera);
  calibration.right_from_left.rotation = product(back, left.rectified_from_camera);
  const double unit_mm = hints.unit_mm > 0 ? hints.unit_mm : kMmPerMetre;
  calibration.right_from_left.translation_mm = apply(back, {right.offset * unit_mm, 0, 0});
  return calibration;
}

Result<CameraInfoTexts> camera_info_texts(const StereoCalibration& calibration) {
  RELIEVO_TRY(check_calibration(calibration));
  RectifiedPair pair(std::pmr::null_memory_resource());  // geometry only
  RectifierOptions any_size;
  any_size.longest_side_px = 1 << 20;  // nothing is resampled here
  RELIEVO_TRY(lay_windows(calibration, any_size, pair));
  // The windows' middles, in pictures of the cameras' own size; the rows are common to both.
  const double y = pair.left_centre_px.y - 0.5 * (pair.height_px - calibration.left.height_px);
  const auto centred = [&](const Vec2d& centre, const CameraIntrinsics& camera) {
    return Vec2d{centre.x - 0.5 * (pair.width_px - camera.width_px), y};
  };
  const Eye left{"left", calibration.left, pair.rectified_from_left,
                 centred(pair.left_centre_px, calibration.left), 0};
  const Eye right{"right", calibration.right, pair.rectified_from_right,
                  centred(pair.right_centre_px, calibration.right), pair.baseline_mm};
  return CameraInfoTexts{text_of(left, pair.focal_px), text_of(right, pair.focal_px)};
}

}  // namespace relievo::pipeline
