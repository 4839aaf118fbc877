// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// PNG pictures of the kinds that others write and we do not, written here by libpng itself.
#include "hal/picture_file.h"

#include <gtest/gtest.h>
#include <png.h>

namespace relievo::hal {
namespace {

struct Kind {
  int bits, colour_type, interlace;
};

std::vector<std::byte> written(const Kind& kind, const std::vector<png_byte>& row) {
  std::vector<std::byte> out;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(
      png, &out,
      [](png_structp p, png_bytep bytes, std::size_t size) {
        auto& to = *static_cast<std::vector<std::byte>*>(png_get_io_ptr(p));
        to.insert(to.end(), reinterpret_cast<std::byte*>(bytes), reinterpret_cast<std::byte*>(bytes) + size);
      },
      [](png_structp) {});
  png_set_IHDR(png, info, 4, 3, kind.bits, kind.colour_type, kind.interlace, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  const png_color palette[4] = {{1, 2, 3}, {40, 50, 60}, {200, 100, 0}, {255, 255, 255}};
  const png_byte transparency[4] = {0, 128, 255, 255};
  if (kind.colour_type == PNG_COLOR_TYPE_PALETTE) {
    png_set_PLTE(png, info, palette, 4);
    png_set_tRNS(png, info, transparency, 4, nullptr);
  }
  png_write_info(png, info);
  std::vector<png_byte> same = row;
  png_bytep rows[3] = {same.data(), same.data(), same.data()};
  png_write_image(png, rows);
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return out;
}

// Every row of the picture is `row`; it must become `wanted`.
void expect(const Kind& kind, const std::vector<png_byte>& row, PixelFormat format,
            const std::vector<unsigned>& wanted) {
  const auto file = written(kind, row);
  const auto picture = decode_picture(file.data(), file.size());
  ASSERT_TRUE(picture) << picture.error().what.view();
  EXPECT_EQ(picture->format, format);
  ASSERT_EQ(picture->width_px, 4);
  ASSERT_EQ(picture->height_px, 3);
  ASSERT_EQ(picture->bytes.size(), 3 * wanted.size() * (format == PixelFormat::Grey16 ? 2 : 1));
  for (int y = 0; y < 3; ++y)
    for (std::size_t k = 0; k < wanted.size(); ++k) {
      const std::uint8_t* const at = picture->view().row(y);
      const unsigned value =
          format == PixelFormat::Grey16 ? reinterpret_cast<const std::uint16_t*>(at)[k] : at[k];
      EXPECT_EQ(value, wanted[k]) << "row " << y << ", value " << k;
    }
}

TEST(PngPicture, APaletteBecomesItsColours) {
  expect({2, PNG_COLOR_TYPE_PALETTE, 0}, {0b00011011}, PixelFormat::Rgb8,
         {1, 2, 3, 40, 50, 60, 200, 100, 0, 255, 255, 255});
}

TEST(PngPicture, BlackAndWhiteBecomesGreyOfEightBits) {
  expect({1, PNG_COLOR_TYPE_GRAY, 0}, {0b01010000}, PixelFormat::Grey8, {0, 255, 0, 255});
}

TEST(PngPicture, GreyOfSixteenBitsKeepsThemAlsoInterlaced) {
  for (const int interlace : {PNG_INTERLACE_NONE, PNG_INTERLACE_ADAM7})
    expect({16, PNG_COLOR_TYPE_GRAY, interlace}, {1, 2, 0, 0, 255, 255, 128, 0}, PixelFormat::Grey16,
           {0x0102, 0, 0xffff, 0x8000});
}

TEST(PngPicture, ColourOfSixteenBitsIsRoundedToEight) {
  std::vector<png_byte> row;
  for (unsigned k = 0; k < 12; ++k) row.insert(row.end(), {png_byte(20 * k), png_byte(k % 2 == 0 ? 0 : 255)});
  std::vector<unsigned> wanted;
  for (unsigned k = 0; k < 12; ++k)  // of 65535 to the nearest of 255
    wanted.push_back((20 * k * 256 + (k % 2 == 0 ? 0 : 255) + 128) / 257);
  expect({16, PNG_COLOR_TYPE_RGB, 0}, row, PixelFormat::Rgb8, wanted);
}

TEST(PngPicture, TransparencyIsDropped) {
  expect({8, PNG_COLOR_TYPE_RGB_ALPHA, 0}, {1, 2, 3, 0, 4, 5, 6, 9, 7, 8, 9, 255, 10, 11, 12, 128},
         PixelFormat::Rgb8, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12});
  expect({8, PNG_COLOR_TYPE_GRAY_ALPHA, 0}, {10, 0, 20, 255, 30, 128, 40, 1}, PixelFormat::Grey8,
         {10, 20, 30, 40});
}

}  // namespace
}  // namespace relievo::hal
