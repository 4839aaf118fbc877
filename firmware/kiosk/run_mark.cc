// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/kiosk/run_mark.h"

#include "hal/base/whole_file.h"

namespace relievo::firmware {

Result<std::unique_ptr<RunMark>> RunMark::set(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "relievo.running";
  std::error_code error;
  const bool there = std::filesystem::exists(file, error);
  // On the disk before anybody comes, and gone from it before the program says that it has ended.
  if (!there) RELIEVO_TRY(write_whole_file(file, {}));
  return std::unique_ptr<RunMark>(new RunMark(file, there));
}

RunMark::~RunMark() {
  std::error_code error;
  std::filesystem::remove(file_, error);
  (void)sync_directory(file_.parent_path());
}

}  // namespace relievo::firmware
