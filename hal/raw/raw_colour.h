// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Colour out of a mosaic, of YUV and of JPEG, into width_px * 3 bytes a row without padding.
// Shapes and room are checked before, but for what only the JPEG stream knows.
// Errors: OutOfMemory, LibraryFailed; decode_jpeg(): InvalidInput too. Thread: any.
#pragma once

#include <cstddef>

#include "hal/raw/raw_image.h"

namespace relievo::hal {

// raw: Bits8 behind a colour filter, rows without padding.
Result<void> demosaic(const RawImage& raw, std::byte* rgb);
// raw: Yuyv or Nv12.
Result<void> yuv_to_rgb(const RawImage& raw, std::byte* rgb);
// raw: Mjpeg. Gives Rgb8, or Grey8 (a byte a pixel) for a stream without colour.
Result<PixelFormat> decode_jpeg(const RawImage& raw, std::byte* pixels);

}  // namespace relievo::hal
