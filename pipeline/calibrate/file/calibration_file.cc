// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/file/calibration_file.h"

#include <algorithm>
#include <cstdio>
#include <iomanip>
#include <span>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>

#include "hal/base/whole_file.h"
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
  std::ranges::copy(r->values, right_from_left.rotation.m);
  const auto lying = fields.matrices.find("T");
  const bool one_row = lying != fields.matrices.end() && lying->second.rows == 1;
  RELIEVO_TRY_ASSIGN(const YamlMatrix* t, find_matrix(fields, {"T"}, one_row ? 1 : 3, one_row ? 3 : 1));
  right_from_left.translation_mm = {t->values[0] * unit_mm, t->values[1] * unit_mm, t->values[2] * unit_mm};
  return {};
}

// No field: nobody knows. Words would be no number of ours ("0,02").
Result<double> number_or_zero(const YamlFields& fields, std::string_view name) {
  if (fields.words.contains(name))
    return wrong("this field is missing or no number; the file is damaged or no calibration", name);
  const auto found = fields.numbers.find(name);
  return found == fields.numbers.end() ? 0.0 : found->second;
}

// No field: nobody knows. A number would be no words of ours.
Result<std::string> words_or_empty(const YamlFields& fields, std::string_view name) {
  if (fields.numbers.contains(name))
    return Error{Errc::InvalidInput, "a camera is named in words, not by a number alone"}.at(name);
  const auto found = fields.words.find(name);
  return found == fields.words.end() ? std::string() : found->second;
}

void append_words(std::string& text, const char* name, std::string_view words) {
  if (!words.empty()) text += (std::ostringstream() << name << ": " << std::quoted(words) << '\n').str();
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

bool has_stereo_cameras(const YamlFields& fields) { return holds(fields, kLeftMatrix); }
bool has_stereo_relation(const YamlFields& fields) { return holds(fields, {"R", "T"}); }

// The same fields twice where one document holds both. Not yet checked.
Result<StereoCalibration> read_stereo_yaml(const YamlFields& cameras, const YamlFields& relation,
                                           const CalibrationHints& hints) {
  StereoCalibration calibration;
  RELIEVO_TRY(read_camera(cameras, hints, kLeftMatrix, kLeftDistortion, calibration.left));
  RELIEVO_TRY(read_camera(cameras, hints, kRightMatrix, kRightDistortion, calibration.right));
  RELIEVO_TRY(read_relation(relation, hints.unit_mm > 0 ? hints.unit_mm : 1, calibration.right_from_left));
  RELIEVO_TRY_ASSIGN(calibration.rms_px, number_or_zero(cameras, "pair_rms_px"));
  RELIEVO_TRY_ASSIGN(calibration.epipolar_shift_px, number_or_zero(cameras, "epipolar_shift_px"));
  RELIEVO_TRY_ASSIGN(calibration.cameras.left, words_or_empty(cameras, "left_camera"));
  RELIEVO_TRY_ASSIGN(calibration.cameras.right, words_or_empty(cameras, "right_camera"));
  return calibration;
}

Result<YamlFields> fields_of(std::string_view text) {
  if (text.size() > kMaxCalibrationFileBytes)
    return Error{Errc::InvalidInput, "too large for a calibration; give a file such as rig.yml"};
  return parse_yaml_fields(text);
}

Result<StereoCalibration> checked(Result<StereoCalibration> calibration, const CalibrationHints& hints,
                                  bool hinted) {
  if (!calibration) return calibration;
  RELIEVO_TRY(check_calibration(*calibration));
  if (!hinted || hints.width_px == 0) return calibration;
  RELIEVO_TRY(check_hinted_size(calibration->left, "K1"));
  RELIEVO_TRY(check_hinted_size(calibration->right, "K2"));
  return calibration;
}

// What was read, or what is wrong with it and in which file.
template <typename T>
Result<T> in_file(const std::string& file, Result<T> read) {
  if (read) return read;
  const std::string inside(read.error().where());
  return read.error().at(inside.empty() ? file : file + ": " + inside);
}

Result<YamlFields> fields_in(const std::filesystem::path& file) {
  RELIEVO_TRY_ASSIGN(const auto bytes, read_whole_file(file, kMaxCalibrationFileBytes));
  return in_file(file.native(), fields_of({reinterpret_cast<const char*>(bytes.data()), bytes.size()}));
}

// Is this half of a calibration, whose other half is in another file?
bool is_half(const YamlFields& fields) {
  return is_camera_info(fields) || has_stereo_cameras(fields) != has_stereo_relation(fields);
}

Result<StereoCalibration> read_one(const YamlFields& fields, const CalibrationHints& hints) {
  if (is_camera_info(fields))
    return Error{Errc::InvalidInput, "is one camera's half of a ROS calibration; give left and right"};
  return checked(read_stereo_yaml(fields, fields, hints), hints, !fields.numbers.contains("image_width"));
}

Result<StereoCalibration> read_pair(const YamlFields& one, const YamlFields& other,
                                    const CalibrationHints& hints) {
  if (is_camera_info(one) && is_camera_info(other))
    return checked(read_camera_infos(one, other, hints), hints, !one.numbers.contains("image_width"));
  const YamlFields& cameras = has_stereo_cameras(one) ? one : other;
  const YamlFields& relation = has_stereo_relation(one) ? one : other;
  if (&cameras == &relation)
    return Error{Errc::InvalidInput,
                 "these two files do not belong together; give intrinsics and extrinsics, or left and right"};
  return checked(read_stereo_yaml(cameras, relation, hints), hints, !cameras.numbers.contains("image_width"));
}

// What the file of the other half would be called.
std::filesystem::path partner_of(const std::filesystem::path& file) {
  constexpr std::pair<std::string_view, std::string_view> kPartners[] = {
      {"left", "right"}, {"Left", "Right"}, {"LEFT", "RIGHT"}, {"intrinsic", "extrinsic"}};
  const std::string name = file.filename().native();
  for (const auto& [a, b] : kPartners)
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)})
      if (const auto at = name.rfind(from); at != std::string::npos)
        return file.parent_path() / std::string(name).replace(at, from.size(), to);
  return {};
}

}  // namespace

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

Result<StereoCalibration> parse_calibration(std::string_view text, const CalibrationHints& hints) {
  RELIEVO_TRY_ASSIGN(const YamlFields fields, fields_of(text));
  return read_one(fields, hints);
}

Result<StereoCalibration> parse_calibration_pair(std::string_view one, std::string_view other,
                                                 const CalibrationHints& hints) {
  RELIEVO_TRY_ASSIGN(const YamlFields first, fields_of(one));
  RELIEVO_TRY_ASSIGN(const YamlFields second, fields_of(other));
  return read_pair(first, second, hints);
}

Result<StereoCalibration> read_calibration(const std::filesystem::path& file, const CalibrationHints& hints,
                                           const std::filesystem::path& named) {
  RELIEVO_TRY_ASSIGN(const YamlFields fields, fields_in(file));
  const std::filesystem::path other = named.empty() ? partner_of(file) : named;
  // A rig.yml that was cut looks like half of a pair, too; its name tells.
  if (named.empty() && (!is_half(fields) || (other.empty() && !is_camera_info(fields))))
    return in_file(file.native(), read_one(fields, hints));
  std::error_code missing;
  if (other.empty() || (named.empty() && !std::filesystem::exists(other, missing)))
    return wrong("is half of a calibration, and the other half is not beside it; give both files",
                 file.native());
  RELIEVO_TRY_ASSIGN(const YamlFields other_fields, fields_in(other));
  return in_file(file.native() + " and " + other.filename().native(), read_pair(fields, other_fields, hints));
}

Result<void> write_calibration(const std::filesystem::path& file, const StereoCalibration& calibration) {
  RELIEVO_TRY(check_calibration(calibration));
  const std::string text = calibration_text(calibration);
  return write_whole_file(file, std::as_bytes(std::span(text)));
}

}  // namespace relievo::pipeline
