// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a PNG or JPEG says about itself before anything is decoded, and whether all of it is there:
// decoders fill the missing rest of a truncated picture with grey, which a matcher would believe.
// Errors: InvalidInput (neither PNG nor JPEG, truncated, no size).
// Thread: any.
#pragma once

#include <cstddef>
#include <span>

#include "hal/base/result.h"

namespace relievo::hal {

struct PictureHeader {
  long width_px = 0;
  long height_px = 0;
};

Result<PictureHeader> read_picture_header(std::span<const std::byte> bytes);

}  // namespace relievo::hal
