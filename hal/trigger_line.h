// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// TriggerLine: the wire that makes both sensors expose together.
#pragma once
#include <chrono>
#include "hal/base/result.h"
namespace relievo::hal {

class TriggerLine {
 public:
  virtual ~TriggerLine() = default;
  // Drives the line active for `width`, then inactive; leaves it inactive on error.
  virtual Result<void> pulse(std::chrono::microseconds width) = 0;
};
}  // namespace relievo::hal
