// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "storage/calibration_record.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "storage/byte_order.h"
#include "storage/sodium_sha256.h"

namespace relievo::storage {
namespace {

using pipeline::CameraIntrinsics;
using pipeline::StereoCalibration;

constexpr std::string_view kMagic{"RCALIB\0\0", 8};
constexpr std::uint16_t kForm = 3;
constexpr std::size_t kCameraBytes = 9 * 8 + 2 * 4;
constexpr std::size_t kNamesBytes = 2 * (pipeline::kMaxCameraWords + 1);
constexpr std::size_t kRecordBytes =
    8 + 2 + 4 + 2 * kCameraBytes + 12 * 8 + 2 * 8 + 1 + 3 * 8 + kNamesBytes + sizeof(Sha256);
constexpr int kMaxSidePx = 65'536;

void put_camera(ByteWriter& to, const CameraIntrinsics& camera) {
  for (const double v : {camera.focal_px.x, camera.focal_px.y, camera.centre_px.x, camera.centre_px.y})
    to.put(v);
  for (const double v : camera.distortion) to.put(v);
  to.put(std::int32_t(camera.width_px));
  to.put(std::int32_t(camera.height_px));
}

CameraIntrinsics get_camera(ByteReader& from) {
  CameraIntrinsics camera;
  for (double* v : {&camera.focal_px.x, &camera.focal_px.y, &camera.centre_px.x, &camera.centre_px.y}) {
    *v = from.get<double>();
  }
  for (double& v : camera.distortion) v = from.get<double>();
  camera.width_px = from.get<std::int32_t>();
  camera.height_px = from.get<std::int32_t>();
  return camera;
}

// A length and as many bytes as the longest name has.
void put_name(ByteWriter& to, const std::string& name) {
  std::array<std::byte, pipeline::kMaxCameraWords> bytes{};
  std::ranges::copy(bytes_of(name), bytes.begin());
  to.put(std::uint8_t(name.size()));
  to.put(bytes);
}

std::string get_name(ByteReader& from) {
  const auto size = from.get<std::uint8_t>();
  std::array<char, pipeline::kMaxCameraWords> bytes{};
  for (char& c : bytes) c = char(from.get<std::uint8_t>());
  return {bytes.data(), size};
}

bool is_name(const std::string& name) {
  return name.size() <= pipeline::kMaxCameraWords &&
         std::ranges::all_of(name, [](char c) { return c >= ' ' && c <= '~'; });
}

bool usable(const CameraIntrinsics& camera) {
  const auto finite = [](double v) { return std::isfinite(v); };
  return finite(camera.focal_px.x) && finite(camera.focal_px.y) && camera.focal_px.x > 0 &&
         camera.focal_px.y > 0 && finite(camera.centre_px.x) && finite(camera.centre_px.y) &&
         std::ranges::all_of(camera.distortion, finite) && camera.width_px > 0 &&
         camera.width_px <= kMaxSidePx && camera.height_px > 0 && camera.height_px <= kMaxSidePx;
}

// R R^T = 1 and no mirror, as far as a calibration file with six decimals can say so.
bool is_rotation(const pipeline::Rotation& r) {
  constexpr double kTolerance = 1e-4;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double dot =
          r.m[3 * i] * r.m[3 * j] + r.m[3 * i + 1] * r.m[3 * j + 1] + r.m[3 * i + 2] * r.m[3 * j + 2];
      if (!(std::abs(dot - (i == j ? 1 : 0)) < kTolerance)) return false;
    }
  }
  const double determinant = r.m[0] * (r.m[4] * r.m[8] - r.m[5] * r.m[7]) -
                             r.m[1] * (r.m[3] * r.m[8] - r.m[5] * r.m[6]) +
                             r.m[2] * (r.m[3] * r.m[7] - r.m[4] * r.m[6]);
  return determinant > 0;
}

}  // namespace

Result<void> check_calibration(const StereoCalibration& calibration) {
  if (!usable(calibration.left))
    return Error{Errc::InvalidInput, "the left camera's calibration cannot be right"};
  if (!usable(calibration.right))
    return Error{Errc::InvalidInput, "the right camera's calibration cannot be right"};
  const auto& t = calibration.right_from_left.translation_mm;
  const double baseline_mm = std::hypot(t.x, t.y, t.z);
  if (!is_rotation(calibration.right_from_left.rotation) || !std::isfinite(baseline_mm) ||
      !(baseline_mm > 0) || !std::isfinite(calibration.rms_px) || calibration.rms_px < 0 ||
      !std::isfinite(calibration.epipolar_shift_px) || calibration.epipolar_shift_px < 0) {
    return Error{Errc::InvalidInput, "the position of the right camera to the left one cannot be right"};
  }
  if (!is_name(calibration.cameras.left) || !is_name(calibration.cameras.right))
    return Error{Errc::InvalidInput, "the name of a calibrated camera cannot be right"};
  return {};
}

std::vector<std::byte> encode_calibration(const StereoCalibration& calibration,
                                          const CalibrationFigures& figures) {
  std::vector<std::byte> out;
  out.reserve(kRecordBytes);
  ByteWriter to(out);
  to.put(bytes_of(kMagic));
  to.put(kForm);
  to.put(calibration.revision);
  put_camera(to, calibration.left);
  put_camera(to, calibration.right);
  for (const double v : calibration.right_from_left.rotation.m) to.put(v);
  const auto& t = calibration.right_from_left.translation_mm;
  for (const double v : {t.x, t.y, t.z, calibration.rms_px, calibration.epipolar_shift_px}) to.put(v);
  to.put(std::uint8_t(figures.grade));
  for (const double v : {figures.held_out_epipolar_px, figures.depth_sigma_mm, figures.shape_sigma_mm})
    to.put(v);
  put_name(to, calibration.cameras.left);
  put_name(to, calibration.cameras.right);
  const Sha256 digest = sha256(out);
  to.put(digest);
  return out;
}

Result<StoredCalibration> decode_calibration(std::span<const std::byte> bytes) {
  if (bytes.size() < kMagic.size() + 2 || !std::ranges::equal(bytes.first(kMagic.size()), bytes_of(kMagic))) {
    return Error{Errc::StoreCorrupt, "these bytes are no stored calibration"};
  }
  ByteReader from(bytes.subspan(kMagic.size()));
  const auto form = from.get<std::uint16_t>();
  if (form > kForm)
    return Error{Errc::StoreNewer, "this calibration was stored by a newer version: update Relievo"};
  if (form != kForm || bytes.size() != kRecordBytes ||
      !std::ranges::equal(sha256(bytes.first(bytes.size() - sizeof(Sha256))), bytes.last(sizeof(Sha256)))) {
    return Error{Errc::StoreCorrupt,
                 "a stored calibration is damaged: calibrate again, or activate an earlier one"};
  }
  StoredCalibration stored;
  StereoCalibration& calibration = stored.calibration;
  calibration.revision = from.get<std::uint32_t>();
  calibration.left = get_camera(from);
  calibration.right = get_camera(from);
  for (double& v : calibration.right_from_left.rotation.m) v = from.get<double>();
  auto& t = calibration.right_from_left.translation_mm;
  for (double* v : {&t.x, &t.y, &t.z, &calibration.rms_px, &calibration.epipolar_shift_px})
    *v = from.get<double>();
  CalibrationFigures& figures = stored.figures;
  const auto grade = from.get<std::uint8_t>();
  if (grade <= std::uint8_t(CalibrationGrade::Refuse)) figures.grade = static_cast<CalibrationGrade>(grade);
  for (double* v : {&figures.held_out_epipolar_px, &figures.depth_sigma_mm, &figures.shape_sigma_mm}) {
    *v = from.get<double>();
  }
  calibration.cameras.left = get_name(from);
  calibration.cameras.right = get_name(from);
  return stored;
}

}  // namespace relievo::storage
