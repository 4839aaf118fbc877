// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/file/calibration_file.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/pipeline/calibrate/file/sample_rig.h"

namespace relievo::tests {
namespace {

namespace fs = std::filesystem;
using pipeline::StereoCalibration;

class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / ("relievo_calibration_" + std::to_string(::getpid()))) {
    fs::create_directories(path_);
  }
  ~Folder() { fs::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

TEST(CalibrationFile, ReadsWhatItWroteToTheLastBit) {
  const Folder folder;
  const fs::path file = folder.path() / "rig.yml";
  ASSERT_TRUE(pipeline::write_calibration(file, sample_rig()));
  const auto read = pipeline::read_calibration(file);
  ASSERT_TRUE(read) << read.error().what.view();
  EXPECT_TRUE(same(*read, sample_rig()));
  EXPECT_EQ(read->left.focal_px.x, sample_rig().left.focal_px.x);
  EXPECT_EQ(read->left.distortion[4], sample_rig().left.distortion[4]);
  EXPECT_EQ(read->right_from_left.translation_mm.z, sample_rig().right_from_left.translation_mm.z);
  // Again, over the first; nothing else is left behind.
  ASSERT_TRUE(pipeline::write_calibration(file, sample_rig()));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1);
}

// OpenCV's own reader takes wrong numbers at some of these lengths.
void cut_everywhere(const std::string& text) {
  const auto whole = pipeline::parse_calibration(text);
  ASSERT_TRUE(whole) << whole.error().where() << ": " << whole.error().what.view();
  int taken = 0;
  for (std::size_t length = 0; length < text.size(); ++length) {
    const auto cut = pipeline::parse_calibration(std::string_view(text).substr(0, length));
    if (!cut) continue;
    ++taken;
    EXPECT_TRUE(same(*cut, *whole)) << "cut to " << length << " of " << text.size();
  }
  EXPECT_LE(taken, 2);
}

TEST(CalibrationFile, CutAtAnyLengthIsRefusedOrTheSame) {
  cut_everywhere(pipeline::calibration_text(sample_rig()));
}

TEST(CalibrationFile, NamesTheCamerasItWasMadeWith) {
  StereoCalibration rig = sample_rig();
  rig.cameras = {"serial \"40\\12\" # : '", "at /dev/v4l/by-path/pci-0000:00:14.0-usb-0:2:1.0-video-index0"};
  const std::string text = pipeline::calibration_text(rig);
  const auto read = pipeline::parse_calibration(text);
  ASSERT_TRUE(read) << read.error().where() << ": " << read.error().what.view();
  EXPECT_EQ(read->cameras, rig.cameras);
  cut_everywhere(text);
  // One that was made before, or elsewhere, names none, and is written as it always was.
  const std::string before = pipeline::calibration_text(sample_rig());
  EXPECT_EQ(before.find("_camera"), std::string::npos);
  EXPECT_EQ(pipeline::parse_calibration(before)->cameras, pipeline::RigCameras());
  for (const char* by : {"left_camera: 4012\n", "left_camera: \"a\\tb\"\n", "left_camera: \"\xc3\xa9\"\n"})
    EXPECT_EQ(pipeline::parse_calibration(replaced(before, "pair_rms_px", std::string(by) + "pair_rms_px"))
                  .error()
                  .where(),
              "left_camera")
        << by;
  // Nor is a word a number: it would be read as nought, which stands for unknown.
  for (const std::string field : {"pair_rms_px", "epipolar_shift_px"})
    for (const std::string by : {": 0,02\n", ": abc\n", ": \"0.02\"\n"})
      EXPECT_EQ(
          pipeline::parse_calibration(replaced(before, field, field + by + "was_" + field)).error().where(),
          field)
          << by;
  rig.cameras.right.assign(pipeline::kMaxCameraWords + 1, 'x');
  EXPECT_FALSE(pipeline::check_calibration(rig));
}

TEST(CalibrationFile, OpenCvsFormCutAtAnyLengthToo) {
  const char* data = std::getenv("RELIEVO_TEST_DATA");
  if (data == nullptr) GTEST_SKIP() << "RELIEVO_TEST_DATA is not set: the measured pictures are not here";
  std::ifstream in(fs::path(data) / "rendered/board/rig.yml");
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  if (text.empty()) GTEST_SKIP() << "rendered/board/rig.yml is not in " << data;
  cut_everywhere(text);
}

TEST(CalibrationFile, OtherFieldsAreSteppedOver) {
  const std::string more =
      "calibration_time: \"Sat: 12\"\nnframes: 14\nE: !!opencv-matrix\n   rows: 1\n   cols: 2\n   dt: d\n   "
      "data: [ 1., -2.e-01 ]\n"
      "list: [ 1, 2,\n   3 ]\nmap:\n   inner: 4\n";
  const auto read = pipeline::parse_calibration(
      replaced(pipeline::calibration_text(sample_rig()), "image_width", more + "image_width"));
  ASSERT_TRUE(read) << read.error().where() << ": " << read.error().what.view();
  EXPECT_TRUE(same(*read, sample_rig()));
}

TEST(CalibrationFile, FourCoefficientsAreEnoughFiveTheMost) {
  std::string text = pipeline::calibration_text(sample_rig());
  const auto from = text.find("D1:");
  const auto to = text.find("K2:");
  const std::string four =
      "D1: !!opencv-matrix\n   rows: 4\n   cols: 1\n   dt: d\n   data: [ -0.1, 0.1, 0., 0. ]\n";
  EXPECT_TRUE(pipeline::parse_calibration(std::string(text).replace(from, to - from, four)));
  const std::string eight =
      "D1: !!opencv-matrix\n   rows: 1\n   cols: 8\n   dt: d\n   data: [ -0.1, 0.1, 0., 0., 0., 0.1, 0., 0. "
      "]\n";
  EXPECT_EQ(pipeline::parse_calibration(std::string(text).replace(from, to - from, eight)).error().code,
            Errc::Unsupported);
}

struct HostileField {
  const char* what;
  const char* by;
  const char* where;
};

class HostileCalibration : public ::testing::TestWithParam<HostileField> {};

TEST_P(HostileCalibration, IsRefusedWithItsField) {
  const HostileField& h = GetParam();
  const auto read =
      pipeline::parse_calibration(replaced(pipeline::calibration_text(sample_rig()), h.what, h.by));
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, Errc::InvalidInput);
  EXPECT_NE(std::string(read.error().where()).find(h.where), std::string::npos) << read.error().where();
  EXPECT_EQ(std::string(read.error().what.view()).find('\n'), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(
    Fields, HostileCalibration,
    ::testing::Values(
        HostileField{"image_width: 1920", "image_width: 0", "image_width"},
        HostileField{"image_width: 1920", "image_width: 19200", "image_width"},
        HostileField{"image_width: 1920", "image_width: -1920", "image_width"},
        HostileField{"image_width: 1920", "image_width: 1920.5", "image_width"},
        HostileField{"image_width: 1920", "image_width: 1e300", "image_width"},
        HostileField{"image_width: 1920", "width: 1920", "image_width"},
        HostileField{"2.9551234567890124e+03", "2.9551234567890124e+01", "K1"},
        HostileField{"2.9551234567890124e+03", "-2.9551234567890124e+03", "K1"},
        HostileField{"2.9551234567890124e+03", ".Nan", "line"},
        HostileField{"2.9551234567890124e+03", "1e999", "line"},
        HostileField{"2.9551234567890124e+03", "2.95.5", "line"},
        HostileField{"2.9551234567890124e+03,", "", "line"},
        HostileField{"K1: !!opencv-matrix\n   rows: 3", "K1: !!opencv-matrix\n   rows: 300000000", "line"},
        HostileField{"K1: !!opencv-matrix\n   rows: 3", "K1: !!opencv-matrix\n   rows: 9", "line"},
        HostileField{"K1:", "KX:", "K1"}, HostileField{"K2:", "K1:", "line"},
        HostileField{"R: !!opencv-matrix", "R: 5 # !!", "line"},
        HostileField{"-1.3609999999999999e+02", "1.3609999999999999e+02", "T"},
        HostileField{"-1.3609999999999999e+02", "-1.3609999999999999e+09", "T"},
        HostileField{"-1.1000000000000000e-01", "-1.1000000000000000e+01", "D1"},
        HostileField{"2.5000000000000000e-01", "2.6000000000000000e-01", "R"},
        HostileField{" ]\nR:", " \nR:", "line"}));

TEST(CalibrationFile, WhatIsNoCalibrationIsRefused) {
  const Folder folder;
  EXPECT_EQ(pipeline::parse_calibration("").error().code, Errc::InvalidInput);
  EXPECT_EQ(
      pipeline::parse_calibration(std::string(pipeline::kMaxCalibrationFileBytes + 1, 'x')).error().code,
      Errc::InvalidInput);
  EXPECT_EQ(pipeline::parse_calibration(std::string("K1: \0 1", 7)).error().code, Errc::InvalidInput);
  EXPECT_EQ(pipeline::read_calibration(folder.path() / "none.yml").error().code, Errc::NotFound);
  EXPECT_EQ(pipeline::read_calibration(folder.path()).error().code, Errc::InvalidInput);
  EXPECT_EQ(pipeline::read_calibration("/dev/zero").error().code, Errc::InvalidInput);
}

// Every byte once replaced by something nasty: an answer, never a crash, never a number off the range.
TEST(CalibrationFile, AnyByteMayBeWrong) {
  const std::string text = pipeline::calibration_text(sample_rig());
  for (std::size_t i = 0; i < text.size(); ++i)
    for (const char c : {'[', ']', ',', ':', '\n', '9', '-', ' ', '\xff'}) {
      std::string bad = text;
      bad[i] = c;
      const auto read = pipeline::parse_calibration(bad);
      EXPECT_TRUE(!read || pipeline::check_calibration(*read));
    }
}

TEST(CalibrationFile, NothingIsWrittenWhereItCannotBe) {
  const Folder folder;
  EXPECT_EQ(pipeline::write_calibration(folder.path() / "no/such/rig.yml", sample_rig()).error().code,
            Errc::IoFailed);
  StereoCalibration wrong = sample_rig();
  wrong.left.focal_px.x = 0;
  EXPECT_FALSE(pipeline::write_calibration(folder.path() / "rig.yml", wrong));
  fs::create_directories(folder.path() / "taken.yml/inside");
  EXPECT_FALSE(pipeline::write_calibration(folder.path() / "taken.yml", sample_rig()));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1);
}

}  // namespace
}  // namespace relievo::tests
