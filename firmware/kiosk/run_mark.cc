// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/kiosk/run_mark.h"

#include <fstream>

namespace relievo::firmware {

Result<std::unique_ptr<RunMark>> RunMark::set(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "relievo.running";
  std::error_code error;
  const bool there = std::filesystem::exists(file, error);
  if (!there && !std::ofstream(file))
    return Error{Errc::IoFailed, "cannot be written: check the folder's rights and the disk"}.at(
        file.string());
  return std::unique_ptr<RunMark>(new RunMark(file, there));
}

RunMark::~RunMark() {
  std::error_code error;
  std::filesystem::remove(file_, error);
}

}  // namespace relievo::firmware
