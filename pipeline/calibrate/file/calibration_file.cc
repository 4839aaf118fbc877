// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/file/calibration_file.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory_resource>
#include <span>
#include <sstream>
#include <system_error>
#include <utility>

#include "hal/base/whole_file.h"
#include "pipeline/calibrate/file/calibration_fields.h"
#include "pipeline/match/rectify/rectifier.h"

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
    return invalid("a camera is named in words, not by a number alone").at(name);
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

// ROS camera_info: one YAML file a camera, as camera_calibration writes left.yaml and right.yaml
// (sensor_msgs/CameraInfo, http://wiki.ros.org/image_pipeline/CameraInfo).
//
// How the cameras stand to each other is in the rectification: with R1, R2 the rectification matrices
// and Tx = P2(0,3) / P2(0,0), which is minus the baseline, in metres,
//   right_from_left = R2^T R1,   translation = R2^T (Tx, 0, 0) * 1000 mm.
// What is written here rectifies as rectifier.h does (the x axis is the baseline, the z axis
// lies between the two optical axes), with the pictures' own size and a principal point of its own for
// each camera: toed-in cameras would otherwise look past each other. image_proc and image_geometry's
// StereoCameraModel take both into account.
// ROS has no field for how good a calibration is: rms_px and epipolar_shift_px are not kept; nor are the
// cameras' names.

constexpr double kMmPerMetre = 1000;
constexpr double kSame = 1e-5;  // of numbers written with a few decimals

struct CameraInfo {
  CameraIntrinsics camera;
  Rotation rectified_from_camera;
  double focal_px = 0;  // of the projection
  double offset = 0;    // minus the distance from the left camera along the rows, metres
};

Result<CameraInfo> read_info(const YamlFields& fields, const CalibrationHints& hints) {
  CameraInfo info;
  RELIEVO_TRY(read_size(fields, hints, info.camera));
  RELIEVO_TRY(read_camera_matrix(fields, {"camera_matrix"}, info.camera));
  const auto model = fields.words.find("distortion_model");
  if (model == fields.words.end())
    return wrong("this field is missing; the file is damaged or no camera_info", "distortion_model");
  if (model->second != "plumb_bob" && model->second != "rational_polynomial")
    return Error{Errc::Unsupported, "this lens model is not known here; calibrate with plumb_bob"}.at(
        "distortion_model");
  RELIEVO_TRY(read_distortion(fields, {"distortion_coefficients"}, info.camera));
  RELIEVO_TRY_ASSIGN(const YamlMatrix* r, find_matrix(fields, {"rectification_matrix"}, 3, 3));
  std::ranges::copy(r->values, info.rectified_from_camera.m);
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

bool is_camera_info(const YamlFields& fields) {
  return holds(fields, {"camera_matrix", "projection_matrix", "rectification_matrix"});
}

// In either order: the right camera is the one that stands away from the origin. Not yet checked.
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

Result<YamlFields> fields_of(std::string_view text) {
  if (text.size() > kMaxCalibrationFileBytes)
    return invalid("too large for a calibration; give a file such as rig.yml");
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

Result<StereoCalibration> read_one(const YamlFields& fields, const CalibrationHints& hints) {
  if (is_camera_info(fields))
    return invalid("is one camera's half of a ROS calibration; give left and right");
  return checked(read_stereo_yaml(fields, fields, hints), hints, !fields.numbers.contains("image_width"));
}

Result<StereoCalibration> read_pair(const YamlFields& one, const YamlFields& other,
                                    const CalibrationHints& hints) {
  if (is_camera_info(one) && is_camera_info(other))
    return checked(read_camera_infos(one, other, hints), hints, !one.numbers.contains("image_width"));
  const YamlFields& cameras = has_stereo_cameras(one) ? one : other;
  const YamlFields& relation = has_stereo_relation(one) ? one : other;
  if (&cameras == &relation)
    return invalid(
        "these two files do not belong together; give intrinsics and extrinsics, or left and right");
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
  const bool half = is_camera_info(fields) || has_stereo_cameras(fields) != has_stereo_relation(fields);
  // A rig.yml that was cut looks like half of a pair, too; its name tells.
  if (named.empty() && (!half || (other.empty() && !is_camera_info(fields))))
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
