// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// An arena from which several threads take. What they took goes with it. Throws std::bad_alloc.
#pragma once

#include <cstddef>
#include <memory_resource>
#include <mutex>

#include "hal/base/arena.h"

namespace relievo::pipeline {

class SharedArena final : public std::pmr::memory_resource {
 public:
  explicit SharedArena(Arena& arena) : arena_(arena), mark_(arena) {}

 private:
  void* do_allocate(std::size_t bytes, std::size_t alignment) override {
    const std::lock_guard lock(mutex_);
    return arena_.allocate(bytes, alignment);
  }
  void do_deallocate(void*, std::size_t, std::size_t) override {}
  bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }

  Arena& arena_;
  Arena::Mark mark_;
  std::mutex mutex_;
};

}  // namespace relievo::pipeline
