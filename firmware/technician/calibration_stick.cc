// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/technician/calibration_stick.h"

#include <algorithm>
#include <system_error>
#include <vector>

#include "firmware/base/output_folder.h"
#include "firmware/service/stick_folder.h"
#include "hal/whole_file.h"
#include "pipeline/calibrate/file/calibration_file.h"
#include "pipeline/calibrate/file/camera_info.h"

namespace relievo::firmware {
namespace {

namespace fs = std::filesystem;

constexpr const char *kRig = "rig.yml", *kLeft = "left.yaml", *kRight = "right.yaml";

Result<void> read_back(const fs::path& file, const std::string& written) {
  const auto read = hal::read_whole_file(file, pipeline::kMaxCalibrationFileBytes);
  if (!read) return read.error();
  const bool same =
      read->size() == written.size() && std::equal(read->begin(), read->end(), written.begin(),
                                                   [](auto a, char b) { return static_cast<char>(a) == b; });
  return same ? Result<void>() : not_as_written(file);
}

Result<void> write(const pipeline::StereoCalibration& calibration, const fs::path& target,
                   hal::RemovableMedia& media) {
  RELIEVO_TRY_ASSIGN(const auto ros, pipeline::camera_info_texts(calibration));
  const std::pair<const char*, std::string> files[] = {
      {kRig, pipeline::calibration_text(calibration)}, {kLeft, ros.left}, {kRight, ros.right}};
  RELIEVO_TRY_ASSIGN(OutputFolder folder, OutputFolder::begin(target));
  for (const auto& [name, text] : files) RELIEVO_TRY(write_text(folder.path() / name, text, target));
  RELIEVO_TRY(media.settle(folder.path()));
  for (const auto& [name, text] : files) RELIEVO_TRY(read_back(folder.path() / name, text));
  return replace_folder(folder, target);
}

// The top first, then the folders of calibrations, the last name first.
std::vector<fs::path> places(const fs::path& root) {
  std::vector<fs::path> folders;
  std::error_code error;
  for (fs::directory_iterator entry(root / kCalibrationsFolder, error), end; !error && entry != end;
       entry.increment(error))
    if (!entry->path().filename().string().starts_with('.')) folders.push_back(entry->path());
  std::sort(folders.rbegin(), folders.rend());
  folders.insert(folders.begin(), root);
  return folders;
}

}  // namespace

Result<void> export_calibration(const pipeline::StereoCalibration& calibration, const std::string& name,
                                hal::RemovableMedia& media) {
  return put_on_stick(media, fs::path(kCalibrationsFolder) / name, nullptr,
                      [&](const fs::path& target) { return write(calibration, target, media); });
}

Result<StickCalibration> import_calibration(hal::RemovableMedia& media) {
  const auto medium = media.current();
  if (!medium) return Error{Errc::MediaMissing, "there is no stick: plug one in"};
  for (const fs::path& place : places(medium->root))
    for (const char* name : {kRig, kLeft}) {
      std::error_code error;
      if (!fs::exists(place / name, error)) continue;
      const std::string file = (place / name).lexically_relative(medium->root).string();
      const auto read = pipeline::read_calibration(place / name);
      if (!read) return read.error();
      return StickCalibration{*read, file};
    }
  return Error{Errc::NotFound,
               "no calibration is on the stick: put rig.yml, or left.yaml and right.yaml, at its top"};
}

}  // namespace relievo::firmware
