// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// PageBlock: a large block of zeros from the kernel, in huge pages where it has them: a stage that takes
// 150 MB page by page spends a tenth of its time in the kernel. A page that nothing touches costs nothing,
// neither when the block is taken nor when it goes: the heap's free() would wipe all of it, and touch it for
// that. What was written goes with its pages, which the kernel clears before anybody has them again.
// Throws bad_alloc when the machine has not that much. Thread: any; the bytes are their user's.
#pragma once

#include <cstddef>
#include <cstdint>
#include <new>
#include <span>
#include <utility>

#include <sys/mman.h>

namespace relievo::firmware {

class PageBlock {
 public:
  PageBlock() = default;
  explicit PageBlock(std::size_t bytes) : mapped_(bytes + kHugePage), size_(bytes) {
    begin_ = ::mmap(nullptr, mapped_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (begin_ == MAP_FAILED) throw std::bad_alloc();
    // Advice: a kernel without huge pages says no, and all is as before.
    ::madvise(begin_, mapped_, MADV_HUGEPAGE);
  }
  PageBlock(PageBlock&& other) noexcept { swap(other); }
  PageBlock& operator=(PageBlock&& other) noexcept {
    swap(other);
    return *this;
  }
  ~PageBlock() {
    if (mapped_ > 0) ::munmap(begin_, mapped_);
  }

  std::span<std::byte> bytes() const {
    const std::uintptr_t begin = reinterpret_cast<std::uintptr_t>(begin_);
    const std::uintptr_t aligned = (begin + kHugePage - 1) / kHugePage * kHugePage;
    return {static_cast<std::byte*>(begin_) + (aligned - begin), size_};
  }

 private:
  static constexpr std::size_t kHugePage = std::size_t{2} << 20;
  void swap(PageBlock& other) {
    std::swap(begin_, other.begin_);
    std::swap(mapped_, other.mapped_);
    std::swap(size_, other.size_);
  }

  void* begin_ = nullptr;
  std::size_t mapped_ = 0;
  std::size_t size_ = 0;
};

}  // namespace relievo::firmware
