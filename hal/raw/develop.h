// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// develop(): makes of a RawImage a picture the pipeline reads, in memory of the caller's; this is the one
// copy between driver and stage. Pure: the same bytes give the same picture.
//
//   grey samples   8 bit: Grey8; 10, 12, 16 bit: Grey16, white is 65535; a sample over its range is white
//   colour filter  Rgb8, edge-aware (OpenCV's *_EA); 10 and 12 bit are rounded to 8 first; no white balance
//   Yuyv, Nv12     Rgb8, BT.601 limited range (OpenCV)
//   Mjpeg          Rgb8, or Grey8 where it has no colour (libjpeg-turbo)
//
// Grey samples and Rgb8 are copied without allocating; the libraries of the others may allocate.
// Errors: InvalidInput (check_shape(), too few bytes, a stream that is damaged, of another size or in
// another colour space, room too small), OutOfMemory, LibraryFailed. Thread: any.
#pragma once

#include <cstddef>
#include <span>

#include "hal/base/image_view.h"
#include "hal/base/result.h"
#include "hal/raw/raw_image.h"

namespace relievo::hal {

// Colour out of a mosaic, of YUV and of JPEG, into width_px * 3 bytes a row without padding. Shapes and room
// are checked before, but for what only the JPEG stream knows. Errors: OutOfMemory, LibraryFailed;
// decode_jpeg(): InvalidInput too. Thread: any. raw: Bits8 behind a colour filter, rows without padding.
Result<void> demosaic(const RawImage& raw, std::byte* rgb);
// raw: Yuyv or Nv12.
Result<void> yuv_to_rgb(const RawImage& raw, std::byte* rgb);
// raw: Mjpeg. Gives Rgb8, or Grey8 (a byte a pixel) for a stream without colour.
Result<PixelFormat> decode_jpeg(const RawImage& raw, std::byte* pixels);

// What develop() needs beside the picture's own room: a byte a pixel behind a colour filter.
std::size_t develop_scratch_bytes(const RawFormat& format, int width_px, int height_px);

// The view lies at the front of `room`, rows without padding.
Result<ImageView> develop(const RawImage& raw, std::span<std::byte> room, std::span<std::byte> scratch);

}  // namespace relievo::hal
