// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "storage/calibration_record.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "pipeline/model/vector3.h"
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

template <typename Io>
void walk_camera(Io& io, CameraIntrinsics& camera) {
  io.numbers(camera.focal_px.x, camera.focal_px.y, camera.centre_px.x, camera.centre_px.y);
  for (double& v : camera.distortion) io.numbers(v);
  io.numbers(camera.width_px, camera.height_px);
}

// A length and as many bytes as the longest name has.
template <typename Io>
void walk_name(Io& io, std::string& name) {
  auto size = std::uint8_t(name.size());
  io.numbers(size);
  name.resize(pipeline::kMaxCameraWords);
  for (char& c : name) io.numbers(c);
  name.resize(size);
}

template <typename Io>
void walk(Io& io, StoredCalibration& stored) {
  StereoCalibration& calibration = stored.calibration;
  CalibrationFigures& figures = stored.figures;
  io.numbers(calibration.revision);
  walk_camera(io, calibration.left);
  walk_camera(io, calibration.right);
  for (double& v : calibration.right_from_left.rotation.m) io.numbers(v);
  auto& t = calibration.right_from_left.translation_mm;
  io.numbers(t.x, t.y, t.z, calibration.rms_px, calibration.epipolar_shift_px);
  auto grade = std::uint8_t(figures.grade);
  io.numbers(grade);
  if (grade <= std::uint8_t(CalibrationGrade::Refuse)) figures.grade = static_cast<CalibrationGrade>(grade);
  io.numbers(figures.held_out_epipolar_px, figures.depth_sigma_mm, figures.shape_sigma_mm);
  walk_name(io, calibration.cameras.left);
  walk_name(io, calibration.cameras.right);
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
  const pipeline::Vec3d rows[] = {
      {r.m[0], r.m[1], r.m[2]}, {r.m[3], r.m[4], r.m[5]}, {r.m[6], r.m[7], r.m[8]}};
  for (const auto& a : rows)
    for (const auto& b : rows)
      if (!(std::abs(dot(a, b) - (&a == &b ? 1 : 0)) < kTolerance)) return false;
  return dot(rows[0], cross(rows[1], rows[2])) > 0;
}

}  // namespace

Result<void> check_calibration(const StereoCalibration& calibration) {
  if (!usable(calibration.left)) return invalid("the left camera's calibration cannot be right");
  if (!usable(calibration.right)) return invalid("the right camera's calibration cannot be right");
  const auto& t = calibration.right_from_left.translation_mm;
  const double baseline_mm = std::hypot(t.x, t.y, t.z);
  if (!is_rotation(calibration.right_from_left.rotation) || !std::isfinite(baseline_mm) ||
      !(baseline_mm > 0) || !std::isfinite(calibration.rms_px) || calibration.rms_px < 0 ||
      !std::isfinite(calibration.epipolar_shift_px) || calibration.epipolar_shift_px < 0) {
    return invalid("the position of the right camera to the left one cannot be right");
  }
  if (!is_name(calibration.cameras.left) || !is_name(calibration.cameras.right))
    return invalid("the name of a calibrated camera cannot be right");
  return {};
}

std::vector<std::byte> encode_calibration(const StereoCalibration& calibration,
                                          const CalibrationFigures& figures) {
  std::vector<std::byte> out;
  out.reserve(kRecordBytes);
  ByteWriter to(out);
  to.put(bytes_of(kMagic));
  to.put(kForm);
  StoredCalibration stored{calibration, figures};
  walk(to, stored);
  to.put(sha256(out));
  return out;
}

Result<StoredCalibration> decode_calibration(std::span<const std::byte> bytes) {
  if (bytes.size() < kMagic.size() + 2 || !text_of(bytes).starts_with(kMagic)) {
    return Error{Errc::StoreCorrupt, "these bytes are no stored calibration"};
  }
  ByteReader from(bytes.subspan(kMagic.size()));
  const auto form = from.get<std::uint16_t>();
  if (form > kForm)
    return Error{Errc::StoreNewer, "this calibration was stored by a newer version: update Relievo"};
  if (form != kForm || bytes.size() != kRecordBytes || !ends_in_sha256(bytes)) {
    return Error{Errc::StoreCorrupt,
                 "a stored calibration is damaged: calibrate again, or activate an earlier one"};
  }
  StoredCalibration stored;
  walk(from, stored);
  return stored;
}

}  // namespace relievo::storage
