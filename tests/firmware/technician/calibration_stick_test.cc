// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/technician/stick_files.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <atomic>
#include <fstream>
#include <functional>

#include "hal/sim/optics/rig.h"
#include "pipeline/calibrate/file/calibration_file.h"
#include "tests/support/small_rig.h"
#include "tests/support/temporary_folder.h"

namespace relievo::firmware {
namespace {

namespace fs = std::filesystem;

// A stick that is a folder; it may be gone, or lose what it is given before it is read back.
class FolderStick final : public hal::RemovableMedia {
 public:
  explicit FolderStick(fs::path root) : root_(std::move(root)) {}
  std::optional<std::filesystem::path> current() override {
    if (asked) asked();
    return gone ? std::nullopt : std::optional(root_);
  }
  Result<void> settle(const fs::path& folder) override {
    if (spoils) std::ofstream(folder / "left.yaml", std::ios::app) << "x";
    if (leaves) gone = true;
    return {};
  }
  Result<void> flush_and_eject() override {
    ++ejected;
    return {};
  }
  bool gone = false, spoils = false, leaves = false;
  int ejected = 0;
  std::function<void()> asked;  // where it is

 private:
  fs::path root_;
};

class CalibrationStick : public testing::Test {
 protected:
  void SetUp() override {
    const auto file = here.path() / "made.yml";
    ASSERT_TRUE(hal::sim::write_rig(file, hal::sim::make_rig(test::small_rig(0.4))));
    calibration = *pipeline::read_calibration(file);
    fs::create_directory(root);
  }
  ::relievo::test::TemporaryFolder here;
  const fs::path root = here.path() / "stick";
  pipeline::StereoCalibration calibration;
  FolderStick stick{root};
};

TEST_F(CalibrationStick, WhatIsExportedComesBackInEitherForm) {
  ASSERT_TRUE(export_calibration(calibration, "0002", stick));
  EXPECT_EQ(stick.ejected, 1);
  const auto rig = import_calibration(stick);
  ASSERT_TRUE(rig);
  EXPECT_EQ(rig->file, "calibrations/0002/rig.yml");
  EXPECT_EQ(pipeline::calibration_text(rig->calibration), pipeline::calibration_text(calibration))
      << "to the last digit";
  fs::remove(root / "calibrations/0002/rig.yml");
  const auto ros = import_calibration(stick);
  ASSERT_TRUE(ros);
  EXPECT_EQ(ros->file, "calibrations/0002/left.yaml");
  EXPECT_NEAR(ros->calibration.left.focal_px.x, calibration.left.focal_px.x, 1e-6);
  EXPECT_NEAR(ros->calibration.right_from_left.translation_mm.x, calibration.right_from_left.translation_mm.x,
              1e-6);
}

TEST_F(CalibrationStick, TheTopComesFirstThenTheLastName) {
  ASSERT_TRUE(export_calibration(calibration, "0009", stick));
  ASSERT_TRUE(export_calibration(calibration, "0010", stick));
  EXPECT_EQ(import_calibration(stick)->file, "calibrations/0010/rig.yml");
  ASSERT_TRUE(pipeline::write_calibration(root / "rig.yml", calibration));
  EXPECT_EQ(import_calibration(stick)->file, "rig.yml");
}

TEST_F(CalibrationStick, SaysWhatIsMissingOrWrong) {
  EXPECT_EQ(import_calibration(stick).error().code, Errc::NotFound);
  std::ofstream(root / "rig.yml") << "%YAML:1.0\nK1: 3\n";
  EXPECT_EQ(import_calibration(stick).error().code, Errc::InvalidInput);
  stick.gone = true;
  EXPECT_EQ(import_calibration(stick).error().code, Errc::MediaMissing);
  EXPECT_EQ(export_calibration(calibration, "0001", stick).error().code, Errc::MediaMissing);
}

TEST_F(CalibrationStick, NothingHalfWrittenStands) {
  stick.spoils = true;
  EXPECT_EQ(export_calibration(calibration, "0001", stick).error().code, Errc::IoFailed);
  EXPECT_FALSE(fs::exists(root / "calibrations/0001"));
  stick.spoils = false;
  stick.leaves = true;
  EXPECT_EQ(export_calibration(calibration, "0001", stick).error().code, Errc::Disconnected);
  stick.gone = false;
  const std::atomic<bool> cancelled{false};
  pipeline::Progress progress;
  JobControl control{cancelled, progress};
  ExportTrace trace;
  const SavedBytes document({std::byte{1}});
  EXPECT_EQ(save_reconstruction(document, "one", stick, control, trace).error().code, Errc::Disconnected);
  EXPECT_EQ(stick.ejected, 0);
  for (const auto& left : fs::recursive_directory_iterator(root))
    EXPECT_TRUE(left.is_directory()) << left.path() << " lies where the stick was";
}

TEST_F(CalibrationStick, WhoStopsWhatHasItsNameAlreadyHasItAndTheStickIsLetGo) {
  std::atomic<bool> cancelled{false};
  pipeline::Progress progress;
  JobControl control{cancelled, progress};
  ExportTrace trace;
  const fs::path file = root / kSavedFolder / (std::string("one") + kSavedEnding);
  stick.asked = [&] { cancelled = fs::exists(file); };
  EXPECT_TRUE(save_reconstruction(SavedBytes({std::byte{1}}), "one", stick, control, trace));
  EXPECT_TRUE(cancelled) << "it was stopped";
  EXPECT_TRUE(fs::exists(file));
  EXPECT_EQ(stick.ejected, 1);
}

// Who opens a pipe waits for its other end: for ever.
TEST_F(CalibrationStick, WhatIsNoFileIsNeitherListedNorOpened) {
  const fs::path saved = root / kSavedFolder;
  fs::create_directories(saved / "folder.relievo");
  ASSERT_EQ(mkfifo((saved / "pipe.relievo").c_str(), 0600), 0);
  fs::create_symlink("pipe.relievo", saved / "link.relievo");
  std::ofstream(saved / "file.relievo") << "x";
  const auto names = saved_reconstructions(stick, 9);
  ASSERT_TRUE(names);
  EXPECT_EQ(*names, std::vector<std::string>{"file.relievo"});
  const std::atomic<bool> cancelled{false};
  pipeline::Progress progress;
  JobControl control{cancelled, progress};
  for (const char* name : {"pipe.relievo", "link.relievo", "folder.relievo"}) {
    const auto read = read_saved(name, stick, control);
    ASSERT_FALSE(read) << name;
    EXPECT_EQ(read.error().code, Errc::InvalidInput) << name;
    EXPECT_EQ(read.error().what.view(), "this is not a file");
  }
  EXPECT_EQ(read_saved("none.relievo", stick, control).error().code, Errc::IoFailed);
}

// What a stick that was pulled out has left: the next export clears the one and brings back the other.
TEST_F(CalibrationStick, WhatWasLeftIsPutInOrder) {
  fs::create_directories(root / "calibrations/.0001.part77");
  ASSERT_TRUE(export_calibration(calibration, "0003", stick));
  fs::rename(root / "calibrations/0003", root / "calibrations/.0003.before");
  ASSERT_TRUE(export_calibration(calibration, "0004", stick));
  EXPECT_FALSE(fs::exists(root / "calibrations/.0001.part77"));
  EXPECT_FALSE(fs::exists(root / "calibrations/.0003.before"));
  EXPECT_TRUE(fs::exists(root / "calibrations/0003/rig.yml"));
}

}  // namespace
}  // namespace relievo::firmware
