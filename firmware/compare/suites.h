// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sets that belong together, by name. A suite is made from the algorithms that this program has.
// Errors: NotFound (no such suite; the error's place lists them). Thread: any.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "hal/base/result.h"

namespace relievo::firmware::compare {

struct SetWords {
  std::string name;
  std::vector<std::string> settings;  // "matcher=ssd", "ssd.window_px=21"
};

std::vector<std::string_view> suite_names();
Result<std::vector<SetWords>> suite_sets(std::string_view suite);

}  // namespace relievo::firmware::compare
