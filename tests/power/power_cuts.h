// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Power is cut at every sync of some steps, in as many ways as RELIEVO_POWER_CUT_SEEDS says (4), and the
// process is killed in the middle of their writes. Whatever is left must look as before the step or as after
// it; as after it, once the step has said that it is done. Power may go once more while what is left is
// looked at.
//
// With RELIEVO_POWER_CUT_DEVICE set the steps are done on a real ext4, and power is cut below it
// (logged_device.h).
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace relievo::test {

struct PowerStep {
  std::string name;
  std::function<bool()> work;  // false: it failed
};

struct PowerLook {
  // What can be seen in a folder by the product's own means, which may change it; what is wrong begins with
  // "!".
  std::function<std::string(const std::filesystem::path& folder)> see;
  // Of the disk as it was left, when `done` steps were acknowledged: what is wrong, or nothing. May be
  // missing.
  std::function<std::string(const std::filesystem::path& folder, std::size_t done)> raw{};
  // Is at no time written anywhere, where there is a device to look at. Empty: may be.
  std::string never{};
};

struct PowerCounts {
  long points = 0, cuts = 0, different = 0, kills = 0, cut_again = 0;
  long as_before = 0, as_after = 0;  // where the two differ
};

// Does the steps in `folder`, then all of the above; what is wrong fails the test. Prints the counts.
PowerCounts cut_power(const std::filesystem::path& folder, const std::vector<PowerStep>& steps,
                      const PowerLook& look);

}  // namespace relievo::test
