// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "storage/export/format/png_writer.h"

#include <png.h>

#include <bit>
#include <csetjmp>
#include <new>

namespace relievo::storage {
namespace {

// A photograph of a face: level 2 after the average filter takes a fifteenth of the default's time and a
// tenth more room (libpng tries all its filters, zlib looks long for what noise does not repeat).
constexpr int kLevel = 2;

struct Job {
  const std::byte* pixels;
  png_uint_32 width, height;
  std::size_t row_bytes;
  int bits, colour_type;
  std::vector<std::byte>* out;
};

extern "C" {
static void append(png_structp png, png_bytep bytes, std::size_t size) {
  auto& out = *static_cast<std::vector<std::byte>*>(png_get_io_ptr(png));
  bool full = false;
  try {
    out.insert(out.end(), reinterpret_cast<const std::byte*>(bytes),
               reinterpret_cast<const std::byte*>(bytes) + size);
  } catch (const std::bad_alloc&) {
    full = true;  // libpng is C: no exception may pass through it
  }
  if (full) png_error(png, "out of memory");
}
static void flush(png_structp) {}
static void say_nothing(png_structp, png_const_charp) {}
}

// libpng jumps out of here when it fails: nothing in this function has a destructor.
bool compress(const Job& job) {
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, say_nothing);
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
  if (info == nullptr || setjmp(png_jmpbuf(png)) != 0) {  // NOLINT(cert-err52-cpp): C has no other way out
    png_destroy_write_struct(&png, &info);
    return false;
  }
  png_set_write_fn(png, job.out, append, flush);
  png_set_compression_level(png, kLevel);
  png_set_filter(png, PNG_FILTER_TYPE_BASE,
                 job.bits == 8 && job.colour_type == PNG_COLOR_TYPE_RGB ? PNG_FILTER_AVG : PNG_FILTER_UP);
  png_set_IHDR(png, info, job.width, job.height, job.bits, job.colour_type, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (job.colour_type == PNG_COLOR_TYPE_RGB) png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_write_info(png, info);
  if (job.bits == 16 && std::endian::native == std::endian::little) png_set_swap(png);
  for (png_uint_32 y = 0; y < job.height; ++y)
    png_write_row(png, reinterpret_cast<png_const_bytep>(job.pixels + y * job.row_bytes));
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return true;
}

Result<std::vector<std::byte>> written(int width_px, int height_px, std::span<const std::byte> pixels,
                                       int bits, int channels) {
  if (width_px <= 0 || height_px <= 0) return Error{Errc::InvalidInput, "the picture has no pixels"};
  const std::size_t row_bytes = std::size_t(width_px) * std::size_t(channels * bits / 8);
  if (pixels.size() != row_bytes * std::size_t(height_px))
    return Error{Errc::InvalidInput, "the picture's size does not fit its pixels"};
  try {
    std::vector<std::byte> out;
    out.reserve(pixels.size() / 2);
    const Job job{pixels.data(),
                  static_cast<png_uint_32>(width_px),
                  static_cast<png_uint_32>(height_px),
                  row_bytes,
                  bits,
                  channels == 3 ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_GRAY,
                  &out};
    if (compress(job)) return out;
  } catch (const std::bad_alloc&) {
  }
  return Error{Errc::OutOfMemory, "not enough memory to compress a picture"};
}

}  // namespace

Result<std::vector<std::byte>> png_of_rgb(int width_px, int height_px, std::span<const std::uint8_t> rgb) {
  return written(width_px, height_px, std::as_bytes(rgb), 8, 3);
}

Result<std::vector<std::byte>> png_of_grey(int width_px, int height_px, std::span<const std::uint8_t> grey) {
  return written(width_px, height_px, std::as_bytes(grey), 8, 1);
}

Result<std::vector<std::byte>> png_of_grey16(int width_px, int height_px,
                                             std::span<const std::uint16_t> grey) {
  return written(width_px, height_px, std::as_bytes(grey), 16, 1);
}

}  // namespace relievo::storage
