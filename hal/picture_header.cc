// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/picture_header.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace relievo::hal {
namespace {

constexpr std::array<unsigned, 8> kPngSignature = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};

unsigned byte_at(std::span<const std::byte> bytes, std::size_t i) {
  return std::to_integer<unsigned>(bytes[i]);
}

std::uint32_t big_endian_32(std::span<const std::byte> b, std::size_t i) {
  return byte_at(b, i) << 24 | byte_at(b, i + 1) << 16 | byte_at(b, i + 2) << 8 | byte_at(b, i + 3);
}
std::uint32_t big_endian_16(std::span<const std::byte> b, std::size_t i) {
  return byte_at(b, i) << 8 | byte_at(b, i + 1);
}

bool starts_with_png(std::span<const std::byte> b) {
  if (b.size() < kPngSignature.size()) return false;
  for (std::size_t i = 0; i < kPngSignature.size(); ++i)
    if (byte_at(b, i) != kPngSignature[i]) return false;
  return true;
}

Error truncated() { return Error{Errc::InvalidInput, "this picture is cut off; copy it again"}; }

// Walks the chunks (length, type, data, sum) to IEND: ISO/IEC 15948, 5.
Result<PictureHeader> png_header(std::span<const std::byte> b) {
  if (b.size() < 33) return truncated();
  if (big_endian_32(b, 12) != 0x49484452U)  // "IHDR"
    return Error{Errc::InvalidInput, "this PNG does not begin with its header"};
  const PictureHeader header{static_cast<long>(big_endian_32(b, 16)),
                             static_cast<long>(big_endian_32(b, 20))};
  std::size_t at = kPngSignature.size();
  while (b.size() - at >= 12) {
    const std::size_t length = big_endian_32(b, at);
    if (length > b.size() - at - 12) return truncated();
    if (big_endian_32(b, at + 4) == 0x49454e44U) return header;  // "IEND"
    at += 12 + length;
  }
  return truncated();
}

bool is_start_of_frame(unsigned marker) {
  return marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
}

// Camera firmware pads files with zeros after the end marker; anything else there is not an end.
bool ends_with_end_marker(std::span<const std::byte> b) {
  std::size_t last = b.size();
  while (last > 2 && byte_at(b, last - 1) == 0) --last;
  return last > 2 && byte_at(b, last - 1) == 0xd9 && byte_at(b, last - 2) == 0xff;
}

// Walks the segments to the frame header: ITU-T T.81, annex B.
Result<PictureHeader> jpeg_header(std::span<const std::byte> b) {
  std::size_t at = 2;
  while (at + 9 < b.size()) {
    if (byte_at(b, at) != 0xff) return Error{Errc::InvalidInput, "this JPEG is damaged"};
    const unsigned marker = byte_at(b, at + 1);
    if (marker == 0xff || marker == 0x01 || (marker >= 0xd0 && marker <= 0xd8)) {
      at += marker == 0xff ? 1 : 2;
      continue;
    }
    if (is_start_of_frame(marker)) {
      if (!ends_with_end_marker(b)) return truncated();
      return PictureHeader{static_cast<long>(big_endian_16(b, at + 7)),
                           static_cast<long>(big_endian_16(b, at + 5))};
    }
    at += 2 + big_endian_16(b, at + 2);
  }
  return truncated();
}

}  // namespace

Result<PictureHeader> read_picture_header(std::span<const std::byte> bytes) {
  if (bytes.empty()) return Error{Errc::InvalidInput, "this picture is empty"};
  if (starts_with_png(bytes)) return png_header(bytes);
  if (bytes.size() >= 3 && byte_at(bytes, 0) == 0xff && byte_at(bytes, 1) == 0xd8 &&
      byte_at(bytes, 2) == 0xff)
    return jpeg_header(bytes);
  return Error{Errc::InvalidInput, "this is neither a PNG nor a JPEG picture"};
}

}  // namespace relievo::hal
