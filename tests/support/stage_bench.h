// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// StageBench: everything a stage asks for, for tests: arenas of a chosen size, a pool, a switch.
#pragma once

#include <atomic>
#include <cstddef>
#include <vector>

#include "pipeline/stage.h"

namespace relievo::test {

struct StageBench {
  explicit StageBench(std::size_t output_bytes = std::size_t{256} << 20, std::size_t scratch_bytes = std::size_t{512} << 20,
                      int threads = 2)
      : output_block(output_bytes), scratch_block(scratch_bytes), output(output_block), scratch(scratch_block),
        pool(threads), context{output, scratch, pool, progress, cancelled} {}

  std::vector<std::byte> output_block;
  std::vector<std::byte> scratch_block;
  Arena output;
  Arena scratch;
  ThreadPool pool;
  pipeline::Progress progress;
  std::atomic<bool> cancelled{false};
  pipeline::StageContext context;
};

}  // namespace relievo::test
