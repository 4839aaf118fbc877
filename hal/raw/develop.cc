// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/raw/develop.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "hal/base/assert.h"

namespace relievo::hal {
namespace {

// Samples of 10 and 12 bit, packed or not, into whole bytes: scaled so that white stays white.
// Shapes are checked before (check_shape(), is_short()). Thread: any.

// Each reader gives sample x of a row.
template <int kBits>
struct Loose {
  static constexpr int bits = kBits;
  static unsigned sample(const std::uint8_t* row, int x) {
    const unsigned value = row[2 * x] | unsigned(row[2 * x + 1]) << 8U;
    return std::min(value, (1U << kBits) - 1U);
  }
};

// Groups of samples, their high bytes first, then one byte with the low bits of all.
template <int kBits>
struct Packed {
  static constexpr int bits = kBits;
  static unsigned sample(const std::uint8_t* row, int x) {
    constexpr int low_bits = kBits - 8, count = 8 / low_bits;
    const std::uint8_t* group = row + x / count * (count + 1);
    const int i = x % count;
    return unsigned(group[i]) << low_bits |
           (unsigned(group[count]) >> (low_bits * i) & ((1U << low_bits) - 1U));
  }
};

template <int kBits>
struct To16 {
  using Out = std::uint16_t;
  // The high bits once more below the low ones: the largest sample becomes the largest number.
  static Out of(unsigned v) { return static_cast<Out>(v << (16 - kBits) | v >> (2 * kBits - 16)); }
};

template <int kBits>
struct To8 {
  using Out = std::uint8_t;
  static Out of(unsigned v) {
    constexpr unsigned white = (1U << kBits) - 1U;
    return static_cast<Out>((v * 255U + white / 2) / white);
  }
};

template <typename Reader, template <int> typename Scale>
void unpack(const RawImage& raw, std::byte* out) {
  using Out = typename Scale<Reader::bits>::Out;
  for (int y = 0; y < raw.height_px; ++y) {
    const auto* row = reinterpret_cast<const std::uint8_t*>(raw.bytes) + std::ptrdiff_t(y) * raw.stride_bytes;
    for (int x = 0; x < raw.width_px; ++x) {
      const Out value = Scale<Reader::bits>::of(Reader::sample(row, x));
      std::memcpy(out, &value, sizeof value);
      out += sizeof value;
    }
  }
}

// Of a JPEG only the stream knows: then the most it can be.
PixelFormat developed_format(const RawFormat& format) {
  if (!is_samples(format.coding) || format.filter != ColourFilter::None) return PixelFormat::Rgb8;
  return format.coding == RawCoding::Bits8 ? PixelFormat::Grey8 : PixelFormat::Grey16;
}

void copy_rows(const RawImage& raw, std::byte* out) {
  const std::size_t row_bytes = raw_row_bytes(raw.format.coding, raw.width_px);
  if (std::size_t(raw.stride_bytes) == row_bytes) {
    std::memcpy(out, raw.bytes, row_bytes * std::size_t(raw.height_px));
    return;
  }
  for (int y = 0; y < raw.height_px; ++y)
    std::memcpy(out + std::size_t(y) * row_bytes, raw.bytes + std::ptrdiff_t(y) * raw.stride_bytes,
                row_bytes);
}

// Without padding. To16: of 10 and 12 bit Grey16, white 65535. To8: white 255, rounded to the nearest.
template <template <int> typename Scale>
void plain_rows(const RawImage& raw, std::byte* out) {
  switch (raw.format.coding) {
    case RawCoding::Bits10: return unpack<Loose<10>, Scale>(raw, out);
    case RawCoding::Bits12: return unpack<Loose<12>, Scale>(raw, out);
    case RawCoding::Packed10: return unpack<Packed<10>, Scale>(raw, out);
    case RawCoding::Packed12: return unpack<Packed<12>, Scale>(raw, out);
    case RawCoding::Bits8:
    case RawCoding::Bits16:
    case RawCoding::Rgb8: return copy_rows(raw, out);
    case RawCoding::Yuyv:
    case RawCoding::Nv12:
    case RawCoding::Mjpeg: break;
  }
  RELIEVO_ASSERT(false && "these are no rows of samples");
}

Result<void> fill(const RawImage& raw, ImageView& view, std::byte* out, std::byte* scratch) {
  const RawCoding coding = raw.format.coding;
  if (raw.format.filter != ColourFilter::None) {
    // In the scratch, because OpenCV's edge-aware demosaic is wrong for rows with padding (seen in 4.6).
    plain_rows<To8>(raw, scratch);
    const auto bytes = std::size_t(raw.width_px) * std::size_t(raw.height_px);
    return demosaic(
        {scratch, bytes, raw.width_px, raw.height_px, raw.width_px, {RawCoding::Bits8, raw.format.filter}},
        out);
  }
  if (coding == RawCoding::Yuyv || coding == RawCoding::Nv12) return yuv_to_rgb(raw, out);
  if (coding == RawCoding::Mjpeg) {
    RELIEVO_TRY_ASSIGN(view.format, decode_jpeg(raw, out));
    view.stride_bytes = view.width_px * bytes_per_pixel(view.format);
    return {};
  }
  plain_rows<To16>(raw, out);
  return {};
}

}  // namespace

std::size_t develop_scratch_bytes(const RawFormat& format, int width_px, int height_px) {
  if (format.filter == ColourFilter::None) return 0;
  return std::size_t(width_px) * std::size_t(height_px);
}

Result<ImageView> develop(const RawImage& raw, std::span<std::byte> room, std::span<std::byte> scratch) {
  RELIEVO_TRY(check_shape(raw));
  if (is_short(raw)) return invalid("the camera's picture has too few bytes: check its cable");
  ImageView view{room.data(), raw.width_px, raw.height_px, 0, developed_format(raw.format)};
  view.stride_bytes = raw.width_px * bytes_per_pixel(view.format);
  if (std::size_t(view.stride_bytes) * std::size_t(raw.height_px) > room.size() ||
      develop_scratch_bytes(raw.format, raw.width_px, raw.height_px) > scratch.size())
    return invalid(
        "the picture is larger than those that memory was taken for at the start: choose a smaller mode");
  RELIEVO_TRY(fill(raw, view, room.data(), scratch.data()));
  return view;
}

}  // namespace relievo::hal
