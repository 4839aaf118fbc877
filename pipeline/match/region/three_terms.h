// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Weighted least squares of three terms: value = k0 * t0 + k1 * t1 + k2 * t2, from the sums alone. No memory.
// Thread: one caller.
#pragma once

#include <array>
#include <optional>

namespace relievo::pipeline {

class ThreeTerms {
 public:
  void add(const std::array<double, 3>& terms, double value, double weight = 1);
  // k; nothing where what was added does not fix all three.
  std::optional<std::array<double, 3>> solve() const;

 private:
  std::array<double, 6> products_{};  // 00 01 02 11 12 22
  std::array<double, 3> values_{};
};

}  // namespace relievo::pipeline
