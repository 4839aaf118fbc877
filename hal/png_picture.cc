// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/picture_file.h"

#include <png.h>

#include <bit>
#include <csetjmp>
#include <cstdlib>
#include <cstring>
#include <new>

namespace relievo::hal {
namespace {

// libpng is C: no exception may pass through it, and when it fails it jumps. So what it calls notes that
// memory was refused, and the functions that may be jumped out of have nothing in them with a destructor.
extern "C" {
static png_voidp take(png_structp png, png_alloc_size_t size) {
  void* const taken = std::malloc(size);
  if (taken == nullptr) *static_cast<bool*>(png_get_mem_ptr(png)) = true;
  return taken;
}
static void give_back(png_structp, png_voidp memory) { std::free(memory); }
static void say_nothing(png_structp, png_const_charp) {}
// libpng's own prints a line first; whoever called us tells what is wrong.
[[noreturn]] static void jump_back(png_structp png, png_const_charp) { png_longjmp(png, 1); }

static void append(png_structp png, png_bytep bytes, std::size_t size) {
  auto& out = *static_cast<std::vector<std::byte>*>(png_get_io_ptr(png));
  bool full = false;
  try {
    out.insert(out.end(), reinterpret_cast<const std::byte*>(bytes),
               reinterpret_cast<const std::byte*>(bytes) + size);
  } catch (const std::bad_alloc&) {
    full = true;
  }
  if (full) png_error(png, "out of memory");
}
static void flush(png_structp) {}

static void read(png_structp png, png_bytep to, std::size_t size) {
  auto& from = *static_cast<std::span<const std::byte>*>(png_get_io_ptr(png));
  if (size > from.size()) png_error(png, "cut off");
  std::memcpy(to, from.data(), size);
  from = from.subspan(size);
}
}

bool write(const ImageView& image, const PngForm& form, std::vector<std::byte>* out) {
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, jump_back, say_nothing);
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
  if (info == nullptr || setjmp(png_jmpbuf(png)) != 0) {  // NOLINT(cert-err52-cpp): C has no other way out
    png_destroy_write_struct(&png, &info);
    return false;
  }
  const bool colour = image.format == PixelFormat::Rgb8, deep = image.format == PixelFormat::Grey16;
  png_set_write_fn(png, out, append, flush);
  png_set_compression_level(png, form.level);
  if (form.level <= kQuickPng)
    png_set_filter(png, PNG_FILTER_TYPE_BASE, colour ? PNG_FILTER_AVG : PNG_FILTER_UP);
  png_set_IHDR(png, info, png_uint_32(image.width_px), png_uint_32(image.height_px), deep ? 16 : 8,
               colour ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (colour && form.is_srgb) png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_write_info(png, info);
  if (deep && std::endian::native == std::endian::little) png_set_swap(png);
  for (int y = 0; y < image.height_px; ++y) png_write_row(png, image.row(y));
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return true;
}

// Of a picture that is being read: its size and kind are known before its pixels have room.
struct Reading {
  png_structp png = nullptr;
  png_infop info = nullptr;

  ~Reading() { png_destroy_read_struct(&png, &info, nullptr); }
};

bool begin(Reading& reading, bool* refused, std::span<const std::byte>* bytes) {
  reading.png = png_create_read_struct_2(PNG_LIBPNG_VER_STRING, nullptr, jump_back, say_nothing, refused,
                                         take, give_back);
  reading.info = reading.png == nullptr ? nullptr : png_create_info_struct(reading.png);
  if (reading.info == nullptr) return false;
  if (setjmp(png_jmpbuf(reading.png)) != 0) return false;  // NOLINT(cert-err52-cpp): C has no other way out
  png_structp const png = reading.png;
  png_set_user_limits(png, kMaxPictureSidePx, kMaxPictureSidePx);
  png_set_read_fn(png, bytes, read);
  png_read_info(png, reading.info);
  png_set_palette_to_rgb(png);
  png_set_expand_gray_1_2_4_to_8(png);
  png_set_strip_alpha(png);
  if ((png_get_color_type(png, reading.info) & PNG_COLOR_MASK_COLOR) != 0) png_set_scale_16(png);
  else if (std::endian::native == std::endian::little) png_set_swap(png);
  png_set_interlace_handling(png);
  png_read_update_info(png, reading.info);
  return true;
}

bool read_rows(Reading& reading, png_bytep* rows) {
  if (setjmp(png_jmpbuf(reading.png)) != 0) return false;  // NOLINT(cert-err52-cpp)
  png_read_image(reading.png, rows);
  png_read_end(reading.png, nullptr);
  return true;
}

}  // namespace

Result<std::vector<std::byte>> encode_png(const ImageView& image, const PngForm& form) try {
  if (image.empty()) return invalid("there is no picture to write");
  std::vector<std::byte> out;
  out.reserve(std::size_t(image.width_px) * std::size_t(image.height_px * bytes_per_pixel(image.format)) / 2);
  if (write(image, form, &out)) return out;
  return Error{Errc::OutOfMemory, "no memory to encode a picture"};
} catch (const std::bad_alloc&) {
  return Error{Errc::OutOfMemory, "no memory to encode a picture"};
}

Result<Picture> decode_png(std::span<const std::byte> bytes) try {
  bool refused = false;
  Reading reading;
  const auto failed = [&refused] {
    return refused ? Error{Errc::OutOfMemory, "no memory to decode this picture"}
                   : invalid("this picture is damaged and cannot be decoded");
  };
  if (!begin(reading, &refused, &bytes)) return failed();
  const bool deep = png_get_bit_depth(reading.png, reading.info) == 16;
  Picture picture{{},
                  int(png_get_image_width(reading.png, reading.info)),
                  int(png_get_image_height(reading.png, reading.info)),
                  png_get_channels(reading.png, reading.info) == 3 ? PixelFormat::Rgb8
                  : deep                                           ? PixelFormat::Grey16
                                                                   : PixelFormat::Grey8};
  const std::size_t row_bytes = std::size_t(picture.width_px * bytes_per_pixel(picture.format));
  if (png_get_rowbytes(reading.png, reading.info) != row_bytes) return failed();
  picture.bytes.resize(row_bytes * std::size_t(picture.height_px));
  std::vector<png_bytep> rows;
  for (std::size_t y = 0; y < std::size_t(picture.height_px); ++y)
    rows.push_back(reinterpret_cast<png_bytep>(picture.bytes.data() + y * row_bytes));
  if (!read_rows(reading, rows.data())) return failed();
  return picture;
} catch (const std::bad_alloc&) {
  return Error{Errc::OutOfMemory, "no memory to decode this picture"};
}

}  // namespace relievo::hal
