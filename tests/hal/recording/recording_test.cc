// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/recording/capture_file.h"

#include <gtest/gtest.h>
#include <cstring>
#include <random>
#include <vector>

#include "hal/sim/device.h"
#include "tests/hal/temporary_folder.h"

namespace relievo::hal {
namespace {

// Pictures with padding behind every row, of every value there is.
struct Noise {
  Noise(PixelFormat format, unsigned seed) {
    const int stride = 23 * bytes_per_pixel(format) + 6;
    bytes.resize(static_cast<std::size_t>(stride) * 17);
    std::mt19937 random(seed);
    for (auto& b : bytes) b = static_cast<std::byte>(random());
    view = {bytes.data(), 23, 17, stride, format};
  }
  Noise(const Noise&) = delete;
  Noise& operator=(const Noise&) = delete;
  std::vector<std::byte> bytes;
  ImageView view;
};

void expect_same(const ImageView& a, const ImageView& b) {
  ASSERT_EQ(a.width_px, b.width_px);
  ASSERT_EQ(a.height_px, b.height_px);
  ASSERT_EQ(a.format, b.format);
  for (int y = 0; y < a.height_px; ++y)
    EXPECT_EQ(
        std::memcmp(a.row(y), b.row(y), static_cast<std::size_t>(a.width_px * bytes_per_pixel(a.format))), 0)
        << y;
}

TEST(Recording, IsReplayedBitForBit) {
  for (const PixelFormat format : {PixelFormat::Grey8, PixelFormat::Rgb8, PixelFormat::Grey16}) {
    const TemporaryFolder folder;
    const Noise views[]{{format, 1}, {format, 2}, {format, 3}, {format, 4}};
    for (std::size_t i = 0; i < 4; i += 2) {
      const auto number = record_pair(folder / "taken", {views[i].view, views[i + 1].view, 9'000'000'000,
                                                         9'000'040'000, 3100, 1.5, "A7", "B9"});
      ASSERT_TRUE(number) << number.error().what.view();
      EXPECT_EQ(*number, static_cast<std::int64_t>(i / 2 + 1));
    }
    auto made = make_folder_device(folder / "taken");
    ASSERT_TRUE(made) << made.error().what.view();
    Device& device = **made;
    EXPECT_EQ(device.preferred_mode().exposure, std::chrono::microseconds(3100));
    for (Camera* camera : {&device.left(), &device.right()}) {
      ASSERT_TRUE(camera->open(device.preferred_mode()));
      ASSERT_TRUE(camera->start());
    }
    for (std::size_t i = 0; i < 4; i += 2) {
      ASSERT_TRUE(device.trigger().pulse(std::chrono::microseconds(100)));
      const auto left = device.left().next_frame(device.clock().now() + std::chrono::seconds(5));
      const auto right = device.right().next_frame(device.clock().now() + std::chrono::seconds(5));
      ASSERT_TRUE(left && right);
      expect_same(left->image(), views[i].view);
      expect_same(right->image(), views[i + 1].view);
      EXPECT_EQ(right->exposed_at() - left->exposed_at(), std::chrono::nanoseconds(40'000));
    }
  }
}

TEST(Recording, RefusesWhatIsNoPair) {
  const TemporaryFolder folder;
  const Noise grey(PixelFormat::Grey8, 1), colour(PixelFormat::Rgb8, 2);
  EXPECT_EQ(record_pair(folder.path(), {grey.view, colour.view, 0, 0, 0, 1, "", ""}).error().code,
            Errc::InvalidInput);
  EXPECT_EQ(record_pair(folder.path(), {grey.view, {}, 0, 0, 0, 1, "", ""}).error().code, Errc::InvalidInput);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << "half a pair was written";
}

}  // namespace
}  // namespace relievo::hal
