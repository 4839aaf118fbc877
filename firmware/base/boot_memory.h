// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// BootMemory: the one block, taken at boot and never given back, cut as budget.h says.
// Throws bad_alloc when the machine has not that much: then there is no appliance. Thread: main makes it;
// each span then has one user.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <span>

#include <sys/mman.h>

#include "firmware/base/budget.h"

namespace relievo::firmware {

struct UnmapPages {
  std::size_t bytes = 0;
  void operator()(void* begin) const { ::munmap(begin, bytes); }
};

// PageBlock: a large block of zeros from the kernel, in huge pages where it has them: a stage that takes
// 150 MB page by page spends a tenth of its time in the kernel. A page that nothing touches costs nothing,
// neither when the block is taken nor when it goes: the heap's free() would wipe all of it, and touch it for
// that. What was written goes with its pages, which the kernel clears before anybody has them again.
// Throws bad_alloc when the machine has not that much. Thread: any; the bytes are their user's.
class PageBlock {
 public:
  PageBlock() = default;
  explicit PageBlock(std::size_t bytes) : size_(bytes) {
    const std::size_t mapped = bytes + kHugePage;
    void* const begin = ::mmap(nullptr, mapped, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (begin == MAP_FAILED) throw std::bad_alloc();
    pages_ = {begin, UnmapPages{mapped}};
    // Advice: a kernel without huge pages says no, and all is as before.
    ::madvise(begin, mapped, MADV_HUGEPAGE);
  }

  std::span<std::byte> bytes() const {
    const std::uintptr_t begin = reinterpret_cast<std::uintptr_t>(pages_.get());
    const std::uintptr_t aligned = (begin + kHugePage - 1) / kHugePage * kHugePage;
    return {static_cast<std::byte*>(pages_.get()) + (aligned - begin), size_};
  }

 private:
  static constexpr std::size_t kHugePage = std::size_t{2} << 20;
  std::unique_ptr<void, UnmapPages> pages_;
  std::size_t size_ = 0;
};

class BootMemory {
 public:
  explicit BootMemory(const budget::MemoryPlan& plan = budget::kLargestPlan)
      : plan_(plan), block_(plan.all()) {}
  // Tests shrink it until nothing fits.
  BootMemory(std::size_t frame_bytes, std::size_t output_bytes, std::size_t scratch_bytes,
             std::size_t sides_bytes = 0, std::size_t follow_bytes = 0)
      : BootMemory(budget::MemoryPlan{frame_bytes, output_bytes, scratch_bytes, sides_bytes, follow_bytes}) {}

  std::span<std::byte> frames() const { return cut(0, plan_.frames); }
  std::span<std::byte> output() const { return cut(plan_.frames, plan_.products); }
  std::span<std::byte> scratch() const { return cut(plan_.frames + plan_.products, plan_.scratch); }
  // session/session.h
  std::span<std::byte> sides() const { return cut(plan_.all() - plan_.follow - plan_.sides, plan_.sides); }
  // Of the capture thread, while the worker has the others.
  std::span<std::byte> follow() const { return cut(plan_.all() - plan_.follow, plan_.follow); }
  std::span<const std::byte> all() const { return block_.bytes(); }

 private:
  std::span<std::byte> cut(std::size_t first, std::size_t bytes) const {
    return block_.bytes().subspan(first, bytes);
  }
  budget::MemoryPlan plan_;
  PageBlock block_;
};

}  // namespace relievo::firmware
