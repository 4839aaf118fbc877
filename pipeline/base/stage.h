// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What every stage is given, and how every stage is run.
#pragma once

#include <atomic>
#include <new>
#include <utility>

#include "hal/base/arena.h"
#include "hal/base/result.h"
#include "hal/base/thread_pool.h"

namespace relievo::pipeline {

// How far a stage has come, for a screen or a terminal: written by the worker, read by anyone.
struct Progress {
  std::atomic<float> done{0};  // 0 to 1 within the stage
};

struct StageContext {
  Arena& output;   // lives until the enrolment session ends
  Arena& scratch;  // emptied when the stage returns
  ThreadPool& pool;
  Progress& progress;
  const std::atomic<bool>& cancelled;

  // Long loops ask this at least every 50 ms and return stopped().
  bool stop() const { return cancelled.load(std::memory_order_relaxed); }
};

inline Error stopped() { return {Errc::Cancelled, "it was stopped"}; }

// The one place where a library's exception becomes a Result.
template <typename Stage>
auto run_stage(StageContext& context, Stage&& stage) -> decltype(stage(context)) {
  struct Sweep {
    Arena& scratch;
    ~Sweep() { scratch.reset(); }
  } sweep{context.scratch};
  context.progress.done.store(0, std::memory_order_relaxed);
  if (context.stop()) return stopped();
  try {
    return std::forward<Stage>(stage)(context);
  } catch (const std::bad_alloc&) {
    return Error{
        Errc::OutOfMemory,
        "the stage's memory is used up: the pictures or what an option asks for are larger than was planned"};
  } catch (const std::exception&) {
    return Error{Errc::LibraryFailed, "a library gave up on this input"};
  }
}

}  // namespace relievo::pipeline
