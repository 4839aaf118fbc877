// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The graphics driver keeps memory until the process ends and is unloaded before: the leak checker then
// cannot name it, and toolchain/lsan.supp cannot either. While a QuietDriver lives, what this thread
// takes is not called a leak. Everything else about memory is still checked.
#pragma once

#ifdef __SANITIZE_ADDRESS__
extern "C" void __lsan_disable();
extern "C" void __lsan_enable();
#endif

namespace relievo::ui {

class QuietDriver {
 public:
#ifdef __SANITIZE_ADDRESS__
  QuietDriver() { __lsan_disable(); }
  ~QuietDriver() { __lsan_enable(); }
#else
  QuietDriver() = default;
  ~QuietDriver() {}  // NOLINT(modernize-use-equals-default): a variable with one is never unused
#endif
  QuietDriver(const QuietDriver&) = delete;
  QuietDriver& operator=(const QuietDriver&) = delete;
};

}  // namespace relievo::ui
