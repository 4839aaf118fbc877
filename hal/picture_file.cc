// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/picture_file.h"

#include <cctype>
#include <cstdint>
#include <new>
#include <string_view>

#include "hal/base/whole_file.h"
#include "hal/raw/develop.h"

namespace relievo::hal {
namespace {

constexpr std::string_view kPngSignature = "\x89PNG\r\n\x1a\n";

// What a PNG or JPEG says about itself before anything is decoded, and whether all of it is there:
// decoders fill the missing rest of a truncated picture with grey, which a matcher would believe.
struct PictureHeader {
  long width_px = 0;
  long height_px = 0;
};

unsigned byte_at(std::span<const std::byte> bytes, std::size_t i) {
  return std::to_integer<unsigned>(bytes[i]);
}

std::uint32_t big_endian_32(std::span<const std::byte> b, std::size_t i) {
  return byte_at(b, i) << 24 | byte_at(b, i + 1) << 16 | byte_at(b, i + 2) << 8 | byte_at(b, i + 3);
}
std::uint32_t big_endian_16(std::span<const std::byte> b, std::size_t i) {
  return byte_at(b, i) << 8 | byte_at(b, i + 1);
}

bool starts_with(std::span<const std::byte> b, std::string_view signature) {
  return std::string_view(reinterpret_cast<const char*>(b.data()), b.size()).starts_with(signature);
}

Error truncated() { return invalid("this picture is cut off; copy it again"); }

// Walks the chunks (length, type, data, sum) to IEND: ISO/IEC 15948, 5.
Result<PictureHeader> png_header(std::span<const std::byte> b) {
  if (b.size() < 33) return truncated();
  if (big_endian_32(b, 12) != 0x49484452U)  // "IHDR"
    return invalid("this PNG does not begin with its header");
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
    if (byte_at(b, at) != 0xff) return invalid("this JPEG is damaged");
    const unsigned marker = byte_at(b, at + 1);
    if (marker == 0xff || marker == 0x01 || (marker >= 0xd0 && marker <= 0xd8)) {
      at += marker == 0xff ? 1 : 2;
      continue;
    }
    if (marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc) {  // a frame
      if (!ends_with_end_marker(b)) return truncated();
      return PictureHeader{static_cast<long>(big_endian_16(b, at + 7)),
                           static_cast<long>(big_endian_16(b, at + 5))};
    }
    at += 2 + big_endian_16(b, at + 2);
  }
  return truncated();
}

Result<PictureHeader> header_of(std::span<const std::byte> bytes) {
  if (bytes.empty()) return invalid("this picture is empty");
  if (starts_with(bytes, kPngSignature)) return png_header(bytes);
  if (starts_with(bytes, "\xff\xd8\xff")) return jpeg_header(bytes);
  return invalid("this is neither a PNG nor a JPEG picture");
}

// No picture within the limits is larger than this, even stored without any compression.
constexpr std::size_t kMaxEncodedBytes = std::size_t(kMaxPictureAreaPx) * 8 + (1U << 20);

}  // namespace

std::string lower_extension(const std::filesystem::path& file) {
  std::string extension = file.extension().native();
  for (char& c : extension) c = char(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

Result<Picture> decode_picture(const std::byte* bytes, std::size_t size) try {
  RELIEVO_TRY_ASSIGN(const PictureHeader header, header_of({bytes, size}));
  if (header.width_px <= 0 || header.height_px <= 0) return invalid("this picture has no size");
  if (header.width_px > kMaxPictureSidePx || header.height_px > kMaxPictureSidePx ||
      header.width_px * header.height_px > kMaxPictureAreaPx)
    return invalid("this picture is larger than the limit of 8192 px a side and 40 megapixels");
  if (starts_with({bytes, size}, kPngSignature)) return decode_png({bytes, size});
  // The orientation tag is not read: a calibration knows the sensor's pixels, not how a viewer turns them.
  Picture picture{{}, int(header.width_px), int(header.height_px), PixelFormat::Rgb8};
  picture.bytes.resize(std::size_t(header.width_px * header.height_px) * 3);
  const RawImage raw{bytes, size, picture.width_px, picture.height_px, 0, {RawCoding::Mjpeg}};
  RELIEVO_TRY_ASSIGN(picture.format, decode_jpeg(raw, picture.bytes.data()));
  picture.bytes.resize(std::size_t(header.width_px * header.height_px * bytes_per_pixel(picture.format)));
  return picture;
} catch (const std::bad_alloc&) {
  return Error{Errc::OutOfMemory, "no memory to decode this picture"};
}

Result<Picture> read_picture(const std::filesystem::path& file) {
  RELIEVO_TRY_ASSIGN(const std::vector<std::byte> bytes, read_whole_file(file, kMaxEncodedBytes));
  return decode_picture(bytes.data(), bytes.size()).at(file.native());
}

Result<void> write_picture(const std::filesystem::path& file, const ImageView& image) {
  const std::string extension = lower_extension(file);
  const bool jpeg = extension == ".jpg" || extension == ".jpeg";
  if (!jpeg && extension != ".png")
    return invalid("pictures are written as .png or .jpg; choose one of these names").at(file.native());
  Result<std::vector<std::byte>> bytes = jpeg ? encode_jpeg(image, 95) : encode_png(image);
  if (!bytes) return bytes.error().at(file.native());
  return write_whole_file(file, *bytes);
}

}  // namespace relievo::hal
