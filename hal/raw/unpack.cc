// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/raw/unpack.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "hal/base/assert.h"

namespace relievo::hal {
namespace {

// Each reader gives sample x of a row.
template <int kBits>
struct Loose {
  static constexpr int bits = kBits;
  static unsigned sample(const std::uint8_t* row, int x) {
    const unsigned value = row[2 * x] | static_cast<unsigned>(row[2 * x + 1]) << 8U;
    return std::min(value, (1U << kBits) - 1U);
  }
};

struct Mipi10 {
  static constexpr int bits = 10;
  static unsigned sample(const std::uint8_t* row, int x) {
    const std::uint8_t* four = row + x / 4 * 5;
    const int i = x % 4;
    return static_cast<unsigned>(four[i]) << 2U | (static_cast<unsigned>(four[4]) >> (2 * i) & 3U);
  }
};

struct Mipi12 {
  static constexpr int bits = 12;
  static unsigned sample(const std::uint8_t* row, int x) {
    const std::uint8_t* two = row + x / 2 * 3;
    const int i = x % 2;
    return static_cast<unsigned>(two[i]) << 4U | (static_cast<unsigned>(two[2]) >> (4 * i) & 15U);
  }
};

template <int kBits>
struct To16 {
  using Out = std::uint16_t;
  // The high bits once more below the low ones: the largest sample becomes the largest number.
  static Out of(unsigned v) {
    return static_cast<Out>(kBits == 16 ? v : v << (16 - kBits) | v >> (2 * kBits - 16));
  }
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
    const auto* row =
        reinterpret_cast<const std::uint8_t*>(raw.bytes) + static_cast<std::ptrdiff_t>(y) * raw.stride_bytes;
    for (int x = 0; x < raw.width_px; ++x) {
      const Out value = Scale<Reader::bits>::of(Reader::sample(row, x));
      std::memcpy(out, &value, sizeof value);
      out += sizeof value;
    }
  }
}

}  // namespace

void unpack_to_16_bit(const RawImage& raw, std::byte* out) {
  switch (raw.format.coding) {
    case RawCoding::Bits10:
      return unpack<Loose<10>, To16>(raw, out);
    case RawCoding::Bits12:
      return unpack<Loose<12>, To16>(raw, out);
    case RawCoding::Bits16:
      return unpack<Loose<16>, To16>(raw, out);
    case RawCoding::Packed10:
      return unpack<Mipi10, To16>(raw, out);
    case RawCoding::Packed12:
      return unpack<Mipi12, To16>(raw, out);
    case RawCoding::Bits8:
    case RawCoding::Rgb8:
    case RawCoding::Yuyv:
    case RawCoding::Nv12:
    case RawCoding::Mjpeg:
      break;
  }
  RELIEVO_ASSERT(false && "these are no samples of more than 8 bit");
}

void unpack_to_8_bit(const RawImage& raw, std::byte* out) {
  switch (raw.format.coding) {
    case RawCoding::Bits10:
      return unpack<Loose<10>, To8>(raw, out);
    case RawCoding::Bits12:
      return unpack<Loose<12>, To8>(raw, out);
    case RawCoding::Packed10:
      return unpack<Mipi10, To8>(raw, out);
    case RawCoding::Packed12:
      return unpack<Mipi12, To8>(raw, out);
    case RawCoding::Bits8:
    case RawCoding::Bits16:
    case RawCoding::Rgb8:
    case RawCoding::Yuyv:
    case RawCoding::Nv12:
    case RawCoding::Mjpeg:
      break;
  }
  RELIEVO_ASSERT(false && "these are no samples of 10 or 12 bit");
}

}  // namespace relievo::hal
