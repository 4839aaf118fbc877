// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// RunMark: a file that is there while the kiosk runs, and gone when it ended as it should. One that is
// found at the start means the power went, or the program did. Thread: main. Errors of set(): IoFailed,
// MediaFull.
#pragma once

#include <filesystem>
#include <memory>
#include <utility>

#include "hal/base/result.h"

namespace relievo::firmware {

class RunMark {
 public:
  static Result<std::unique_ptr<RunMark>> set(const std::filesystem::path& folder);
  ~RunMark();
  RunMark(const RunMark&) = delete;
  RunMark& operator=(const RunMark&) = delete;
  // Did the run before this one end in the middle?
  bool ended_early() const { return ended_early_; }

 private:
  RunMark(std::filesystem::path file, bool ended_early) : file_(std::move(file)), ended_early_(ended_early) {}
  std::filesystem::path file_;
  bool ended_early_;
};

}  // namespace relievo::firmware
