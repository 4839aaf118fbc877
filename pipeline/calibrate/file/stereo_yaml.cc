// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/file/stereo_yaml.h"

#include <algorithm>
#include <cstdio>
#include <span>

#include "pipeline/calibrate/file/calibration_fields.h"

namespace relievo::pipeline {
namespace {

constexpr FieldNames kLeftMatrix{"K1", "M1", "cameraMatrix1"};
constexpr FieldNames kRightMatrix{"K2", "M2", "cameraMatrix2"};
constexpr FieldNames kLeftDistortion{"D1", "distCoeffs1"};
constexpr FieldNames kRightDistortion{"D2", "distCoeffs2"};

Result<void> read_camera(const YamlFields& fields, const CalibrationHints& hints, const FieldNames& matrix,
                         const FieldNames& distortion, CameraIntrinsics& camera) {
  RELIEVO_TRY(read_size(fields, hints, camera));
  RELIEVO_TRY(read_camera_matrix(fields, matrix, camera));
  return read_distortion(fields, distortion, camera);
}

Result<void> read_relation(const YamlFields& fields, double unit_mm, RigidTransform& right_from_left) {
  RELIEVO_TRY_ASSIGN(const YamlMatrix* r, find_matrix(fields, {"R"}, 3, 3));
  std::copy(r->values.begin(), r->values.end(), right_from_left.rotation.m);
  const auto lying = fields.matrices.find("T");
  const bool one_row = lying != fields.matrices.end() && lying->second.rows == 1;
  RELIEVO_TRY_ASSIGN(const YamlMatrix* t, find_matrix(fields, {"T"}, one_row ? 1 : 3, one_row ? 3 : 1));
  right_from_left.translation_mm = {t->values[0] * unit_mm, t->values[1] * unit_mm, t->values[2] * unit_mm};
  return {};
}

double number_or_zero(const YamlFields& fields, std::string_view name) {
  const auto found = fields.numbers.find(name);
  return found == fields.numbers.end() ? 0 : found->second;
}

// No field: nobody knows. A number would be no words of ours.
Result<std::string> words_or_empty(const YamlFields& fields, std::string_view name) {
  if (fields.numbers.contains(name))
    return Error{Errc::InvalidInput, "a camera is named in words, not by a number alone"}.at(name);
  const auto found = fields.words.find(name);
  return found == fields.words.end() ? std::string() : found->second;
}

void append_words(std::string& text, const char* name, std::string_view words) {
  if (words.empty()) return;
  text += std::string(name) + ": \"";
  for (const char c : words) {
    if (c == '"' || c == '\\') text += '\\';
    text += c;
  }
  text += "\"\n";
}

void append_matrix(std::string& text, const char* name, int rows, int cols, std::span<const double> values) {
  char line[96];
  std::snprintf(line, sizeof line, "%s: !!opencv-matrix\n   rows: %d\n   cols: %d\n   dt: d\n   data: [",
                name, rows, cols);
  text += line;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const char* before = i == 0 ? " " : i % 3 == 0 ? ",\n       " : ", ";
    std::snprintf(line, sizeof line, "%s%.16e", before, values[i]);
    text += line;
  }
  text += " ]\n";
}

void append_camera(std::string& text, const CameraIntrinsics& c, const char* k_name, const char* d_name) {
  const double k[9] = {c.focal_px.x, 0, c.centre_px.x, 0, c.focal_px.y, c.centre_px.y, 0, 0, 1};
  append_matrix(text, k_name, 3, 3, k);
  append_matrix(text, d_name, 1, 5, c.distortion);
}

}  // namespace

bool has_stereo_cameras(const YamlFields& fields) { return holds(fields, kLeftMatrix); }
bool has_stereo_relation(const YamlFields& fields) { return holds(fields, {"R", "T"}); }

Result<StereoCalibration> read_stereo_yaml(const YamlFields& cameras, const YamlFields& relation,
                                           const CalibrationHints& hints) {
  StereoCalibration calibration;
  RELIEVO_TRY(read_camera(cameras, hints, kLeftMatrix, kLeftDistortion, calibration.left));
  RELIEVO_TRY(read_camera(cameras, hints, kRightMatrix, kRightDistortion, calibration.right));
  RELIEVO_TRY(read_relation(relation, hints.unit_mm > 0 ? hints.unit_mm : 1, calibration.right_from_left));
  calibration.rms_px = number_or_zero(cameras, "pair_rms_px");
  calibration.epipolar_shift_px = number_or_zero(cameras, "epipolar_shift_px");
  RELIEVO_TRY_ASSIGN(calibration.cameras.left, words_or_empty(cameras, "left_camera"));
  RELIEVO_TRY_ASSIGN(calibration.cameras.right, words_or_empty(cameras, "right_camera"));
  return calibration;
}

std::string calibration_text(const StereoCalibration& c) {
  // Everything that may be absent comes first: wherever the file is cut, a needed field is lost.
  char head[200];
  std::string text = "%YAML:1.0\n---\n";
  append_words(text, "left_camera", c.cameras.left);
  append_words(text, "right_camera", c.cameras.right);
  std::snprintf(head, sizeof head,
                "pair_rms_px: %.16e\nepipolar_shift_px: %.16e\nimage_width: %d\nimage_height: %d\n", c.rms_px,
                c.epipolar_shift_px, c.left.width_px, c.left.height_px);
  text += head;
  append_camera(text, c.left, "K1", "D1");
  append_camera(text, c.right, "K2", "D2");
  append_matrix(text, "R", 3, 3, c.right_from_left.rotation.m);
  const Vec3d& t = c.right_from_left.translation_mm;
  const double translation[3] = {t.x, t.y, t.z};
  append_matrix(text, "T", 3, 1, translation);
  return text;
}

}  // namespace relievo::pipeline
