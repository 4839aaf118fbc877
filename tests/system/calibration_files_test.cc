// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Calibrations in and out by the built program: with a store and without, in every form; and the
// history that the store keeps of them.
#include "pipeline/calibrate/file/calibration_file.h"
#include "tests/pipeline/calibrate/file/sample_rig.h"
#include "tests/system/relievo_process.h"

namespace relievo::test {
namespace {

namespace fs = std::filesystem;

class CalibrationFiles : public RelievoProcess {
 protected:
  void SetUp() override { ASSERT_TRUE(pipeline::write_calibration(here / "rig.yml", tests::sample_rig())); }
  std::string list() { return done({"calibration", "list", "--store", "store"}).out; }
  double off(const fs::path& file, const fs::path& other = {}) {
    const auto read = pipeline::read_calibration(file, {}, other);
    EXPECT_TRUE(read) << file;
    return read ? tests::difference(*read, tests::sample_rig()) : 1;
  }
};

TEST_F(CalibrationFiles, ToRosAndBackThroughTheStore) {
  done({"calibration", "import", "rig.yml", "--store", "store", "--note", "the first"});
  done({"calibration", "export", "-o", "ros", "--as", "ros", "--store", "store"});
  EXPECT_EQ(listing(here / "ros"), "left.yaml\nright.yaml\n");
  EXPECT_LT(off(here / "ros/left.yaml"), 1e-12);
  done({"calibration", "import", "ros/right.yaml", "--store", "store"});
  done({"calibration", "export", "-o", "back.yml", "--store", "store"});
  EXPECT_LT(off(here / "back.yml"), 1e-12);
  const std::string both = list();
  EXPECT_NE(both.find("     1  "), std::string::npos) << both;
  EXPECT_NE(both.find("*    2  "), std::string::npos) << both;
  EXPECT_NE(both.find("the first"), std::string::npos) << both;
  EXPECT_NE(both.find("imported from right.yaml"), std::string::npos) << both;
  done({"calibration", "activate", "1", "--store", "store"});
  EXPECT_NE(list().find("*    1  "), std::string::npos);
  const Said none = relievo({"calibration", "activate", "9", "--store", "store"});
  EXPECT_EQ(none.exit_code, 1);
  EXPECT_NE(none.err.find("9"), std::string::npos) << none.err;
  EXPECT_NE(list().find("*    1  "), std::string::npos);
}

TEST_F(CalibrationFiles, FromFormToFormWithoutAStore) {
  done({"calibration", "export", "--calibration", "rig.yml", "-o", "ros", "--as", "ros"});
  done({"calibration", "export", "--calibration", "ros/left.yaml", "-o", "again.yml"});
  EXPECT_LT(off(here / "again.yml"), 1e-12);
  EXPECT_FALSE(fs::exists(here / "store"));
}

TEST_F(CalibrationFiles, OpenCvsSampleNeedsItsSize) {
  const tests::SampleFiles files = tests::opencv_sample_files();
  write_text(here / "intrinsics.yml", files.intrinsics);
  refused({"calibration", "import", "intrinsics.yml", "--store", "store"}, "intrinsics.yml", "other half");
  write_text(here / "extrinsics.yml", files.extrinsics);
  refused({"calibration", "import", "intrinsics.yml", "--store", "store"}, "intrinsics.yml", "--image-size");
  done({"calibration", "import", "intrinsics.yml", "--image-size", "1920x1200", "--store", "store"});
  done({"calibration", "export", "-o", "back.yml", "--store", "store"});
  EXPECT_EQ(off(here / "back.yml"), 0);
}

TEST_F(CalibrationFiles, WhatIsDamagedLeavesTheStoreAlone) {
  done({"calibration", "export", "--calibration", "rig.yml", "-o", "ros", "--as", "ros"});
  const std::string right = read_text(here / "ros/right.yaml");
  for (const std::size_t length : {std::size_t{0}, right.size() / 3, right.size() - 40, right.size() - 2}) {
    write_text(here / "ros/right.yaml", right.substr(0, length));
    refused({"calibration", "import", "ros/left.yaml", "--store", "store"}, "right.yaml");
  }
  write_text(here / "ros/right.yaml", std::string(10'000'000, '['));
  refused({"calibration", "import", "ros/left.yaml", "--store", "store"}, "right.yaml");
  write_text(here / "file", "in the way");
  refused({"calibration", "export", "--calibration", "rig.yml", "-o", "file", "--as", "ros"}, "file");
}

}  // namespace
}  // namespace relievo::test
