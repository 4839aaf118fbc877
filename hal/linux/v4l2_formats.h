// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// V4L2's four-letter names of pixel formats, and ours. Thread: any.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "hal/raw/raw_image.h"

namespace relievo::hal {

struct V4l2Format {
  std::uint32_t fourcc = 0;
  RawFormat raw;
};
// Every format that can be developed, the best first: a face is to have its colour; samples before YUV;
// of a mosaic 8 bit, which is what it is developed to; of a grey sensor all its bits; JPEG last.
std::span<const V4l2Format> v4l2_formats();
std::optional<RawFormat> raw_format_of(std::uint32_t fourcc);

}  // namespace relievo::hal
