// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// AllocationCounter: how often this thread has asked for memory (malloc and its kin, so operator new
// and the libraries too) since the counter was made. Under a sanitizer, which has its own malloc, it
// counts nothing: ask counts(). Thread: each counts its own.
#pragma once

namespace relievo {

class AllocationCounter {
 public:
  AllocationCounter();
  static bool counts();
  long made() const;

 private:
  long at_start_;
};

}  // namespace relievo
