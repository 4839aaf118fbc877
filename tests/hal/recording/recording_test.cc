// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/recording/capture_file.h"

#include <gtest/gtest.h>
#include <cstring>
#include <fstream>
#include <limits>
#include <random>
#include <utility>
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

void expect_same(const RawImage& a, const RawImage& b) {
  ASSERT_EQ(a.width_px, b.width_px);
  ASSERT_EQ(a.height_px, b.height_px);
  ASSERT_EQ(a.format, b.format);
  for (int y = 0; y < a.height_px; ++y)
    EXPECT_EQ(std::memcmp(a.bytes + y * a.stride_bytes, b.bytes + y * b.stride_bytes,
                          raw_row_bytes(a.format.coding, a.width_px)),
              0)
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
      expect_same(left->raw(), raw_of(views[i].view));
      expect_same(right->raw(), raw_of(views[i + 1].view));
      EXPECT_EQ(right->exposed_at() - left->exposed_at(), std::chrono::nanoseconds(40'000));
    }
  }
}

// What the next trigger shows is the pair of these views.
void expect_next(Device& device, const Noise& left, const Noise& right) {
  ASSERT_TRUE(device.trigger().pulse(std::chrono::microseconds(100)));
  const auto l = device.left().next_frame(device.clock().now() + std::chrono::seconds(5));
  const auto r = device.right().next_frame(device.clock().now() + std::chrono::seconds(5));
  ASSERT_TRUE(l && r);
  expect_same(l->raw(), raw_of(left.view));
  expect_same(r->raw(), raw_of(right.view));
}

TEST(Recording, AHeadTurnsToItsNextSideWhenItIsAskedTo) {
  const TemporaryFolder folder;
  const Noise views[]{{PixelFormat::Grey8, 1}, {PixelFormat::Grey8, 2}, {PixelFormat::Grey8, 3},
                      {PixelFormat::Grey8, 4}, {PixelFormat::Grey8, 5}, {PixelFormat::Grey8, 6}};
  for (std::size_t i = 0; i < 6; i += 2) {
    RecordedPair pair{views[i].view, views[i + 1].view, 0, 0, 3100, 1, "A7", "B9"};
    pair.of_head = true;
    ASSERT_TRUE(record_pair(folder / "head", pair));
  }
  const auto pictures = recorded_pictures(folder / "head");
  ASSERT_TRUE(pictures) << pictures.error().what.view();
  ASSERT_EQ(pictures->size(), 6U);
  EXPECT_EQ(pictures->at(3).filename(), "right_000002.png");
  {
    auto made = make_folder_device(folder / "head");
    ASSERT_TRUE(made) << made.error().what.view();
    Device& device = **made;
    for (Camera* camera : {&device.left(), &device.right()}) {
      ASSERT_TRUE(camera->open(device.preferred_mode()));
      ASSERT_TRUE(camera->start());
    }
    for (int visit = 0; visit < 2; ++visit) {
      for (int again = 0; again < 2; ++again) expect_next(device, views[0], views[1]);
      const std::pair<double, std::size_t> asked[] = {{-25, 2}, {-25, 4}, {25, 2}, {45, 4}, {0, 0}};
      for (const auto& [yaw_deg, at] : asked) {
        turn_simulated_head(device, yaw_deg);
        expect_next(device, views[at], views[at + 1]);
      }
    }
  }
  for (const char* side : {"left", "right"})
    std::filesystem::remove(folder / "head" / recorded_name(side, 2));
  EXPECT_EQ(recorded_pictures(folder / "head").error().code, Errc::NotFound);
  const auto without = make_folder_device(folder / "head");
  ASSERT_FALSE(without);
  EXPECT_NE(without.error().where().find("left_000002.png"), std::string_view::npos);
}

TEST(Recording, RefusesWhatIsNoPair) {
  const TemporaryFolder folder;
  const Noise grey(PixelFormat::Grey8, 1), colour(PixelFormat::Rgb8, 2);
  EXPECT_EQ(record_pair(folder.path(), {grey.view, colour.view, 0, 0, 0, 1, "", ""}).error().code,
            Errc::InvalidInput);
  EXPECT_EQ(record_pair(folder.path(), {grey.view, {}, 0, 0, 0, 1, "", ""}).error().code, Errc::InvalidInput);
  EXPECT_EQ(record_pair(folder / "stick/taken", {grey.view, grey.view, 0, 0, 0, 1, "", ""}).error().code,
            Errc::IoFailed);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << "half a pair was written, or where no stick is";
}

TEST(Recording, AnIndexThatCannotBeReadIsNotWrittenOver) {
  const TemporaryFolder folder;
  const Noise grey(PixelFormat::Grey8, 1);
  const RecordedPair pair{grey.view, grey.view, 0, 0, 0, 1, "", ""};
  std::filesystem::create_symlink("capture.json", folder / "capture.json");  // it leads to itself: ELOOP
  EXPECT_EQ(record_pair(folder.path(), pair).error().code, Errc::IoFailed);
  EXPECT_FALSE(std::filesystem::exists(folder / recorded_name("left", 1).c_str()))
      << "a pair of before may be there";
}

TEST(Recording, ASerialNumberThatIsNoTextIsAnError) {
  const TemporaryFolder folder;
  const Noise grey(PixelFormat::Grey8, 1);
  EXPECT_EQ(record_pair(folder.path(), {grey.view, grey.view, 0, 0, 0, 1, "A\xff", "B"}).error().code,
            Errc::InvalidInput);
}

TEST(Recording, ANumberThatIsNoPicturesIsRefused) {
  const TemporaryFolder folder;
  const Noise grey(PixelFormat::Grey8, 1);
  const auto holds = [&](std::int64_t number) {
    std::ofstream(folder / "capture.json")
        << R"({"frames": [{"left_ns": 0, "right_ns": 0, "number": )" << number << "}]}";
  };
  const RecordedPair pair{grey.view, grey.view, 0, 0, 0, 1, "", ""};
  for (const std::int64_t number :
       {std::numeric_limits<std::int64_t>::max(), std::int64_t{1'000'000}, std::int64_t{-1}}) {
    holds(number);
    EXPECT_EQ(read_capture_file(folder / "capture.json").error().code, Errc::InvalidInput) << number;
    EXPECT_EQ(record_pair(folder.path(), pair).error().code, Errc::InvalidInput) << number;
  }
  holds(999'999);
  EXPECT_TRUE(read_capture_file(folder / "capture.json"));
  EXPECT_EQ(record_pair(folder.path(), pair).error().code, Errc::InvalidInput)
      << "it could not be read again";
  holds(999'998);
  EXPECT_EQ(*record_pair(folder.path(), pair), 999'999);
}

}  // namespace
}  // namespace relievo::hal
