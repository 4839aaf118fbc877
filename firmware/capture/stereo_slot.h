// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// StereoSlot: room for one pair of pictures, in memory taken at boot. A driver's picture is developed
// straight into it (hal/raw/develop.h), rows without padding: the one copy. wipe() leaves no pixel behind.
// Errors: InvalidInput for a picture larger than the slot, and what develop() says.
// Thread: whoever holds the slot.
#pragma once

#include <cstddef>
#include <span>

#include "hal/base/image_view.h"
#include "hal/base/result.h"
#include "hal/raw/raw_image.h"

namespace relievo::firmware {

class StereoSlot {
 public:
  // Cuts the block as budget::kStereoSlotBytes does: three bytes a pixel for the left, three for the
  // right, and one for developing.
  explicit StereoSlot(std::span<std::byte> block)
      : left_{block.first(block.size() / 7 * 3)},
        right_{block.subspan(block.size() / 7 * 3, block.size() / 7 * 3)},
        scratch_(block.subspan(block.size() / 7 * 6)) {}

  Result<ImageView> keep_left(const hal::RawImage& raw) { return keep(left_, raw); }
  Result<ImageView> keep_right(const hal::RawImage& raw) { return keep(right_, raw); }
  bool holds(const ImageView& view) const {
    const std::byte* const end = right_.room.data() + right_.room.size();
    return view.bytes >= left_.room.data() && view.bytes < end;
  }
  void wipe();

 private:
  struct Plane {
    std::span<std::byte> room;
    std::size_t used = 0;  // the most ever written since the last wipe
  };
  Result<ImageView> keep(Plane& plane, const hal::RawImage& raw);

  Plane left_;
  Plane right_;
  std::span<std::byte> scratch_;
  std::size_t scratch_used_ = 0;
};

}  // namespace relievo::firmware
