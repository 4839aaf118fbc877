// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// RawImage: one picture as a driver hands it over, in memory that the driver owns: samples of a sensor, YUV,
// or a compressed stream. Row-major; samples of more than 8 bit are little-endian. Thread: any.
#pragma once

#include <cstddef>
#include <cstdint>

#include "hal/base/image_view.h"
#include "hal/base/result.h"

namespace relievo::hal {

enum class RawCoding : std::uint8_t {
  Bits8,   // one sample in each byte
  Bits10,  // one sample in the low bits of 2 bytes; so are 12 and 16
  Bits12,
  Bits16,
  Packed10,  // MIPI RAW10: 4 samples in 5 bytes, four high bytes, then the low bits, first sample lowest
  Packed12,  // MIPI RAW12: 2 samples in 3 bytes, likewise
  Rgb8,
  Yuyv,  // BT.601, limited range
  Nv12,  // the same; its chroma rows follow its luma rows, same stride
  Mjpeg  // one JPEG picture; it may leave out its Huffman tables, as webcams do
};

// The colours over the sensor's pixels: top left two of the first row, then two of the second.
enum class ColourFilter : std::uint8_t { None, Rggb, Grbg, Gbrg, Bggr };

struct RawFormat {
  RawCoding coding = RawCoding::Bits8;
  ColourFilter filter = ColourFilter::None;  // of samples only; None: grey

  friend bool operator==(const RawFormat&, const RawFormat&) = default;
};

struct RawImage {
  const std::byte* bytes = nullptr;
  std::size_t size_bytes = 0;  // how many of them the driver has filled
  int width_px = 0;
  int height_px = 0;
  int stride_bytes = 0;  // Mjpeg: none
  RawFormat format;
};

inline constexpr int kMaxRawSidePx = 8192;

constexpr bool is_samples(RawCoding coding) { return coding <= RawCoding::Packed12; }

// Bytes of one row without padding; 0 for Mjpeg.
std::size_t raw_row_bytes(RawCoding coding, int width_px);
// Bytes that a whole picture has at least (the last row may leave out its padding); 0 for Mjpeg.
std::size_t raw_whole_bytes(const RawImage& raw);
// Can such a picture be developed at all? InvalidInput: no pixels, a side over the limit, a stride below
// its row, odd sides where two pixels share a colour, a colour filter over what are no samples.
Result<void> check_shape(const RawImage& raw);
// Has the driver filled all of it? An empty stream is short too.
bool is_short(const RawImage& raw);

// A picture that needs no developing, as a RawImage.
RawImage raw_of(const ImageView& view);

}  // namespace relievo::hal
