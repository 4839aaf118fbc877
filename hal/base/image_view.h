// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// ImageView: pixels that somebody else owns. Row-major, origin at the centre of the top left pixel.
#pragma once

#include <cstddef>
#include <cstdint>

namespace relievo {

enum class PixelFormat : std::uint8_t { Grey8, Rgb8, Grey16 };

constexpr int bytes_per_pixel(PixelFormat format) {
  return format == PixelFormat::Rgb8 ? 3 : format == PixelFormat::Grey16 ? 2 : 1;
}

struct ImageView {
  const std::byte* bytes = nullptr;
  int width_px = 0;
  int height_px = 0;
  // From one row to the next: a row's bytes at least. Less than nothing where the picture is stored from
  // below, as the rectifier takes it, too; `bytes` is then still its top row.
  int stride_bytes = 0;
  PixelFormat format = PixelFormat::Grey8;

  bool empty() const { return bytes == nullptr || width_px <= 0 || height_px <= 0; }
  bool rows_overlap() const {
    const std::int64_t row = std::int64_t{width_px} * bytes_per_pixel(format);
    return stride_bytes < row && stride_bytes > -row;
  }
  const std::uint8_t* row(int y) const {
    return reinterpret_cast<const std::uint8_t*>(bytes) + std::ptrdiff_t(y) * stride_bytes;
  }
};

}  // namespace relievo
