// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every raw format: a painted picture is sent as a camera would, developed, and compared with the paint.
#include "hal/raw/develop.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "hal/picture_file.h"
#include "tests/hal/raw/raw_writer.h"
#include "tests/support/allocation_counter.h"

namespace relievo::hal {
namespace {

constexpr int kWidth = 96;
constexpr int kHeight = 64;
constexpr std::array kFilters{ColourFilter::Rggb, ColourFilter::Grbg, ColourFilter::Gbrg, ColourFilter::Bggr};

struct Room {
  std::vector<std::byte> picture = std::vector<std::byte>(std::size_t{kWidth} * kHeight * 3);
  std::vector<std::byte> scratch = std::vector<std::byte>(std::size_t{kWidth} * kHeight);
  Result<ImageView> develop(const RawImage& raw) { return hal::develop(raw, picture, scratch); }
  Errc error_of(const RawImage& raw) {
    const auto view = develop(raw);
    EXPECT_FALSE(view);
    return view ? Errc::Cancelled : view.error().code;
  }
};

// The largest difference of any channel, 0 to 255, not looking at a margin of two pixels.
double worst(const ImageView& view, const Painting& paint) {
  double most = 0;
  for (int y = 2; y < view.height_px - 2; ++y)
    for (int x = 2; x < view.width_px - 2; ++x)
      for (int c = 0; c < 3; ++c)
        most =
            std::max(most, std::abs(view.row(y)[3 * x + c] - 255 * paint(x, y)[static_cast<std::size_t>(c)]));
  return most;
}

double mean_error(const ImageView& view, const Painting& paint) {
  double sum = 0;
  for (int y = 2; y < view.height_px - 2; ++y)
    for (int x = 2; x < view.width_px - 2; ++x)
      for (int c = 0; c < 3; ++c)
        sum += std::abs(view.row(y)[3 * x + c] - 255 * paint(x, y)[static_cast<std::size_t>(c)]);
  return sum / ((view.height_px - 4) * (view.width_px - 4) * 3);
}

Colour grey_scene(int x, int y) { return {0, grey_paint(x, y), 0}; }

TEST(Develop, GreySamplesKeepEveryBit) {
  Room room;
  for (const RawCoding coding :
       {RawCoding::Bits10, RawCoding::Bits12, RawCoding::Bits16, RawCoding::Packed10, RawCoding::Packed12}) {
    const int bits = bits_of(coding);
    const Sent sent = send_samples({coding}, kWidth, kHeight, 6, grey_scene);
    const auto view = room.develop(sent.raw);
    ASSERT_TRUE(view) << view.error().what.view();
    ASSERT_EQ(view->format, PixelFormat::Grey16);
    ASSERT_EQ(view->stride_bytes, 2 * kWidth);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const unsigned got = view->row(y)[2 * x] + 256U * view->row(y)[2 * x + 1];
        ASSERT_EQ(got >> (16 - bits), quantised(grey_paint(x, y), bits))
            << bits << " bit at " << x << ' ' << y;
      }
  }
}

TEST(Develop, BlackStaysBlackAndWhiteStaysWhite) {
  Room room;
  for (const RawCoding coding :
       {RawCoding::Bits10, RawCoding::Bits12, RawCoding::Bits16, RawCoding::Packed10, RawCoding::Packed12}) {
    const Sent sent = send_samples({coding}, kWidth, kHeight, 0, [](int x, int) {
      return Colour{0, x % 2 ? 1.0 : 0.0, 0};
    });
    const auto view = room.develop(sent.raw);
    ASSERT_TRUE(view);
    const std::uint8_t expected[] = {0, 0, 255, 255};
    EXPECT_EQ(std::memcmp(view->row(kHeight - 1) + 2 * (kWidth - 2), expected, 4), 0);
  }
}

TEST(Develop, ASampleOverItsRangeIsWhite) {
  Room room;
  Sent sent = send_samples({RawCoding::Bits10}, kWidth, kHeight, 0, grey_scene);
  sent.bytes[1] = std::byte{0xFF};  // high bits that a 10 bit sensor has not
  const auto view = room.develop(sent.raw);
  ASSERT_TRUE(view);
  EXPECT_EQ(view->row(0)[0] + 256 * view->row(0)[1], 65535);
}

TEST(Develop, EightBitAndRgbAreCopiedRowByRow) {
  Room room;
  for (const int padding : {0, 32}) {
    const Sent grey = send_samples({RawCoding::Bits8}, kWidth, kHeight, padding, grey_scene);
    const auto view = room.develop(grey.raw);
    ASSERT_TRUE(view);
    ASSERT_EQ(view->format, PixelFormat::Grey8);
    for (int y = 0; y < kHeight; ++y)
      ASSERT_EQ(std::memcmp(view->row(y), grey.bytes.data() + y * grey.raw.stride_bytes, kWidth), 0);
    const Sent rgb = sent_buffer({RawCoding::Rgb8}, kWidth, kHeight, padding);
    const auto copy = room.develop(rgb.raw);
    ASSERT_TRUE(copy);
    EXPECT_EQ(copy->format, PixelFormat::Rgb8);
    EXPECT_EQ(copy->row(kHeight - 1)[3 * kWidth - 1], 0xA5);
  }
}

TEST(Develop, EveryColourFilterGivesTheSameSmoothPicture) {
  Room room;
  for (const RawCoding coding :
       {RawCoding::Bits8, RawCoding::Bits10, RawCoding::Bits12, RawCoding::Packed10, RawCoding::Packed12})
    for (const ColourFilter filter : kFilters) {
      const Sent sent = send_samples({coding, filter}, kWidth, kHeight, 10, smooth_paint);
      const auto view = room.develop(sent.raw);
      ASSERT_TRUE(view) << view.error().what.view();
      ASSERT_EQ(view->format, PixelFormat::Rgb8);
      EXPECT_LT(worst(*view, smooth_paint), 3.0)
          << static_cast<int>(coding) << ' ' << static_cast<int>(filter);
    }
}

// An edge-aware demosaic draws no zipper along an upright edge: what bilinear green would smear by half
// the step into both neighbours.
TEST(Develop, ADemosaickedEdgeStaysSharp) {
  Room room;
  const Painting edge = [](int x, int) {
    return x < kWidth / 2 ? Colour{0.2, 0.2, 0.2} : Colour{0.8, 0.8, 0.8};
  };
  for (const ColourFilter filter : kFilters) {
    const Sent sent = send_samples({RawCoding::Bits8, filter}, kWidth, kHeight, 0, edge);
    const auto view = room.develop(sent.raw);
    ASSERT_TRUE(view);
    for (int y = 4; y < kHeight - 4; ++y) {
      EXPECT_NEAR(view->row(y)[3 * (kWidth / 2 - 1) + 1], 51, 2);
      EXPECT_NEAR(view->row(y)[3 * (kWidth / 2) + 1], 204, 2);
    }
  }
}

TEST(Develop, YuvComesBackWithinItsRounding) {
  Room room;
  for (const RawCoding coding : {RawCoding::Yuyv, RawCoding::Nv12}) {
    const Sent sent = send_yuv(coding, kWidth, kHeight, 8, smooth_paint);
    const auto view = room.develop(sent.raw);
    ASSERT_TRUE(view) << view.error().what.view();
    EXPECT_LT(mean_error(*view, smooth_paint), 1.5);
    // Two pixels share their colour, and the paint changes by four levels a pixel.
    EXPECT_LT(worst(*view, smooth_paint), 8.0);
  }
}

// A JPEG of the painting, as RawImage.
struct SentJpeg {
  std::vector<std::byte> stream;
  RawImage raw;
  explicit SentJpeg(PixelFormat format) {
    Picture picture{{}, kWidth, kHeight, format};
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x)
        for (int c = 0; c < bytes_per_pixel(format); ++c)
          picture.bytes.push_back(std::byte(
              static_cast<unsigned char>(quantised(smooth_paint(x, y)[static_cast<std::size_t>(c)], 8))));
    auto encoded = encode_jpeg(picture.view(), 95);
    EXPECT_TRUE(encoded);
    stream = *std::move(encoded);
    refer();
  }
  void refer() { raw = {stream.data(), stream.size(), kWidth, kHeight, 0, {RawCoding::Mjpeg}}; }
  // Without its Huffman tables, as webcams send it.
  void drop_tables() {
    for (std::size_t at = 2; at + 4 < stream.size() && stream[at + 1] != std::byte{0xDA};) {
      const std::size_t length = 2 + (std::to_integer<std::size_t>(stream[at + 2]) << 8U) +
                                 std::to_integer<std::size_t>(stream[at + 3]);
      const auto from = stream.begin() + static_cast<std::ptrdiff_t>(at);
      if (stream[at + 1] == std::byte{0xC4}) stream.erase(from, from + static_cast<std::ptrdiff_t>(length));
      else at += length;
    }
    refer();
  }
};

TEST(Develop, MotionJpegWithAndWithoutTables) {
  Room room;
  SentJpeg sent(PixelFormat::Rgb8);
  auto view = room.develop(sent.raw);
  ASSERT_TRUE(view) << view.error().what.view();
  EXPECT_LT(mean_error(*view, smooth_paint), 2.0);
  const std::vector<std::byte> whole = room.picture;
  const std::size_t size = sent.stream.size();
  sent.drop_tables();
  ASSERT_LT(sent.stream.size(), size - 400);
  view = room.develop(sent.raw);
  ASSERT_TRUE(view) << view.error().what.view();
  EXPECT_EQ(room.picture, whole);
}

TEST(Develop, AGreyJpegStaysGrey) {
  Room room;
  const SentJpeg sent(PixelFormat::Grey8);
  const auto view = room.develop(sent.raw);
  ASSERT_TRUE(view);
  EXPECT_EQ(view->format, PixelFormat::Grey8);
  EXPECT_EQ(view->stride_bytes, kWidth);
  EXPECT_NEAR(view->row(30)[40], 255 * smooth_paint(40, 30)[0], 6);
}

TEST(Develop, HalfAJpegIsRefusedAtEveryLength) {
  Room room;
  SentJpeg sent(PixelFormat::Rgb8);
  for (std::size_t size = 0; size + 2 < sent.stream.size(); size += 7) {
    sent.raw.size_bytes = size;
    EXPECT_EQ(room.error_of(sent.raw), Errc::InvalidInput) << size;
  }
}

TEST(Develop, StrayBytesBeforeTheEndOfAJpegAreHarmless) {
  Room room;
  SentJpeg sent(PixelFormat::Rgb8);
  ASSERT_TRUE(room.develop(sent.raw));
  const std::vector<std::byte> whole = room.picture;
  sent.stream.insert(sent.stream.end() - 2, 3, std::byte{0x11});
  sent.refer();
  ASSERT_TRUE(room.develop(sent.raw));
  EXPECT_EQ(room.picture, whole);
}

TEST(Develop, AJpegOfAnotherSizeIsRefused) {
  Room room;
  SentJpeg sent(PixelFormat::Rgb8);
  sent.raw.width_px = kWidth / 2;
  EXPECT_EQ(room.error_of(sent.raw), Errc::InvalidInput);
}

TEST(Develop, ShapesThatCannotBeAreRefused) {
  Room room;
  const Sent good = send_samples({RawCoding::Bits8, ColourFilter::Rggb}, kWidth, kHeight, 0, smooth_paint);
  const std::array<void (*)(RawImage&), 9> spoil{
      [](RawImage& raw) { raw.bytes = nullptr; },
      [](RawImage& raw) { raw.width_px = 0; },
      [](RawImage& raw) { raw.height_px = -1; },
      [](RawImage& raw) { raw.width_px = raw.stride_bytes = kMaxRawSidePx + 2; },
      [](RawImage& raw) { raw.stride_bytes = kWidth - 1; },
      [](RawImage& raw) { raw.height_px = kHeight - 1; },
      [](RawImage& raw) { raw.size_bytes -= 1; },
      [](RawImage& raw) { raw.format.coding = RawCoding::Yuyv; },
      [](RawImage& raw) { raw.format.coding = RawCoding::Bits16; },
  };
  for (std::size_t i = 0; i < spoil.size(); ++i) {
    RawImage raw = good.raw;
    spoil[i](raw);
    EXPECT_EQ(room.error_of(raw), Errc::InvalidInput) << i;
  }
  EXPECT_TRUE(room.develop(good.raw));
}

TEST(Develop, APictureLargerThanItsRoomIsRefused) {
  Room room;
  const Sent rgb = send_samples({RawCoding::Bits10, ColourFilter::Rggb}, kWidth, kHeight, 0, smooth_paint);
  EXPECT_FALSE(develop(rgb.raw, std::span(room.picture).first(room.picture.size() - 1), room.scratch));
  EXPECT_FALSE(develop(rgb.raw, room.picture, std::span(room.scratch).first(room.scratch.size() - 1)));
}

TEST(Develop, TheLastRowNeedsNoPadding) {
  Room room;
  Sent sent = send_samples({RawCoding::Bits8}, kWidth, kHeight, 32, grey_scene);
  sent.raw.size_bytes -= 32;
  EXPECT_TRUE(room.develop(sent.raw));
  sent.raw.size_bytes -= 1;
  EXPECT_TRUE(is_short(sent.raw));
  EXPECT_EQ(room.error_of(sent.raw), Errc::InvalidInput);
}

TEST(Develop, GreySamplesAllocateNothing) {
  Room room;
  for (const RawCoding coding : {RawCoding::Bits8, RawCoding::Bits10, RawCoding::Bits12, RawCoding::Bits16,
                                 RawCoding::Packed10, RawCoding::Packed12}) {
    const Sent sent = send_samples({coding}, kWidth, kHeight, 4, grey_scene);
    const AllocationCounter counter;
    const auto view = room.develop(sent.raw);
    EXPECT_EQ(counter.made(), 0);
    EXPECT_TRUE(view);
  }
}

TEST(AllocationCounter, SeesAnAllocation) {
  if (!AllocationCounter::counts()) GTEST_SKIP() << "the sanitizer has its own malloc";
  const AllocationCounter counter;
  const std::vector<std::byte> some(1000);
  EXPECT_GE(counter.made(), 1);
  EXPECT_EQ(some.size(), 1000U);
}

}  // namespace
}  // namespace relievo::hal
