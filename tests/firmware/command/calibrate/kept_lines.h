// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// KeptLines: all that a calibration says, each line with its end.
#pragma once

#include <string>

#include "firmware/calibrate/calibrate_command.h"

namespace relievo::tests {

class KeptLines {
 public:
  firmware::Tell tell() {
    return [this](const std::string& line) {
      text_ += line + '\n';
      return Result<void>();
    };
  }
  const std::string& str() const { return text_; }

 private:
  std::string text_;
};

}  // namespace relievo::tests
