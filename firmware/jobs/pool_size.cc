// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/jobs/pool_size.h"

#include <algorithm>
#include <thread>

#include "firmware/base/budget.h"

namespace relievo::firmware {

int pool_size() {
  return std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, budget::kMaxPoolThreads);
}

}  // namespace relievo::firmware
