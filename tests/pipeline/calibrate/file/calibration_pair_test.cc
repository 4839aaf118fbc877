// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The two-file forms: OpenCV's stereo sample and ROS camera_info.
#include <gtest/gtest.h>

#include "pipeline/calibrate/file/calibration_file.h"
#include "tests/pipeline/calibrate/file/sample_rig.h"
#include "tests/support/temporary_folder.h"

namespace relievo::tests {
namespace {

using pipeline::StereoCalibration;
constexpr pipeline::CalibrationHints kSize{1920, 1200, 0};

pipeline::CameraInfoTexts infos() {
  const auto texts = pipeline::camera_info_texts(sample_rig());
  EXPECT_TRUE(texts);
  return *texts;
}

// Wherever one of the two is cut: refused, or the same numbers.
void cut_everywhere(const std::string& one, const std::string& other,
                    const pipeline::CalibrationHints& hints) {
  const auto whole = pipeline::parse_calibration_pair(one, other, hints);
  ASSERT_TRUE(whole) << whole.error().where() << ": " << whole.error().what.view();
  int taken = 0;
  for (std::size_t length = 0; length < one.size(); ++length) {
    const auto cut = pipeline::parse_calibration_pair(std::string_view(one).substr(0, length), other, hints);
    if (!cut) continue;
    ++taken;
    EXPECT_EQ(difference(*cut, *whole), 0) << "cut to " << length << " of " << one.size();
  }
  EXPECT_LE(taken, 4);
}

TEST(CameraInfo, ARoundTripKeepsEveryNumber) {
  const auto texts = infos();
  for (const bool exchanged : {false, true}) {
    const auto back = exchanged ? pipeline::parse_calibration_pair(texts.right, texts.left)
                                : pipeline::parse_calibration_pair(texts.left, texts.right);
    ASSERT_TRUE(back) << back.error().where() << ": " << back.error().what.view();
    EXPECT_LT(difference(*back, sample_rig()), 1e-12);
    // And again: what was read is written as it was read.
    const auto again = pipeline::camera_info_texts(*back);
    ASSERT_TRUE(again);
    EXPECT_LT(difference(*pipeline::parse_calibration_pair(again->left, again->right), sample_rig()), 1e-12);
  }
}

TEST(CameraInfo, IsInMetres) {
  const auto texts = infos();
  const auto at = texts.right.rfind("data: [");
  double p[4] = {};
  ASSERT_EQ(std::sscanf(texts.right.c_str() + at, "data: [%lf, %lf, %lf, %lf", p, p + 1, p + 2, p + 3), 4);
  const pipeline::Vec3d t = sample_rig().right_from_left.translation_mm;
  EXPECT_NEAR(-1000 * p[3] / p[0], std::sqrt(t.x * t.x + t.y * t.y + t.z * t.z), 1e-9);
  // Another unit must be said.
  const auto as_mm = pipeline::parse_calibration_pair(texts.left, texts.right, {0, 0, 1});
  ASSERT_FALSE(as_mm);
  EXPECT_NE(std::string(as_mm.error().what.view()).find("millimetres"), std::string::npos);
}

TEST(CameraInfo, CutAtAnyLengthIsRefusedOrTheSame) {
  const auto texts = infos();
  cut_everywhere(texts.left, texts.right, {});
  cut_everywhere(texts.right, texts.left, {});
}

// As ROS's own camera_calibration prints it: few decimals, block style, comments.
TEST(CameraInfo, ReadsWhatRosWrites) {
  const std::string left =
      "image_width: 640\nimage_height: 480\ncamera_name: narrow_stereo/left\n"
      "camera_matrix:\n  rows: 3\n  cols: 3\n  data: [535.35887, 0.0, 342.28315, 0.0, 535.52221, 235.57082, 0.0, 0.0, 1.0]\n"
      "distortion_model: plumb_bob\n"
      "distortion_coefficients:\n  rows: 1\n  cols: 5\n  data: [-0.2664, -0.03858, 0.00178, -0.00028, 0.23855]\n"
      "rectification_matrix:  # from stereo calibration\n  rows: 3\n  cols: 3\n  data:\n"
      "  - 0.99998735\n  - 0.00296226\n  - 0.00406696\n  - -0.00296823\n  - 0.99999452\n  - 0.00146273\n"
      "  - -0.00406261\n  - -0.00147479\n  - 0.99999066\n"
      "projection_matrix: {rows: 3, cols: 4, data: [500.0, 0.0, 320.0, 0.0, 0.0, 500.0, 240.0, 0.0, 0.0, 0.0, 1.0, 0.0]}\n";
  std::string right = replaced(left, "narrow_stereo/left", "\"narrow_stereo/right\"");
  right = replaced(right, "[500.0, 0.0, 320.0, 0.0,", "[500.0, 0.0, 320.0, -50.0,");
  const auto read = pipeline::parse_calibration_pair(left, right);
  ASSERT_TRUE(read) << read.error().where() << ": " << read.error().what.view();
  EXPECT_DOUBLE_EQ(read->left.focal_px.x, 535.35887);
  EXPECT_DOUBLE_EQ(read->right.distortion[4], 0.23855);
  EXPECT_NEAR(read->right_from_left.translation_mm.x, -100 * 0.99998735, 1e-9);
  EXPECT_EQ(read->rms_px, 0);
}

struct HostileInfo {
  const char* what;
  const char* by;
  Errc code = Errc::InvalidInput;
};

class HostileCameraInfo : public ::testing::TestWithParam<HostileInfo> {};

TEST_P(HostileCameraInfo, IsRefusedInALine) {
  const auto texts = infos();
  const auto read =
      pipeline::parse_calibration_pair(texts.left, replaced(texts.right, GetParam().what, GetParam().by));
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, GetParam().code);
  EXPECT_FALSE(read.error().where().empty());
  EXPECT_EQ(std::string(read.error().what.view()).find('\n'), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(
    Fields, HostileCameraInfo,
    ::testing::Values(HostileInfo{"image_width: 1920", "image_width: -1"},
                      HostileInfo{"image_width: 1920", "image_width: 640"},
                      HostileInfo{"image_width: 1920", "image_width: 1920\nimage_width: 1920"},
                      HostileInfo{"image_width: 1920", "image_width: \"1920\""},
                      HostileInfo{"image_width: 1920", "image_width: 0x780"},
                      HostileInfo{"plumb_bob", "equidistant", Errc::Unsupported},
                      HostileInfo{"distortion_model", "distortion_muddle"}, HostileInfo{"2942.25", ".nan"},
                      HostileInfo{"2942.25", "nan"}, HostileInfo{"2942.25", ".inf"},
                      HostileInfo{"2942.25", "-inf"}, HostileInfo{"2942.25", "1e999"},
                      HostileInfo{"2942.25", "&a 2942.25"}, HostileInfo{"2942.25", "*a"},
                      HostileInfo{"2942.25", "[2942.25]"}, HostileInfo{"2942.25", "'2942.25'"},
                      HostileInfo{"2942.25, ", ""}, HostileInfo{"2942.25,", "2942.25, 1,"},
                      HostileInfo{"rows: 1\n", "rows: 1\n  rows: 1\n"},
                      HostileInfo{"cols: 5", "cols: 500000000"}, HostileInfo{"cols: 5", "cols: 7"},
                      HostileInfo{"cols: 5", "cols: -5"},
                      HostileInfo{"rectification_matrix", "camera_matrix"},
                      HostileInfo{"rectification_matrix:", "rectification_matrix: 5\nelse:"},
                      HostileInfo{"projection_matrix:\n  rows: 3", "projection_matrix:\n  rows: 4"},
                      HostileInfo{", 0, 0, 1, 0]", ", 0, 0, 2, 0]"}, HostileInfo{"]\n", "\n"},
                      HostileInfo{"  data", "\tdata"}, HostileInfo{"image_height", "\xff\xfe"}));

TEST(CameraInfo, TwoLeftsAreNoPair) {
  const auto texts = infos();
  EXPECT_FALSE(pipeline::parse_calibration_pair(texts.left, texts.left));
  EXPECT_FALSE(pipeline::parse_calibration_pair(texts.right, texts.right));
  EXPECT_FALSE(pipeline::parse_calibration_pair(texts.left, pipeline::calibration_text(sample_rig())));
  EXPECT_FALSE(pipeline::parse_calibration(texts.left));
}

TEST(StereoSample, ReadsItsTwoFilesInEitherOrder) {
  const SampleFiles files = opencv_sample_files();
  for (const bool exchanged : {false, true}) {
    const auto read = exchanged ? pipeline::parse_calibration_pair(files.extrinsics, files.intrinsics, kSize)
                                : pipeline::parse_calibration_pair(files.intrinsics, files.extrinsics, kSize);
    ASSERT_TRUE(read) << read.error().where() << ": " << read.error().what.view();
    EXPECT_EQ(difference(*read, sample_rig()), 0);
  }
  EXPECT_FALSE(pipeline::parse_calibration_pair(files.intrinsics, files.intrinsics, kSize));
}

TEST(StereoSample, CutAtAnyLengthIsRefusedOrTheSame) {
  const SampleFiles files = opencv_sample_files();
  cut_everywhere(files.intrinsics, files.extrinsics, kSize);
  // Of the other file, only R and T count: what comes after may be lost.
  const std::string needed = files.extrinsics.substr(0, files.extrinsics.find("R1:"));
  cut_everywhere(needed, files.intrinsics, kSize);
}

TEST(StereoSample, TheSizeMustBeSaidAndFit) {
  const SampleFiles files = opencv_sample_files();
  const auto unsaid = pipeline::parse_calibration_pair(files.intrinsics, files.extrinsics);
  ASSERT_FALSE(unsaid);
  EXPECT_NE(std::string(unsaid.error().what.view()).find("--image-size"), std::string::npos);
  EXPECT_FALSE(pipeline::parse_calibration_pair(files.intrinsics, files.extrinsics, {960, 600, 0}));
  EXPECT_FALSE(pipeline::parse_calibration_pair(files.intrinsics, files.extrinsics, {2880, 1800, 0}));
}

TEST(StereoSample, UnitsAndOtherNames) {
  const SampleFiles files = opencv_sample_files();
  const auto metres = pipeline::parse_calibration_pair(
      files.intrinsics, replaced(files.extrinsics, "-1.3609999999999999e+02", "-0.1361"), kSize);
  EXPECT_FALSE(metres);
  const auto scaled = pipeline::parse_calibration_pair(files.intrinsics, files.extrinsics, {1920, 1200, 2});
  ASSERT_TRUE(scaled);
  EXPECT_DOUBLE_EQ(scaled->right_from_left.translation_mm.x, 2 * -136.1);
  std::string other = replaced(replaced(files.intrinsics, "M1", "cameraMatrix1"), "D1", "distCoeffs1");
  EXPECT_TRUE(pipeline::parse_calibration_pair(other, files.extrinsics, kSize));
  other += files.intrinsics.substr(files.intrinsics.find("M1"));
  EXPECT_FALSE(pipeline::parse_calibration_pair(other, files.extrinsics, kSize))
      << "one matrix under two names";
  const std::string lying = replaced(files.extrinsics, "T: !!opencv-matrix\n   rows: 3\n   cols: 1",
                                     "T: !!opencv-matrix\n   rows: 1\n   cols: 3");
  EXPECT_TRUE(pipeline::parse_calibration_pair(files.intrinsics, lying, kSize));
}

class PairFiles : public ::testing::Test {
 protected:
  void put(const char* name, const std::string& text) { test::write_text(here / name, text); }
  test::TemporaryFolder here;
};

TEST_F(PairFiles, TheOtherHalfIsFoundByItsName) {
  const auto texts = infos();
  put("left.yaml", texts.left);
  const auto alone = pipeline::read_calibration(here / "left.yaml");
  ASSERT_FALSE(alone);
  EXPECT_NE(std::string(alone.error().where()).find("left.yaml"), std::string::npos);
  put("right.yaml", texts.right);
  EXPECT_TRUE(pipeline::read_calibration(here / "left.yaml"));
  EXPECT_TRUE(pipeline::read_calibration(here / "right.yaml"));
  put("a.yaml", texts.left);
  EXPECT_FALSE(pipeline::read_calibration(here / "a.yaml")) << "no name to go by";
  EXPECT_TRUE(pipeline::read_calibration(here / "a.yaml", {}, here / "right.yaml"));
  const SampleFiles files = opencv_sample_files();
  put("intrinsics.yml", files.intrinsics);
  put("extrinsics.yml", files.extrinsics);
  EXPECT_TRUE(pipeline::read_calibration(here / "intrinsics.yml", kSize));
  EXPECT_TRUE(pipeline::read_calibration(here / "extrinsics.yml", kSize));
  EXPECT_EQ(pipeline::read_calibration(here / "intrinsics.yml", kSize, here / "none.yml").error().code,
            Errc::NotFound);
  put("extrinsics.yml", files.extrinsics.substr(0, 300));
  const auto cut = pipeline::read_calibration(here / "intrinsics.yml", kSize);
  ASSERT_FALSE(cut);
  EXPECT_NE(std::string(cut.error().where()).find("extrinsics.yml"), std::string::npos);
}

}  // namespace
}  // namespace relievo::tests
