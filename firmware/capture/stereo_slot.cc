// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/capture/stereo_slot.h"

#include <algorithm>
#include <cstring>

#include <string.h>

namespace relievo::firmware {

Result<ImageView> StereoSlot::keep(Plane& plane, const ImageView& image) {
  if (image.empty()) return Error{Errc::InvalidInput, "the camera gave a picture without pixels: check its cable"};
  const std::size_t row_bytes =
      static_cast<std::size_t>(image.width_px) * static_cast<std::size_t>(bytes_per_pixel(image.format));
  const std::size_t bytes = row_bytes * static_cast<std::size_t>(image.height_px);
  if (bytes > plane.room.size()) {
    return Error{Errc::InvalidInput, "the picture is larger than budget.h allows: choose a smaller mode"};
  }
  for (int y = 0; y < image.height_px; ++y) {
    std::memcpy(plane.room.data() + static_cast<std::size_t>(y) * row_bytes, image.row(y), row_bytes);
  }
  plane.used = std::max(plane.used, bytes);
  return ImageView{plane.room.data(), image.width_px, image.height_px, static_cast<int>(row_bytes), image.format};
}

void StereoSlot::wipe() {
  for (Plane* plane : {&left_, &right_}) {
    explicit_bzero(plane->room.data(), plane->used);
    plane->used = 0;
  }
}

}  // namespace relievo::firmware
