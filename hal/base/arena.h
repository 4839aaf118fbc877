// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Arena: one block of memory, taken at boot, given out front to back.
//
// Freeing is a no-op; reset() takes everything back at once and wipe() zeroes it first. Exhaustion throws
// std::bad_alloc, which run_stage() turns into Errc::OutOfMemory: no caller ever sees the exception.
#pragma once

#include <cstddef>
#include <memory>
#include <memory_resource>
#include <mutex>
#include <new>
#include <span>

#include <string.h>

namespace relievo {

class Arena final : public std::pmr::memory_resource {
 public:
  explicit Arena(std::span<std::byte> block) : block_(block) {}
  Arena(const Arena&) = delete;
  Arena& operator=(const Arena&) = delete;

  std::size_t used() const { return used_; }
  std::size_t capacity() const { return block_.size(); }
  std::size_t high_water() const { return high_water_; }

  void reset() { used_ = 0; }
  // Gives back, when it dies, everything taken since it was made: for loops inside a stage.
  class Mark {
   public:
    explicit Mark(Arena& arena) : arena_(arena), used_(arena.used_) {}
    ~Mark() { arena_.used_ = used_; }
    Mark(const Mark&) = delete;
    Mark& operator=(const Mark&) = delete;

   private:
    Arena& arena_;
    std::size_t used_;
  };
  // All of it, or what was taken since `used` bytes were.
  void wipe(std::size_t used = 0) {
    if (used < high_water_) explicit_bzero(block_.data() + used, high_water_ - used);  // not optimised away
    used_ = used;
  }

 private:
  void* do_allocate(std::size_t bytes, std::size_t alignment) override {
    void* place = block_.data() + used_;
    std::size_t space = block_.size() - used_;
    if (!std::align(alignment, bytes, place, space)) throw std::bad_alloc();
    used_ = block_.size() - space + bytes;
    if (used_ > high_water_) high_water_ = used_;
    return place;
  }
  void do_deallocate(void*, std::size_t, std::size_t) override {}
  bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }

  std::span<std::byte> block_;
  std::size_t used_ = 0;
  std::size_t high_water_ = 0;
};

// An arena from which several threads take. What they took goes with it.
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

}  // namespace relievo
