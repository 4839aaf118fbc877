// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// capture.json: what a recording knows about its frames beside the pictures.
//
//   { "cameras": {"left": {"serial": "A"}, "right": {"serial": "B"}},
//     "frames": [ {"number": 0, "left_ns": 0, "right_ns": 180000, "exposure_us": 4000, "gain": 1.0} ] }
//
// Times are nanoseconds from any common origin. "number" is the NNNNNN of left_NNNNNN.png.
// Errors: NotFound, InvalidInput (says what is wrong), IoFailed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "hal/base/result.h"

namespace relievo::hal {

struct CaptureRecord {
  std::int64_t number = 0;
  std::int64_t left_ns = 0, right_ns = 0;
  std::int64_t exposure_us = 0;
  double gain = 1;
};

struct CaptureFile {
  std::string left_serial, right_serial;
  std::vector<CaptureRecord> frames;
};

Result<CaptureFile> read_capture_file(const std::filesystem::path& file);
Result<void> write_capture_file(const std::filesystem::path& file, const CaptureFile& capture);

}  // namespace relievo::hal
