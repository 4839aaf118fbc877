// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/picture_file.h"

#include <gtest/gtest.h>

#include <sys/mount.h>
#include <cstring>
#include <fstream>

#include "hal/base/whole_file.h"
#include "tests/hal/temporary_folder.h"

namespace relievo::hal {
namespace {

Picture pattern(int w, int h, PixelFormat format) {
  Picture p{{}, w, h, format};
  p.bytes.resize(static_cast<std::size_t>(w * h * bytes_per_pixel(format)));
  for (std::size_t i = 0; i < p.bytes.size(); ++i)
    p.bytes[i] = std::byte(static_cast<unsigned char>(i * 37 + i / 7));
  return p;
}

void write_bytes(const std::filesystem::path& file, const std::byte* bytes, std::size_t size) {
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes), static_cast<std::streamsize>(size));
}

TEST(PictureFile, EveryFormatComesBackFromPngUnchanged) {
  const TemporaryFolder folder;
  for (const PixelFormat format : {PixelFormat::Grey8, PixelFormat::Rgb8, PixelFormat::Grey16}) {
    const Picture written = pattern(31, 17, format);
    ASSERT_TRUE(write_picture(folder / "a.png", written.view()));
    const auto read = read_picture(folder / "a.png");
    ASSERT_TRUE(read) << read.error().what.view();
    EXPECT_EQ(read->format, format);
    EXPECT_EQ(read->width_px, 31);
    EXPECT_EQ(read->height_px, 17);
    EXPECT_EQ(read->bytes, written.bytes);
  }
}

TEST(PictureFile, RedStaysRedInJpegToo) {
  const TemporaryFolder folder;
  Picture red{std::vector<std::byte>(16 * 16 * 3), 16, 16, PixelFormat::Rgb8};
  for (std::size_t i = 0; i < red.bytes.size(); i += 3) red.bytes[i] = std::byte{220};
  ASSERT_TRUE(write_picture(folder / "r.jpg", red.view()));
  const auto read = read_picture(folder / "r.jpg");
  ASSERT_TRUE(read);
  EXPECT_GT(std::to_integer<int>(read->bytes[0]), 200);
  EXPECT_LT(std::to_integer<int>(read->bytes[2]), 20);
}

TEST(PictureFile, AStridedViewIsWrittenRowByRow) {
  const TemporaryFolder folder;
  const Picture whole = pattern(20, 10, PixelFormat::Grey8);
  ImageView window = whole.view();
  window.bytes += 5 + 2 * 20;
  window.width_px = 8;
  window.height_px = 6;
  ASSERT_TRUE(write_picture(folder / "w.png", window));
  const auto read = read_picture(folder / "w.png");
  ASSERT_TRUE(read);
  EXPECT_EQ(std::memcmp(read->view().row(3), window.row(3), 8), 0);
}

TEST(PictureFile, EveryTruncationOfAPngIsAnError) {
  const auto png = encode_png(pattern(9, 7, PixelFormat::Rgb8).view());
  ASSERT_TRUE(png);
  for (std::size_t size = 0; size < png->size(); ++size) {
    const auto read = decode_picture(png->data(), size);
    ASSERT_FALSE(read) << size << " of " << png->size() << " bytes were taken for a picture";
    EXPECT_EQ(read.error().code, Errc::InvalidInput);
  }
  EXPECT_TRUE(decode_picture(png->data(), png->size()));
}

TEST(PictureFile, EveryTruncationOfAJpegIsAnError) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_picture(folder / "a.jpg", pattern(24, 16, PixelFormat::Rgb8).view()));
  const auto jpeg = read_whole_file(folder / "a.jpg", 1 << 20);
  ASSERT_TRUE(jpeg);
  for (std::size_t size = 0; size < jpeg->size(); ++size)
    EXPECT_FALSE(decode_picture(jpeg->data(), size)) << size;
}

TEST(PictureFile, EveryDamagedByteOfAPngIsSurvived) {
  auto png = encode_png(pattern(9, 7, PixelFormat::Rgb8).view());
  ASSERT_TRUE(png);
  testing::internal::CaptureStderr();
  for (std::size_t i = 0; i < png->size(); ++i) {
    std::vector<std::byte> damaged = *png;
    damaged[i] ^= std::byte{0x5a};
    (void)decode_picture(damaged.data(), damaged.size()).has_value();
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << "what is wrong is told by whoever asked, once";
}

TEST(PictureFile, SaysWhichFileIsMissingEmptyOrNoPicture) {
  const TemporaryFolder folder;
  const auto missing = read_picture(folder / "none.png");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, Errc::NotFound);
  EXPECT_NE(missing.error().where().find("none.png"), std::string_view::npos);
  write_bytes(folder / "empty.png", nullptr, 0);
  const auto empty = read_picture(folder / "empty.png");
  ASSERT_FALSE(empty);
  EXPECT_EQ(empty.error().code, Errc::InvalidInput);
  EXPECT_NE(empty.error().where().find("empty.png"), std::string_view::npos);
  const char text[] = "this is a shopping list";
  write_bytes(folder / "list.png", reinterpret_cast<const std::byte*>(text), sizeof text);
  EXPECT_EQ(read_picture(folder / "list.png").error().code, Errc::InvalidInput);
  EXPECT_EQ(read_picture(folder.path()).error().code, Errc::InvalidInput);
}

TEST(PictureFile, AHugeHeaderIsRefusedBeforeDecoding) {
  auto png = encode_png(pattern(4, 4, PixelFormat::Grey8).view());
  ASSERT_TRUE(png);
  (*png)[17] = std::byte{0x7f};  // a width of eight million
  const auto read = decode_picture(png->data(), png->size());
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().what.view().find("limit"), std::string_view::npos);
}

TEST(PictureFile, AFullDiskIsMediaFullAndLeavesNoTrace) {
  const auto full = write_whole_file("/dev/full", std::as_bytes(std::span("data")));
  ASSERT_FALSE(full);
  EXPECT_EQ(full.error().code, Errc::MediaFull);

  const TemporaryFolder folder;
  if (::mount("tmpfs", folder.path().c_str(), "tmpfs", 0, "size=64k") != 0)
    GTEST_SKIP() << "may not mount a small tmpfs";
  const Picture small = pattern(40, 30, PixelFormat::Rgb8);
  ASSERT_TRUE(write_picture(folder / "a.png", small.view()));
  Picture noisy = pattern(400, 300, PixelFormat::Rgb8);
  std::uint32_t state = 1;
  for (std::byte& b : noisy.bytes)
    b = std::byte(static_cast<unsigned char>((state = state * 1664525U + 1013904223U) >> 24));
  const auto written = write_picture(folder / "a.png", noisy.view());
  EXPECT_EQ(written.has_value() ? Errc::IoFailed : written.error().code, Errc::MediaFull);
  const auto old = read_picture(folder / "a.png");
  EXPECT_TRUE(old && old->width_px == 40) << "the old picture must survive";
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1)
      << "a temporary file was left behind";
  ::umount(folder.path().c_str());
}

TEST(PictureFile, APictureOfNoWidthIsNoLackOfMemory) {
  const auto none = reduced(pattern(20, 10, PixelFormat::Grey8).view(), 0, 5);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, Errc::InvalidInput);
}

TEST(PictureFile, RefusesWhatItCannotWrite) {
  const TemporaryFolder folder;
  const Picture p = pattern(4, 4, PixelFormat::Grey16);
  EXPECT_EQ(write_picture(folder / "a.tiff", p.view()).error().code, Errc::InvalidInput);
  EXPECT_EQ(write_picture(folder / "a.jpg", p.view()).error().code, Errc::InvalidInput);
  EXPECT_EQ(write_picture(folder / "a.png", ImageView{}).error().code, Errc::InvalidInput);
  EXPECT_EQ(write_picture(folder.path() / "no" / "a.png", p.view()).error().code, Errc::IoFailed);
}

}  // namespace
}  // namespace relievo::hal
