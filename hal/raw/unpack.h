// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Samples of 8 to 16 bit, packed or not, into whole bytes: scaled so that white stays white.
// Shapes are checked before (check_shape(), is_short()). Thread: any.
#pragma once

#include <cstddef>

#include "hal/raw/raw_image.h"

namespace relievo::hal {

// Grey16, white 65535; width_px * 2 bytes a row, no padding. Of 10 to 16 bit.
void unpack_to_16_bit(const RawImage& raw, std::byte* out);
// White 255, rounded to the nearest; width_px bytes a row, no padding. Of 10 and 12 bit.
void unpack_to_8_bit(const RawImage& raw, std::byte* out);

}  // namespace relievo::hal
