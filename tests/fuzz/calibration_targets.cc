// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Calibrations: our rig.yml and OpenCV's, the two halves of OpenCV's sample, ROS' camera_info; and as stored.
#include <algorithm>

#include "hal/base/assert.h"
#include "pipeline/calibrate/file/calibration_file.h"
#include "storage/calibration_record.h"
#include "storage/sodium_sha256.h"
#include "tests/fuzz/fuzz_targets.h"
#include "tests/storage/sample.h"

namespace relievo::test {
namespace {

using namespace pipeline;

// What was taken can be written, and is then read as what it was.
bool stays(const Result<StereoCalibration>& taken) {
  if (!taken) return false;
  const std::string text = calibration_text(*taken);
  const auto again = parse_calibration(text);
  RELIEVO_ASSERT(again.has_value());
  RELIEVO_ASSERT(calibration_text(*again) == text);
  return true;
}

bool one(FuzzBytes input) { return stays(parse_calibration(text_of(input))); }

// A zero between the two.
bool pair(FuzzBytes input) {
  const std::string_view both = text_of(input);
  const std::size_t end = std::min(both.find('\0'), both.size());
  return stays(parse_calibration_pair(both.substr(0, end), both.substr(std::min(end + 1, both.size()))));
}

// Its checksum is made to hold: whoever changes a store on purpose does the same.
bool record(FuzzBytes input) {
  std::vector<std::byte> bytes(bytes_of(input).begin(), bytes_of(input).end());
  const auto sum = storage::sha256(bytes);
  bytes.insert(bytes.end(), sum.begin(), sum.end());
  return storage::decode_calibration(bytes).has_value();
}

std::string sample_record() {
  const std::string whole = text_of(
      std::span<const std::byte>(storage::encode_calibration(storage::test::sample_calibration(), {})));
  return whole.substr(0, whole.size() - sizeof(storage::Sha256));
}

// As OpenCV's stereo sample writes them.
const char* const kIntrinsics =
    "%YAML:1.0\n---\nM1: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n   data: [ 1500., 0., 640., 0., 1500., "
    "480.,\n       0., 0., 1. ]\nD1: !!opencv-matrix\n   rows: 1\n   cols: 5\n   dt: d\n   data: [ 0.1, 0., 0., 0., "
    "0. ]\nM2: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n   data: [ 1500., 0., 640., 0., 1500., 480., 0., "
    "0., 1. ]\nD2: !!opencv-matrix\n   rows: 1\n   cols: 5\n   dt: d\n   data: [ 0.1, 0., 0., 0., 0. ]\n"
    "image_width: 1280\nimage_height: 960\n";
const char* const kExtrinsics =
    "%YAML:1.0\n---\nR: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n   data: [ 1., 0., 0., 0., 1., 0., 0., 0., "
    "1. ]\nT: !!opencv-matrix\n   rows: 3\n   cols: 1\n   dt: d\n   data: [ -120., 0., 0. ]\n";

}  // namespace

std::vector<FuzzTarget> calibration_targets() {
  const auto sample = storage::test::sample_calibration();
  std::vector<std::string> pairs{std::string(kIntrinsics) + '\0' + kExtrinsics};
  if (const auto ros = camera_info_texts(sample)) pairs.push_back(ros->left + '\0' + ros->right);
  return {{"calibration", one, {calibration_text(sample)}},
          {"calibration-pair", pair, pairs},
          {"calibration-record", record, {sample_record()}}};
}

}  // namespace relievo::test
