// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/capture/stereo_slot.h"

#include <algorithm>

#include <string.h>

#include "hal/raw/develop.h"

namespace relievo::firmware {

Result<ImageView> StereoSlot::keep(Plane& plane, const hal::RawImage& raw) {
  // Before it is known whether all goes well: half a developed picture is to be wiped too.
  if (hal::check_shape(raw)) {
    const std::size_t pixels =
        static_cast<std::size_t>(raw.width_px) * static_cast<std::size_t>(raw.height_px);
    plane.used = std::max(plane.used, std::min(3 * pixels, plane.room.size()));
    scratch_used_ = std::max(
        scratch_used_,
        std::min(hal::develop_scratch_bytes(raw.format, raw.width_px, raw.height_px), scratch_.size()));
  }
  return hal::develop(raw, plane.room, scratch_);
}

void StereoSlot::wipe() {
  for (Plane* plane : {&left_, &right_}) {
    explicit_bzero(plane->room.data(), plane->used);
    plane->used = 0;
  }
  explicit_bzero(scratch_.data(), scratch_used_);
  scratch_used_ = 0;
}

}  // namespace relievo::firmware
