// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/raw/develop.h"

#include <cstring>

#include "hal/raw/raw_colour.h"
#include "hal/raw/unpack.h"

namespace relievo::hal {
namespace {

// Of a JPEG only the stream knows: then the most it can be.
PixelFormat developed_format(const RawFormat& format) {
  if (!is_samples(format.coding) || format.filter != ColourFilter::None) return PixelFormat::Rgb8;
  return format.coding == RawCoding::Bits8 ? PixelFormat::Grey8 : PixelFormat::Grey16;
}

void copy_rows(const RawImage& raw, std::byte* out) {
  const std::size_t row_bytes = raw_row_bytes(raw.format.coding, raw.width_px);
  if (static_cast<std::size_t>(raw.stride_bytes) == row_bytes) {
    std::memcpy(out, raw.bytes, row_bytes * static_cast<std::size_t>(raw.height_px));
    return;
  }
  for (int y = 0; y < raw.height_px; ++y)
    std::memcpy(out + static_cast<std::size_t>(y) * row_bytes,
                raw.bytes + static_cast<std::ptrdiff_t>(y) * raw.stride_bytes, row_bytes);
}

// In the scratch, because OpenCV's edge-aware demosaic is wrong for rows with padding (seen in 4.6).
Result<void> develop_mosaic(const RawImage& raw, std::byte* rgb, std::byte* scratch) {
  if (raw.format.coding == RawCoding::Bits8) copy_rows(raw, scratch);
  else unpack_to_8_bit(raw, scratch);
  const RawImage mosaic{
      scratch,      static_cast<std::size_t>(raw.width_px) * static_cast<std::size_t>(raw.height_px),
      raw.width_px, raw.height_px,
      raw.width_px, {RawCoding::Bits8, raw.format.filter}};
  return demosaic(mosaic, rgb);
}

Result<void> fill(const RawImage& raw, ImageView& view, std::byte* out, std::byte* scratch) {
  if (raw.format.filter != ColourFilter::None) return develop_mosaic(raw, out, scratch);
  switch (raw.format.coding) {
    case RawCoding::Bits8:
    case RawCoding::Bits16:
    case RawCoding::Rgb8:
      copy_rows(raw, out);
      break;
    case RawCoding::Bits10:
    case RawCoding::Bits12:
    case RawCoding::Packed10:
    case RawCoding::Packed12:
      unpack_to_16_bit(raw, out);
      break;
    case RawCoding::Yuyv:
    case RawCoding::Nv12:
      return yuv_to_rgb(raw, out);
    case RawCoding::Mjpeg: {
      RELIEVO_TRY_ASSIGN(view.format, decode_jpeg(raw, out));
      view.stride_bytes = view.width_px * bytes_per_pixel(view.format);
      break;
    }
  }
  return {};
}

}  // namespace

std::size_t develop_scratch_bytes(const RawFormat& format, int width_px, int height_px) {
  if (format.filter == ColourFilter::None) return 0;
  return static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
}

Result<ImageView> develop(const RawImage& raw, std::span<std::byte> room, std::span<std::byte> scratch) {
  RELIEVO_TRY(check_shape(raw));
  if (is_short(raw))
    return Error{Errc::InvalidInput, "the camera's picture has too few bytes: check its cable"};
  ImageView view{room.data(), raw.width_px, raw.height_px, 0, developed_format(raw.format)};
  view.stride_bytes = raw.width_px * bytes_per_pixel(view.format);
  if (static_cast<std::size_t>(view.stride_bytes) * static_cast<std::size_t>(raw.height_px) > room.size() ||
      develop_scratch_bytes(raw.format, raw.width_px, raw.height_px) > scratch.size())
    return Error{Errc::InvalidInput, "the picture is larger than budget.h allows: choose a smaller mode"};
  RELIEVO_TRY(fill(raw, view, room.data(), scratch.data()));
  return view;
}

}  // namespace relievo::hal
