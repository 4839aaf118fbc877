// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// BootMemory: the one block, taken at boot and never given back, cut as budget.h says.
// A page that nothing touches costs nothing; those that are touched come as huge pages where the kernel has
// them, since a stage that takes 150 MB page by page spends a tenth of its time in the kernel. Throws
// bad_alloc when the machine has not that much: then there is no appliance. Thread: main makes it; each span
// then has one user.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <span>

#include <sys/mman.h>

#include "firmware/base/budget.h"

namespace relievo::firmware {

class BootMemory {
 public:
  BootMemory()
      : BootMemory(budget::kFramePoolBytes, budget::kOutputArenaBytes, budget::kScratchArenaBytes,
                   budget::kSidesBytes, budget::kFollowBytes) {}
  // Tests shrink it until nothing fits; without sides one pair makes a face.
  BootMemory(std::size_t frame_bytes, std::size_t output_bytes, std::size_t scratch_bytes,
             std::size_t sides_bytes = 0, std::size_t follow_bytes = 0)
      : block_(take(frame_bytes + output_bytes + scratch_bytes + sides_bytes + follow_bytes)),
        frames_(block_.get(), frame_bytes),
        output_(frames_.data() + frame_bytes, output_bytes),
        scratch_(output_.data() + output_bytes, scratch_bytes),
        sides_(scratch_.data() + scratch_bytes, sides_bytes),
        follow_(sides_.data() + sides_bytes, follow_bytes) {}

  std::span<std::byte> frames() const { return frames_; }
  std::span<std::byte> output() const { return output_; }
  std::span<std::byte> scratch() const { return scratch_; }
  std::span<std::byte> sides() const { return sides_; }
  std::span<std::byte> follow() const { return follow_; }
  std::span<const std::byte> all() const { return {block_.get(), follow_.data() + follow_.size()}; }

 private:
  static constexpr std::align_val_t kHugePage{std::size_t{2} << 20};
  struct GiveBack {
    void operator()(std::byte* block) const { ::operator delete(block, kHugePage); }
  };
  using Block = std::unique_ptr<std::byte, GiveBack>;
  static Block take(std::size_t bytes) {
    auto* block = static_cast<std::byte*>(::operator new(bytes, kHugePage));
    ::madvise(block, bytes,
              MADV_HUGEPAGE);  // advice: a kernel without huge pages says no, and all is as before
    return Block(block);
  }

  Block block_;  // not value-initialised: pages stay untouched
  std::span<std::byte> frames_;
  std::span<std::byte> output_;
  std::span<std::byte> scratch_;
  std::span<std::byte> sides_;   // session/session.h
  std::span<std::byte> follow_;  // of the capture thread, while the worker has the others
};

}  // namespace relievo::firmware
