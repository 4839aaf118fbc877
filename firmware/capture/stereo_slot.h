// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// StereoSlot: room for one pair of pictures, in memory taken at boot. Pictures are copied in once,
// rows without padding. wipe() leaves no pixel behind.
// Errors: InvalidInput for a picture larger than the slot. Thread: whoever holds the slot.
#pragma once

#include <cstddef>
#include <span>

#include "hal/base/image_view.h"
#include "hal/base/result.h"

namespace relievo::firmware {

class StereoSlot {
 public:
  // Halves the block: left, right.
  explicit StereoSlot(std::span<std::byte> block)
      : left_{block.first(block.size() / 2)}, right_{block.subspan(block.size() / 2)} {}

  Result<ImageView> keep_left(const ImageView& image) { return keep(left_, image); }
  Result<ImageView> keep_right(const ImageView& image) { return keep(right_, image); }
  void wipe();

 private:
  struct Plane {
    std::span<std::byte> room;
    std::size_t used = 0;  // the most ever copied since the last wipe
  };
  static Result<ImageView> keep(Plane& plane, const ImageView& image);

  Plane left_;
  Plane right_;
};

}  // namespace relievo::firmware
