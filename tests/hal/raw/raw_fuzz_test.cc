// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A short, seeded run of what `toolchain/fuzz 60 raw` does for as long as one likes.
#include "tests/hal/raw/raw_fuzz.h"

#include <gtest/gtest.h>

#include <random>

#include "hal/picture_file.h"

namespace relievo::hal {
namespace {

TEST(RawFuzz, RandomShapesAndContents) {
  std::mt19937 random(6);
  int developed = 0;
  for (int i = 0; i < 3000; ++i) {
    std::vector<std::uint8_t> data(kFuzzHeaderBytes + random() % 512);
    for (auto& byte : data) byte = static_cast<std::uint8_t>(random());
    if (i % 2 == 0) data[5] = data[6] = data[7] = 0;  // whole pictures in enough room
    if (i % 4 == 0) data[2] = data[3] = static_cast<std::uint8_t>(data[3] | 1U);
    developed += fuzz_raw(data) ? 1 : 0;
  }
  EXPECT_GT(developed, 300) << "hardly any of these shapes is a picture";
  EXPECT_LT(developed, 2700) << "hardly any of these shapes is wrong";
}

TEST(RawFuzz, MutatedJpegs) {
  Picture picture{std::vector<std::byte>(std::size_t{48} * 40 * 3), 48, 40, PixelFormat::Rgb8};
  std::mt19937 random(7);
  for (std::size_t i = 0; i < picture.bytes.size(); ++i)
    picture.bytes[i] = std::byte(static_cast<unsigned char>(i / 9 + random() % 8));
  const auto stream = encode_jpeg(picture.view(), 80);
  ASSERT_TRUE(stream);
  std::vector<std::uint8_t> whole{static_cast<std::uint8_t>(RawCoding::Mjpeg), 0, 47, 39, 8, 0, 0, 0};
  for (const std::byte b : *stream) whole.push_back(std::to_integer<std::uint8_t>(b));
  EXPECT_TRUE(fuzz_raw(whole));
  for (int i = 0; i < 2000; ++i) {
    std::vector<std::uint8_t> data = whole;
    for (unsigned n = 1 + random() % 4; n > 0; --n)
      data[kFuzzHeaderBytes + random() % (data.size() - kFuzzHeaderBytes)] =
          static_cast<std::uint8_t>(random());
    if (i % 3 == 0) data.resize(data.size() - random() % stream->size());
    (void)fuzz_raw(data);
  }
}

}  // namespace
}  // namespace relievo::hal
