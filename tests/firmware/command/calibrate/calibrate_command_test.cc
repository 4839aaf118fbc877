// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/calibrate/calibrate_command.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

#include "hal/picture_file.h"
#include "pipeline/calibrate/file/calibration_file.h"
#include "tests/firmware/command/calibrate/kept_lines.h"
#include "tests/pipeline/calibrate/board/drawn_board.h"

namespace relievo::tests {
namespace {

namespace fs = std::filesystem;
using firmware::CalibrateArgs;

class CalibrateCommand : public ::testing::Test {
 protected:
  CalibrateCommand()
      : folder_(fs::temp_directory_path() / ("relievo_calibrate_" + std::to_string(::getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "in");
    args_ = {folder_ / "in", {9, 6, 20}, folder_ / "rig.yml", {}, {}};
  }
  ~CalibrateCommand() override { fs::remove_all(folder_); }

  // A picture without a board, or with one.
  void picture(const std::string& name, int width = 320, bool board = false) {
    DrawnBoard drawn;
    drawn.width_px = width;
    drawn.height_px = 240;
    drawn.step_px = 22;
    drawn.origin[0] = 50;
    drawn.origin[1] = 50;
    if (!board) drawn.dark = drawn.bright;
    const auto grey = drawn.draw();
    ASSERT_TRUE(hal::write_picture(folder_ / "in" / name, drawn.view(grey)));
  }
  void bytes(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / "in" / name) << text;
  }
  Errc error() {
    KeptLines out;
    const auto done = firmware::run_calibrate(args_, out.tell());
    EXPECT_FALSE(done);
    if (done) return Errc::InvalidState;
    where_ = done.error().where();
    EXPECT_FALSE(fs::exists(args_.output));
    EXPECT_EQ(done.error().what.view().find('\n'), std::string_view::npos);
    return done.error().code;
  }

  fs::path folder_;
  CalibrateArgs args_;
  std::string where_;
};

TEST_F(CalibrateCommand, SaysWhatIsWrongWithTheInput) {
  args_.pictures = folder_ / "none";
  EXPECT_EQ(error(), Errc::NotFound);
  args_.pictures = folder_ / "in";
  EXPECT_EQ(error(), Errc::NotFound) << "empty folder";
  picture("left_00.png");
  EXPECT_EQ(error(), Errc::InvalidInput) << "no partner";
  EXPECT_NE(where_.find("left_00.png"), std::string::npos);
  picture("right_00.png");
  EXPECT_EQ(error(), Errc::InvalidInput) << "no board anywhere";
  picture("left_00.jpg");
  EXPECT_EQ(error(), Errc::InvalidInput) << "twice";
  fs::remove(folder_ / "in/left_00.jpg");
  bytes("left_01.png", "this is no picture");
  picture("right_01.png");
  EXPECT_EQ(error(), Errc::InvalidInput);
  EXPECT_NE(where_.find("left_01.png"), std::string::npos);
  bytes("left_01.png", "");
  EXPECT_EQ(error(), Errc::InvalidInput) << "empty file";
}

TEST_F(CalibrateCommand, RefusesBoardsInPicturesOfDifferentSizes) {
  picture("left1.png", 320, true);
  picture("right1.png", 340, true);
  EXPECT_EQ(error(), Errc::InvalidInput);
  EXPECT_NE(where_.find("right1.png"), std::string::npos);
}

TEST_F(CalibrateCommand, RefusesTooFewViewsAndWrongNumbers) {
  picture("left1.png", 320, true);
  picture("right1.png", 320, true);
  EXPECT_EQ(error(), Errc::PoorGeometry);
  args_.board.corners_across = 8;
  EXPECT_EQ(error(), Errc::InvalidInput);
  args_.board.corners_across = 9;
  args_.board.square_mm = 0;
  EXPECT_EQ(error(), Errc::InvalidInput);
  args_.board.square_mm = 20;
  args_.output = folder_ / "no/such/folder/rig.yml";
  EXPECT_EQ(error(), Errc::NotFound);
}

TEST_F(CalibrateCommand, EndsWhereNobodyListensAnyMore) {
  picture("left1.png");
  picture("right1.png");
  const auto done = firmware::run_calibrate(args_, [](const std::string&) -> Result<void> {
    return Error{Errc::Cancelled, "nobody listens"};
  });
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, Errc::Cancelled);
  EXPECT_FALSE(fs::exists(args_.output));
}

TEST(TellQuality, SaysALongReasonWhole) {
  pipeline::CalibrationQuality quality;
  pipeline::ViewQuality& view = quality.views.emplace_back();
  view.name = std::string(200, 'n');
  view.reason = std::string(200, 'r');
  KeptLines out;
  EXPECT_TRUE(firmware::tell_quality(quality, out.tell()));
  EXPECT_NE(out.str().find("view " + view.name + ": left out, " + view.reason + "\n"), std::string::npos);
}

// Pictures with known answers, where they are installed.
class MeasuredPictures : public CalibrateCommand {
 protected:
  bool measured(const char* name, int across, int down, double square_mm) {
    const char* data = std::getenv("RELIEVO_TEST_DATA");
    if (data == nullptr) return false;
    args_.pictures = fs::path(data) / name;
    args_.board.corners_across = across;
    args_.board.corners_down = down;
    args_.board.square_mm = square_mm;
    return fs::is_directory(args_.pictures);
  }
  std::set<std::string> left_out(const pipeline::CalibrationQuality& quality) {
    std::set<std::string> names;
    for (const auto& view : quality.views)
      if (!view.used) names.insert(view.name);
    return names;
  }
};

TEST_F(MeasuredPictures, ARigThatMovedIsFoundOut) {
  if (!measured("real_faces/calibration", 9, 6, 10))
    GTEST_SKIP() << "real_faces/calibration is not below RELIEVO_TEST_DATA";
  args_.report = folder_ / "report";
  KeptLines out;
  const auto done = firmware::run_calibrate(args_, out.tell());
  ASSERT_TRUE(done) << done.error().what.view();
  const pipeline::CalibrationQuality& q = done->quality;
  const auto out_names = left_out(q);
  for (const char* name : {"12", "13", "14", "15", "16", "17"}) EXPECT_TRUE(out_names.contains(name)) << name;
  EXPECT_LE(out_names.size(), 9U);
  EXPECT_LE(q.pair_rms_px, 0.20);
  EXPECT_NEAR(q.baseline_mm, 116, 2);
  EXPECT_FALSE(q.holds_still);
  EXPECT_LE(q.moved_after_first, 10);
  EXPECT_GE(q.moved_after_last, 10);
  EXPECT_NE(out.str().find("do not hold still relative to each other"), std::string::npos);
  EXPECT_NE(out.str().find("a camera seems to have moved after view"), std::string::npos);
  const auto read = pipeline::read_calibration(args_.output);
  ASSERT_TRUE(read);
  EXPECT_EQ(pipeline::calibration_text(*read), pipeline::calibration_text(done->calibration));
  EXPECT_TRUE(fs::exists(args_.report / "report.json"));
  EXPECT_TRUE(fs::exists(args_.report / "corners_00.png"));
  EXPECT_TRUE(fs::exists(args_.report / "rectified_19.png"));
}

TEST_F(MeasuredPictures, AFirmRigPasses) {
  if (!measured("rendered/board", 10, 7, 20)) GTEST_SKIP() << "rendered/board is not below RELIEVO_TEST_DATA";
  KeptLines out;
  const auto done = firmware::run_calibrate(args_, out.tell());
  ASSERT_TRUE(done) << done.error().what.view();
  EXPECT_TRUE(left_out(done->quality).empty());
  EXPECT_EQ(done->quality.verdict, pipeline::CalibrationVerdict::Pass);
  const auto truth = pipeline::read_calibration(args_.pictures / "rig.yml");
  ASSERT_TRUE(truth);
  const pipeline::Vec3d t = truth->right_from_left.translation_mm;
  EXPECT_NEAR(done->quality.baseline_mm, std::sqrt(t.x * t.x + t.y * t.y + t.z * t.z), 0.03);
  EXPECT_NEAR(done->calibration.left.focal_px.x, truth->left.focal_px.x, 1.0);
}

TEST_F(MeasuredPictures, OpenCvsOwnPairs) {
  args_ = {"/usr/share/doc/opencv-doc/examples/data", {9, 6, 30}, folder_ / "rig.yml", {}, {}};
  if (!fs::exists(args_.pictures / "left01.jpg")) GTEST_SKIP() << "Debian's opencv-doc is not installed";
  KeptLines out;
  const auto done = firmware::run_calibrate(args_, out.tell());
  ASSERT_TRUE(done) << done.error().what.view();
  EXPECT_GE(done->quality.used, 11);
  EXPECT_TRUE(left_out(done->quality).contains("left/right"));
  EXPECT_NEAR(done->quality.baseline_mm, 99.8, 0.5);
}

}  // namespace
}  // namespace relievo::tests
