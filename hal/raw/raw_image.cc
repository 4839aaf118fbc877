// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/raw/raw_image.h"

namespace relievo::hal {
namespace {

std::size_t rows_of(const RawImage& raw) {
  const auto height = std::size_t(raw.height_px);
  return raw.format.coding == RawCoding::Nv12 ? height + height / 2 : height;
}

}  // namespace

std::size_t raw_row_bytes(RawCoding coding, int width_px) {
  const auto width = std::size_t(width_px);
  switch (coding) {
    case RawCoding::Bits8:
    case RawCoding::Nv12: return width;
    case RawCoding::Bits10:
    case RawCoding::Bits12:
    case RawCoding::Bits16:
    case RawCoding::Yuyv: return 2 * width;
    case RawCoding::Packed10: return (width + 3) / 4 * 5;
    case RawCoding::Packed12: return (width + 1) / 2 * 3;
    case RawCoding::Rgb8: return 3 * width;
    case RawCoding::Mjpeg: break;
  }
  return 0;
}

std::size_t raw_whole_bytes(const RawImage& raw) {
  if (raw.format.coding == RawCoding::Mjpeg) return 0;
  return std::size_t(raw.stride_bytes) * (rows_of(raw) - 1) + raw_row_bytes(raw.format.coding, raw.width_px);
}

Result<void> check_shape(const RawImage& raw) {
  const RawCoding coding = raw.format.coding;
  if (raw.bytes == nullptr || raw.width_px <= 0 || raw.height_px <= 0)
    return invalid("the camera gave a picture without pixels: check its cable");
  if (raw.width_px > kMaxRawSidePx || raw.height_px > kMaxRawSidePx)
    return invalid("the camera's picture is larger than 8192 px a side: choose a smaller mode");
  if (coding != RawCoding::Mjpeg &&
      (raw.stride_bytes < 0 || std::size_t(raw.stride_bytes) < raw_row_bytes(coding, raw.width_px)))
    return invalid("the camera's rows are shorter than its picture is wide");
  const bool odd_width = raw.width_px % 2 != 0;
  const bool odd_height = raw.height_px % 2 != 0;
  if ((coding == RawCoding::Yuyv && odd_width) || (coding == RawCoding::Nv12 && (odd_width || odd_height)))
    return invalid("pixels that share their colour need even sides");
  if (raw.format.filter == ColourFilter::None) return {};
  if (!is_samples(coding) || coding == RawCoding::Bits16)
    return invalid("a colour filter lies over samples of 8, 10 or 12 bit only");
  if (odd_width || odd_height || raw.width_px < 4 || raw.height_px < 4)
    return invalid("a picture behind a colour filter needs even sides of at least 4 px");
  return {};
}

bool is_short(const RawImage& raw) { return raw.size_bytes == 0 || raw.size_bytes < raw_whole_bytes(raw); }

RawImage raw_of(const ImageView& view) {
  RawImage raw{view.bytes, 0, view.width_px, view.height_px, view.stride_bytes, {}};
  if (view.format == PixelFormat::Grey16) raw.format.coding = RawCoding::Bits16;
  if (view.format == PixelFormat::Rgb8) raw.format.coding = RawCoding::Rgb8;
  if (!view.empty()) raw.size_bytes = raw_whole_bytes(raw);
  return raw;
}

}  // namespace relievo::hal
