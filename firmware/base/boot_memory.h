// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// BootMemory: the one block, taken at boot and never given back, cut as budget.h says.
// Throws bad_alloc when the machine has not that much: then there is no appliance. Thread: main makes it;
// each span then has one user.
#pragma once

#include <cstddef>
#include <span>

#include "firmware/base/budget.h"
#include "firmware/base/page_block.h"

namespace relievo::firmware {

class BootMemory {
 public:
  explicit BootMemory(const budget::MemoryPlan& plan = budget::kLargestPlan)
      : BootMemory(plan.frames, plan.products, plan.scratch, plan.sides, plan.follow) {}
  // Tests shrink it until nothing fits.
  BootMemory(std::size_t frame_bytes, std::size_t output_bytes, std::size_t scratch_bytes,
             std::size_t sides_bytes = 0, std::size_t follow_bytes = 0)
      : block_(frame_bytes + output_bytes + scratch_bytes + sides_bytes + follow_bytes),
        frames_(block_.bytes().first(frame_bytes)),
        output_(frames_.data() + frame_bytes, output_bytes),
        scratch_(output_.data() + output_bytes, scratch_bytes),
        sides_(scratch_.data() + scratch_bytes, sides_bytes),
        follow_(sides_.data() + sides_bytes, follow_bytes) {}

  std::span<std::byte> frames() const { return frames_; }
  std::span<std::byte> output() const { return output_; }
  std::span<std::byte> scratch() const { return scratch_; }
  std::span<std::byte> sides() const { return sides_; }
  std::span<std::byte> follow() const { return follow_; }
  std::span<const std::byte> all() const { return block_.bytes(); }

 private:
  PageBlock block_;
  std::span<std::byte> frames_;
  std::span<std::byte> output_;
  std::span<std::byte> scratch_;
  std::span<std::byte> sides_;   // session/session.h
  std::span<std::byte> follow_;  // of the capture thread, while the worker has the others
};

}  // namespace relievo::firmware
