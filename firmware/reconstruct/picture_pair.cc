// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/reconstruct/picture_pair.h"

#include "pipeline/calibrate/file/calibration_file.h"

namespace relievo::firmware {
namespace {

std::string size_of(int width_px, int height_px) {
  return std::to_string(width_px) + "x" + std::to_string(height_px);
}

}  // namespace

Result<PicturePair> read_pair(const std::filesystem::path& left, const std::filesystem::path& right) {
  PicturePair pair;
  RELIEVO_TRY_ASSIGN(pair.left, hal::read_picture(left));
  RELIEVO_TRY_ASSIGN(pair.right, hal::read_picture(right));
  const std::string left_size = size_of(pair.left.width_px, pair.left.height_px);
  const std::string right_size = size_of(pair.right.width_px, pair.right.height_px);
  if (left_size != right_size) {
    return Error{Errc::InvalidInput,
                 "the two pictures differ in size: give a left and a right one of the same shot"}
        .at(right.string() + " (" + right_size + ", left " + left_size + ")");
  }
  return pair;
}

Result<void> check_size(const pipeline::StereoCalibration& calibration, const hal::CaptureMode& pictures,
                        const std::string& place) {
  const std::string pictured = size_of(pictures.width_px, pictures.height_px);
  const std::string calibrated = size_of(calibration.left.width_px, calibration.left.height_px);
  if (pictured == calibrated) return {};
  return Error{Errc::InvalidInput, "the calibration is for pictures of another size: calibrate at this one"}
      .at(place + " (" + pictured + ", calibrated " + calibrated + ")");
}

Result<pipeline::StereoCalibration> read_calibration_for(const PicturePair& pair,
                                                         const std::filesystem::path& file,
                                                         const std::filesystem::path& left) {
  RELIEVO_TRY_ASSIGN(const auto calibration,
                     pipeline::read_calibration(file, {pair.left.width_px, pair.left.height_px, 0}));
  RELIEVO_TRY(check_size(calibration, {pair.left.width_px, pair.left.height_px}, left.string()));
  return calibration;
}

}  // namespace relievo::firmware
