// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// BootMemory: the one block, taken at boot and never given back, cut as budget.h says.
// A page that nothing touches costs nothing. Throws bad_alloc when the machine has not that much:
// then there is no appliance. Thread: main makes it; each span then has one user.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "firmware/budget.h"

namespace relievo::firmware {

class BootMemory {
 public:
  BootMemory() : BootMemory(budget::kFramePoolBytes, budget::kOutputArenaBytes, budget::kScratchArenaBytes) {}
  // Tests shrink it until nothing fits.
  BootMemory(std::size_t frame_bytes, std::size_t output_bytes, std::size_t scratch_bytes)
      : block_(new std::byte[frame_bytes + output_bytes + scratch_bytes]),
        frames_(block_.get(), frame_bytes),
        output_(block_.get() + frame_bytes, output_bytes),
        scratch_(block_.get() + frame_bytes + output_bytes, scratch_bytes) {}

  std::span<std::byte> frames() const { return frames_; }
  std::span<std::byte> output() const { return output_; }
  std::span<std::byte> scratch() const { return scratch_; }
  std::span<const std::byte> all() const {
    return {block_.get(), frames_.size() + output_.size() + scratch_.size()};
  }

 private:
  std::unique_ptr<std::byte[]> block_;  // not value-initialised: pages stay untouched
  std::span<std::byte> frames_;
  std::span<std::byte> output_;
  std::span<std::byte> scratch_;
};

}  // namespace relievo::firmware
