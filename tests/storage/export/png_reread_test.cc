// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The pictures we write, read again by libpng's own reader, value by value.
#include <gtest/gtest.h>
#include <png.h>

#include <cmath>
#include <cstring>
#include <span>
#include <string_view>
#include <vector>

#include "hal/picture_file.h"
#include "storage/export/model_files.h"
#include "tests/storage/sample.h"

namespace relievo::storage {
namespace {

struct PngPixels {
  int width = 0, height = 0, bits = 0, channels = 0;
  std::vector<unsigned> values;
};

// The plain reader: no conversion of any kind.
PngPixels reread(const std::vector<std::byte>& file) {
  PngPixels out;
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  struct Source {
    const std::byte* at;
    std::size_t left;
  } source{file.data(), file.size()};
  png_set_read_fn(png, &source, [](png_structp p, png_bytep to, std::size_t size) {
    auto& from = *static_cast<Source*>(png_get_io_ptr(p));
    if (size > from.left) png_error(p, "the file is too short");
    std::memcpy(to, from.at, size);
    from.at += size;
    from.left -= size;
  });
  png_read_png(png, info, PNG_TRANSFORM_IDENTITY, nullptr);
  out.width = static_cast<int>(png_get_image_width(png, info));
  out.height = static_cast<int>(png_get_image_height(png, info));
  out.bits = png_get_bit_depth(png, info);
  out.channels = png_get_channels(png, info);
  png_bytepp rows = png_get_rows(png, info);
  for (int y = 0; y < out.height; ++y)
    for (int k = 0; k < out.width * out.channels; ++k)
      out.values.push_back(out.bits == 8 ? rows[y][k]
                                         : static_cast<unsigned>(rows[y][2 * k] << 8 | rows[y][2 * k + 1]));
  png_destroy_read_struct(&png, &info, nullptr);
  return out;
}

TEST(PngPicture, EveryKindReadsBackValueByValue) {
  std::vector<std::uint8_t> rgb, grey;
  std::vector<std::uint16_t> deep;
  for (unsigned k = 0; k < 37 * 23; ++k) {
    for (unsigned c = 0; c < 3; ++c) rgb.push_back(static_cast<std::uint8_t>(k * 7 + c * 91));
    grey.push_back(static_cast<std::uint8_t>(k * 5));
    deep.push_back(static_cast<std::uint16_t>(k * 77));
  }
  const auto check = [](const auto& wanted, PixelFormat format, int level) {
    const auto bytes = std::as_bytes(std::span(wanted));
    const auto file =
        hal::encode_png({bytes.data(), 37, 23, 37 * bytes_per_pixel(format), format}, {.level = level});
    ASSERT_TRUE(file);
    const PngPixels got = reread(*file);
    EXPECT_EQ(got.width, 37);
    EXPECT_EQ(got.height, 23);
    EXPECT_EQ(got.bits, format == PixelFormat::Grey16 ? 16 : 8);
    EXPECT_EQ(got.channels, format == PixelFormat::Rgb8 ? 3 : 1);
    ASSERT_EQ(got.values.size(), wanted.size());
    for (std::size_t k = 0; k < wanted.size(); ++k) ASSERT_EQ(got.values[k], wanted[k]) << k;
  };
  for (const int level : {hal::kQuickPng, 9}) {
    check(rgb, PixelFormat::Rgb8, level);
    check(grey, PixelFormat::Grey8, level);
    check(deep, PixelFormat::Grey16, level);
  }
}

// Readers weigh the colours of a picture that says it is sRGB otherwise when they make it grey: a matcher
// would see another picture than the camera's.
TEST(PngPicture, OnlyWhatIsDrawnSaysThatItIsSrgb) {
  const auto says_srgb = [](std::span<const std::byte> file) {
    return std::string_view(reinterpret_cast<const char*>(file.data()), file.size()).find("sRGB") !=
           std::string_view::npos;
  };
  const std::vector<std::byte> rgb(3 * 4 * 4, std::byte{7});
  const ImageView photograph{rgb.data(), 4, 4, 12, PixelFormat::Rgb8};
  EXPECT_FALSE(says_srgb(*hal::encode_png(photograph)));
  const auto files = recognition_files(test::sample_images(), pipeline::Landmarks{}, {}, "1");
  ASSERT_TRUE(files);
  for (const auto& file : *files)
    if (file.name == std::string_view("portrait.png")) {
      EXPECT_TRUE(says_srgb(file.bytes));
    }
}

TEST(RecognitionFiles, HeightsAndSigmasReadBackInMillimetres) {
  const auto images = test::sample_images();
  const auto files = recognition_files(images, pipeline::Landmarks{}, {}, "1");
  ASSERT_TRUE(files);
  ASSERT_EQ(files->size(), 6u);
  const auto named = [&](std::string_view name) {
    for (const auto& file : *files)
      if (name == file.name) return reread(file.bytes);
    ADD_FAILURE() << name;
    return PngPixels{};
  };
  EXPECT_EQ(named("portrait.png").values, (std::vector<unsigned>{10, 20, 30, 200, 201, 202}));
  EXPECT_EQ(named("portrait_shows.png").values, (std::vector<unsigned>{255, 128}));
  EXPECT_EQ(named("range_shows.png").values, (std::vector<unsigned>{0, 255, 128, 255, 255, 255}));
  const PngPixels heights = named("range.png"), sigmas = named("range_sigma.png");
  ASSERT_EQ(heights.bits, 16);
  EXPECT_EQ(heights.values[0], 0u);
  EXPECT_NEAR((heights.values[1] - 32768.0) / 100, -12.34, 0.0051);
  EXPECT_NEAR((heights.values[2] - 32768.0) / 100, 5, 0.0051);
  EXPECT_EQ(heights.values[3], 1u) << "what is out of range stays a height";
  EXPECT_EQ(heights.values[4], 65535u);
  EXPECT_EQ((heights.values[5] - 32768.0) / 100, 0);
  EXPECT_NEAR(sigmas.values[1] / 1000.0, 0.0123, 0.00051);
  EXPECT_EQ(sigmas.values[4], 65000u);
  EXPECT_EQ(sigmas.values[0], 0u);
}

}  // namespace
}  // namespace relievo::storage
