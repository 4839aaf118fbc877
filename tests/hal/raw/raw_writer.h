// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A painted picture with known colours, and the slow, obvious way in which a camera would send it in
// each raw format: the twin against which develop() is judged.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "hal/raw/raw_image.h"

namespace relievo::hal {

// Red, green, blue, each 0 to 1.
using Colour = std::array<double, 3>;
using Painting = std::function<Colour(int x, int y)>;

// Smooth everywhere, every hue of a face, no channel a multiple of another.
inline Colour smooth_paint(int x, int y) {
  return {0.55 + 0.35 * std::sin(0.045 * x + 0.3), 0.45 + 0.3 * std::cos(0.05 * y + 0.02 * x),
          0.4 + 0.3 * std::sin(0.03 * (x + y))};
}
inline double grey_paint(int x, int y) { return smooth_paint(x, y)[1]; }

// The bytes a camera sends, with a stride longer than its row.
struct Sent {
  std::vector<std::byte> bytes;
  RawImage raw;
};

inline Sent sent_buffer(RawFormat format, int width, int height, int padding) {
  Sent sent;
  sent.raw.width_px = width;
  sent.raw.height_px = height;
  sent.raw.format = format;
  sent.raw.stride_bytes = static_cast<int>(raw_row_bytes(format.coding, width)) + padding;
  const int rows = format.coding == RawCoding::Nv12 ? height * 3 / 2 : height;
  sent.bytes.assign(static_cast<std::size_t>(rows) * static_cast<std::size_t>(sent.raw.stride_bytes),
                    std::byte{0xA5});
  sent.raw.bytes = sent.bytes.data();
  sent.raw.size_bytes = sent.bytes.size();
  return sent;
}

inline int bits_of(RawCoding coding) {
  if (coding == RawCoding::Bits8) return 8;
  if (coding == RawCoding::Bits16) return 16;
  return coding == RawCoding::Bits10 || coding == RawCoding::Packed10 ? 10 : 12;
}

inline unsigned quantised(double value, int bits) {
  return static_cast<unsigned>(std::lround(value * ((1 << bits) - 1)));
}

// Sets bit `bit` of a packed row's sample: MIPI puts the high 8 bits first and the rest together behind.
inline void put_sample(std::byte* row, RawCoding coding, int x, unsigned value) {
  const auto put = [&](int at, unsigned v) { row[at] = std::byte(static_cast<unsigned char>(v & 255U)); };
  const auto add = [&](int at, unsigned v) { row[at] |= std::byte(static_cast<unsigned char>(v)); };
  switch (coding) {
    case RawCoding::Bits8: return put(x, value);
    case RawCoding::Packed10:
      put(x / 4 * 5 + x % 4, value >> 2U);
      if (x % 4 == 0) put(x / 4 * 5 + 4, 0);
      return add(x / 4 * 5 + 4, (value & 3U) << (2 * (x % 4)));
    case RawCoding::Packed12:
      put(x / 2 * 3 + x % 2, value >> 4U);
      if (x % 2 == 0) put(x / 2 * 3 + 2, 0);
      return add(x / 2 * 3 + 2, (value & 15U) << (4 * (x % 2)));
    case RawCoding::Bits10:
    case RawCoding::Bits12:
    case RawCoding::Bits16:
    case RawCoding::Rgb8:
    case RawCoding::Yuyv:
    case RawCoding::Nv12:
    case RawCoding::Mjpeg: break;
  }
  put(2 * x, value);
  put(2 * x + 1, value >> 8U);
}

// Which colour the filter lets through at a pixel: 0 red, 1 green, 2 blue.
inline int channel_at(ColourFilter filter, int x, int y) {
  const char* const pattern = filter == ColourFilter::Rggb   ? "RGGB"
                              : filter == ColourFilter::Grbg ? "GRBG"
                              : filter == ColourFilter::Gbrg ? "GBRG"
                                                             : "BGGR";
  const char c = pattern[2 * (y % 2) + x % 2];
  return c == 'R' ? 0 : c == 'G' ? 1 : 2;
}

inline Sent send_samples(RawFormat format, int width, int height, int padding, const Painting& paint) {
  Sent sent = sent_buffer(format, width, height, padding);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int channel = format.filter == ColourFilter::None ? 1 : channel_at(format.filter, x, y);
      const double value = paint(x, y)[static_cast<std::size_t>(channel)];
      put_sample(sent.bytes.data() + y * sent.raw.stride_bytes, format.coding, x,
                 quantised(value, bits_of(format.coding)));
    }
  return sent;
}

// ITU-R BT.601, limited range: luma 16 to 235, chroma 16 to 240 about 128.
inline std::array<double, 3> yuv_of(const Colour& c) {
  const double luma = 0.299 * c[0] + 0.587 * c[1] + 0.114 * c[2];
  return {16 + 219 * luma, 128 + 224 * 0.5 * (c[2] - luma) / (1 - 0.114),
          128 + 224 * 0.5 * (c[0] - luma) / (1 - 0.299)};
}

inline Sent send_yuv(RawCoding coding, int width, int height, int padding, const Painting& paint) {
  Sent sent = sent_buffer({coding}, width, height, padding);
  const auto put = [&](int row, int at, double v) {
    sent.bytes[static_cast<std::size_t>(row * sent.raw.stride_bytes + at)] =
        std::byte(static_cast<unsigned char>(std::lround(v)));
  };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto yuv = yuv_of(paint(x, y));
      if (coding == RawCoding::Yuyv) {
        put(y, 2 * x, yuv[0]);
        put(y, 2 * x + 1, yuv[x % 2 == 0 ? 1 : 2]);
      } else {
        put(y, x, yuv[0]);
        if (y % 2 == 0) put(height + y / 2, x, yuv[x % 2 == 0 ? 1 : 2]);
      }
    }
  return sent;
}

}  // namespace relievo::hal
