// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Workspace: all that a stage asks for, in one piece, for programs that are no appliance: memory taken once,
// threads, progress and a switch to cancel. What a stage returns lies in `output` and lives until
// output.reset() or the workspace's end. A pair of 1920 x 1200 touches some 100 MB of output and 190 MB of
// scratch (firmware/FIGURES.md); pages that nothing touches cost nothing. Thread: the stages' caller;
// `progress` and `cancelled` any. Errors: bad_alloc where the machine has not that much.
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <thread>

#include "pipeline/base/stage.h"

namespace relievo::pipeline {

class Workspace {
  std::unique_ptr<std::byte[]> output_block_, scratch_block_;  // not value-initialised: pages stay untouched

 public:
  explicit Workspace(int threads = int(std::thread::hardware_concurrency()),
                     std::size_t output_bytes = std::size_t{320} << 20,
                     std::size_t scratch_bytes = std::size_t{640} << 20)
      : output_block_(new std::byte[output_bytes]),
        scratch_block_(new std::byte[scratch_bytes]),
        output({output_block_.get(), output_bytes}),
        scratch({scratch_block_.get(), scratch_bytes}),
        pool(threads),
        context{output, scratch, pool, progress, cancelled} {}

  Arena output;
  Arena scratch;
  ThreadPool pool;
  Progress progress;
  std::atomic<bool> cancelled{false};
  StageContext context;
};

}  // namespace relievo::pipeline
