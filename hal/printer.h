// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Printer: a slip of paper for who wants one. Both calls may take seconds: never the main thread's. Errors:
// NotFound (there is none), IoFailed (it does not take it).
#pragma once

#include <cstddef>
#include <span>

#include "hal/base/result.h"

namespace relievo::hal {

class Printer {
 public:
  virtual ~Printer() = default;
  virtual bool is_there() = 0;
  virtual Result<void> print(std::span<const std::byte> png) = 0;
};

}  // namespace relievo::hal
