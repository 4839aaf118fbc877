// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// StageRecord: what one stage cost and made.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace relievo::firmware {

struct StageRecord {
  std::string_view name;  // of the state
  std::chrono::nanoseconds took{0};
  std::uint64_t in = 0;              // what the stage was given: pixels, matches, points, triangles
  std::uint64_t out = 0;             // and what it made: matches, points, triangles, texels
  std::size_t arena_peak_bytes = 0;  // of both arenas together
};

}  // namespace relievo::firmware
