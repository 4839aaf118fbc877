// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/recording/recording.h"

#include <algorithm>
#include <cstdio>
#include <system_error>

#include "hal/picture_file.h"
#include "hal/recording/capture_file.h"

namespace relievo::hal {
std::string recorded_name(const char* side, std::int64_t number) {
  char name[40];
  std::snprintf(name, sizeof name, "%s_%06lld.png", side, static_cast<long long>(number));
  return name;
}

Result<std::int64_t> record_pair(const std::filesystem::path& folder, const RecordedPair& pair) {
  if (pair.left.empty() || pair.right.empty())
    return Error{Errc::InvalidInput, "a pair without pixels cannot be recorded"}.at(folder.string());
  if (pair.left.width_px != pair.right.width_px || pair.left.height_px != pair.right.height_px ||
      pair.left.format != pair.right.format)
    return Error{Errc::InvalidInput, "the two views differ in size or format: they are no pair"}.at(
        folder.string());
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed)
    return Error{Errc::IoFailed, "the folder for recordings cannot be made", failed.value()}.at(
        folder.string());
  const std::filesystem::path index = folder / "capture.json";
  CaptureFile capture;
  if (std::filesystem::exists(index, failed)) {
    RELIEVO_TRY_ASSIGN(capture, read_capture_file(index));
  }
  std::int64_t number = 1;
  for (const CaptureRecord& frame : capture.frames) number = std::max(number, frame.number + 1);
  RELIEVO_TRY(write_picture(folder / recorded_name("left", number), pair.left));
  RELIEVO_TRY(write_picture(folder / recorded_name("right", number), pair.right));
  capture.left_serial = pair.left_serial;
  capture.right_serial = pair.right_serial;
  capture.frames.push_back({number, pair.left_ns, pair.right_ns, pair.exposure_us, pair.gain});
  RELIEVO_TRY(write_capture_file(index, capture));
  return number;
}

}  // namespace relievo::hal
