// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What people and scripts get wrong: each is refused in one line that says where and what, with exit
// code 1, and nothing is written.
#include <cstdint>
#include <cstring>

#include "hal/picture_file.h"
#include "pipeline/calibrate/file/calibration_file.h"
#include "tests/system/relievo_process.h"

namespace relievo::test {
namespace {

namespace fs = std::filesystem;

class BadInput : public RelievoProcess {
 protected:
  void SetUp() override {
    write_noise("left.png", 320, 240, 1);
    write_noise("right.png", 320, 240, 2);
    ASSERT_TRUE(pipeline::write_calibration(here / "rig.yml", rig(320, 240)));
  }
  static pipeline::StereoCalibration rig(int width_px, int height_px) {
    pipeline::StereoCalibration rig;
    for (pipeline::CameraIntrinsics* camera : {&rig.left, &rig.right}) {
      camera->focal_px = {1.5 * width_px, 1.5 * width_px};
      camera->centre_px = {0.5 * width_px, 0.5 * height_px};
      camera->width_px = width_px;
      camera->height_px = height_px;
    }
    rig.right_from_left.translation_mm = {-100, 0, 0};
    return rig;
  }
  void write_noise(const std::string& name, int width_px, int height_px, std::uint32_t seed) {
    std::vector<std::byte> pixels(static_cast<std::size_t>(width_px * height_px));
    for (std::byte& pixel : pixels) {
      seed = seed * 1664525U + 1013904223U;
      pixel = static_cast<std::byte>(seed >> 24);
    }
    ASSERT_TRUE(
        hal::write_picture(here / name, {pixels.data(), width_px, height_px, width_px, PixelFormat::Grey8}));
  }
  void reconstruct_refused(const std::string& left, const std::string& right, const std::string& place,
                           const std::string& trouble = "", const std::string& calibration = "rig.yml") {
    refused({"reconstruct", left, right, "--calibration", calibration, "-o", "out"}, place, trouble);
  }
  // What follows the program's name, as a shell reads it.
  Said in_shell(const std::string& words) {
    return run_program({"/bin/sh", "-c", "exec \"" RELIEVO_BINARY "\" " + words}, here.path());
  }
  void edit_rig(const std::string& from, const std::string& to) {
    std::string text = read_text(here / "rig.yml");
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from << " is not in\n" << text;
    write_text(here / "bad.yml", text.replace(at, from.size(), to));
  }
};

#ifndef RELIEVO_SANITIZED  // sanitizers reserve terabytes
TEST_F(BadInput, AMachineWithTooLittleMemory) {
  const std::string before = listing(here.path());
  // The kiosk asks for its heap first, the self-test for the stages' block.
  for (const char* command : {"--tell-nobody", "selftest"}) {
    const Said said =
        run_program({"/usr/bin/prlimit", "--data=200000000", RELIEVO_BINARY, command}, here.path());
    EXPECT_EQ(said.exit_code, 1) << command << "\n" << said.err;
    EXPECT_EQ(std::count(said.err.begin(), said.err.end(), '\n'), 1) << said.err;
    EXPECT_NE(said.err.find("this machine has too little"), std::string::npos) << said.err;
  }
  EXPECT_EQ(listing(here.path()), before);
}
#endif

TEST_F(BadInput, PicturesThatAreNone) {
  write_text(here / "empty.png", "");
  write_text(here / "text.png", "this is no picture\n");
  const std::string whole = read_text(here / "left.png");
  write_text(here / "cut.png", whole.substr(0, whole.size() / 2));
  fs::create_directory(here / "folder.png");
  for (const char* name : {"missing.png", "empty.png", "text.png", "cut.png", "folder.png"}) {
    reconstruct_refused(name, "right.png", name);
    reconstruct_refused("left.png", name, name);
  }
}

TEST_F(BadInput, AHugePicture) {
  // A PNG's own header claims 60000 x 60000; the size is refused before anything is decoded.
  std::string bytes = read_text(here / "left.png");
  const unsigned char side[4] = {0, 0, 0xEA, 0x60};
  std::memcpy(bytes.data() + 16, side, 4);
  std::memcpy(bytes.data() + 20, side, 4);
  write_text(here / "huge.png", bytes);
  reconstruct_refused("huge.png", "right.png", "huge.png");
}

TEST_F(BadInput, AnUnreadablePicture) {
  fs::permissions(here / "left.png", fs::perms::none);
  if (!read_text(here / "left.png").empty()) GTEST_SKIP() << "root reads everything";
  reconstruct_refused("left.png", "right.png", "left.png");
}

TEST_F(BadInput, PicturesThatDoNotBelongTogether) {
  write_noise("wide.png", 400, 240, 3);
  reconstruct_refused("left.png", "wide.png", "wide.png", "differ in size");
}

TEST_F(BadInput, ACalibrationOfAnotherSize) {
  ASSERT_TRUE(pipeline::write_calibration(here / "other.yml", rig(640, 480)));
  reconstruct_refused("left.png", "right.png", "640x480", "size", "other.yml");
}

TEST_F(BadInput, ACalibrationThatIsNone) {
  reconstruct_refused("left.png", "right.png", "missing.yml", "", "missing.yml");
  write_text(here / "empty.yml", "");
  reconstruct_refused("left.png", "right.png", "empty.yml", "", "empty.yml");
  const std::string whole = read_text(here / "rig.yml");
  for (std::size_t length = 1; length < whole.size() - 3; length += whole.size() / 12) {
    write_text(here / "bad.yml", whole.substr(0, length));
    reconstruct_refused("left.png", "right.png", "bad.yml", "", "bad.yml");
  }
}

TEST_F(BadInput, ACalibrationWithImpossibleNumbers) {
  for (const auto& [from, to] :
       std::vector<std::pair<std::string, std::string>>{{"4.8000000000000000e+02", "-480."},
                                                        {"4.8000000000000000e+02", ".Nan"},
                                                        {"4.8000000000000000e+02", "1e300"},
                                                        {"-1.0000000000000000e+02", "0."},
                                                        {"-1.0000000000000000e+02", "-1e9"},
                                                        {"image_width: 320", "image_width: 0"},
                                                        {"image_width: 320", "image_width: -320"}}) {
    edit_rig(from, to);
    reconstruct_refused("left.png", "right.png", "bad.yml", "", "bad.yml");
  }
}

TEST_F(BadInput, NoFaceInView) { reconstruct_refused("left.png", "right.png", "left.png", "face"); }

TEST_F(BadInput, ADissertationOfAPairWithoutAFace) {
  refused({"compare", "left.png", "right.png", "--calibration", "rig.yml", "--suite", "dissertation", "-o",
           "out"},
          "rectify: ", "no set could be tried");
}

// The cause is told, not what it led to.
TEST_F(BadInput, PicturesInTheWrongPlaces) {
  simulated({"face", "--seed", "3", "--scale", "0.4"}, "face");
  const auto wrong = [&](const char* left, const char* right, const char* trouble) {
    reconstruct_refused(std::string("face/") + left, std::string("face/") + right, left, trouble,
                        "face/rig.yml");
  };
  wrong("right.png", "left.png", "left and right are swapped");
  wrong("left.png", "left.png", "the same picture");

  // Sparse points that are alike by chance are as few either way round.
  std::string points;
  for (int y = 220; y < 280; y += 3)
    for (int x = 350; x < 430; x += 3) points += std::to_string(x) + "," + std::to_string(y) + "\n";
  write_text(here / "points.csv", points);
  std::vector<std::string> sparse{
      "reconstruct", "face/left.png", "face/right.png", "--calibration", "face/rig.yml", "-o", "out"};
  for (const char* setting : {"matcher=zmncc", "selector=file-points", "mesher=delaunay", "relief=off",
                              "file-points.path=points.csv"})
    sparse.insert(sparse.end(), {"--set", setting});
  refused(sparse, "face/left.png", "no surface of a face's size");
}

TEST_F(BadInput, SettingsThatDoNotExist) {
  const std::vector<std::string> call{"reconstruct", "left.png", "right.png", "--calibration",
                                      "rig.yml",     "-o",       "out"};
  for (const char* setting : {"matcher=psychic", "nobody=1", "refined.bending=much", "justaword", "="}) {
    std::vector<std::string> words = call;
    words.insert(words.end(), {"--set", setting});
    refused(words, setting == std::string("=") ? "=" : std::string(setting).substr(0, 6));
  }
  std::vector<std::string> unknown = call;
  unknown.insert(unknown.end(), {"--set", "foo=1"});
  refused(unknown, "foo (", "matcher");
  write_text(here / "bad.toml", "[matcher\n");
  std::vector<std::string> words = call;
  words.insert(words.end(), {"--algorithms", "bad.toml"});
  refused(words, "bad.toml:1");
}

TEST_F(BadInput, AnOutputThatIsAFile) {
  write_text(here / "out", "mine");
  reconstruct_refused("left.png", "right.png", "");
  EXPECT_EQ(read_text(here / "out"), "mine");
}

TEST_F(BadInput, CalibratingFromWhatShowsNoBoard) {
  const std::vector<std::string> rest{"--corners", "10x7", "--square-mm", "20", "-o", "new.yml"};
  const auto calibrate_refused = [&](const std::string& folder, const std::string& place) {
    std::vector<std::string> words{"calibrate", folder};
    words.insert(words.end(), rest.begin(), rest.end());
    refused(words, place);
  };
  calibrate_refused("missing", "missing");
  fs::create_directory(here / "empty");
  calibrate_refused("empty", "empty");
  fs::create_directory(here / "noise");
  for (const char* pair : {"0", "1", "2"}) {
    write_noise("noise/left" + std::string(pair) + ".png", 320, 240, 5);
    write_noise("noise/right" + std::string(pair) + ".png", 320, 240, 6);
  }
  calibrate_refused("noise", "noise");
  fs::remove(here / "noise/right1.png");
  calibrate_refused("noise", "left1.png");
}

TEST_F(BadInput, EnrollingWithoutWhatItNeeds) {
  refused({"enrol", "--board", "toaster", "--subject", "Ada", "--calibration", "rig.yml", "--store", "store"},
          "toaster");
  for (const char* nothing : {"folder:", "linux:"})
    refused({"enrol", "--board", nothing, "--subject", "Ada", "--calibration", "rig.yml", "--store", "store"},
            nothing, "is no board");
  refused({"enrol", "--board", "folder:missing", "--subject", "Ada", "--calibration", "rig.yml", "--store",
           "store"},
          "missing");
  fs::create_directory(here / "empty");
  refused({"enrol", "--board", "folder:empty", "--subject", "Ada", "--calibration", "rig.yml", "--store",
           "store"},
          "empty");
  fs::create_directory(here / "pair");
  fs::copy(here / "left.png", here / "pair/left_000000.png");
  fs::copy(here / "right.png", here / "pair/right_000000.png");
  write_text(here / "file", "no store\n");
  refused(
      {"enrol", "--board", "folder:pair", "--subject", "Ada", "--calibration", "rig.yml", "--store", "file"},
      "file");
  refused(
      {"enrol", "--board", "folder:pair", "--subject", "Ada", "--calibration", "no.yml", "--store", "store"},
      "no.yml");
  refused({"enrol", "--board", "folder:pair", "--subject", "Ada", "--store", "store"}, "store",
          "relievo calibrate");
  for (const char* name : {"", " ", "Ada ", " Ada"})
    refused({"enrol", "--board", "folder:pair", "--subject", name, "--calibration", "rig.yml", "--store",
             "store"},
            "no name to enrol by");
}

TEST_F(BadInput, APersonWhoIsNotThere) {
  refused({"subjects", "list", "--store", "nowhere"}, "nowhere");
  refused({"subjects", "show", "Ada", "--store", "nowhere"}, "nowhere");
  refused({"subjects", "erase", "Ada", "--store", "nowhere"}, "nowhere");
  refused({"calibration", "activate", "1", "--store", "nowhere"}, "nowhere");
  refused({"calibration", "import", "missing.yml", "--store", "nowhere"}, "missing.yml");
}

// What the next start says (firmware/kiosk/stored_visits.h): that this one ended early, where there was a
// screen; where there was none, what this one would have said.
TEST_F(BadInput, AKioskThatFindsNoScreenLeavesItsMarkAsItWas) {
  fs::create_directory(here / "pair");
  fs::copy_file(here / "left.png", here / "pair/left_000000.png");
  fs::copy_file(here / "right.png", here / "pair/right_000000.png");
  write_text(here / "in_vain.script", "wait review 0.1\n");
  const auto mark_after = [this](const std::string& driver) {
    const Said said = run_program({"/usr/bin/env", "SDL_VIDEODRIVER=" + driver, RELIEVO_BINARY, "--board",
                                   "folder:pair", "--calibration", "rig.yml", "--store", "store",
                                   "--windowed", "640x480", "--script", "in_vain.script"},
                                  here.path());
    EXPECT_EQ(said.exit_code, 1) << said.err;
    return fs::exists(here / "store/relievo.running");
  };
  EXPECT_FALSE(mark_after("none"));
  EXPECT_TRUE(mark_after("offscreen"));
  EXPECT_TRUE(mark_after("none"));
}

TEST_F(BadInput, ATruthThatIsNotThere) {
  refused({"compare", "left.png", "right.png", "--calibration", "rig.yml", "--truth", "gone", "-o", "out"},
          "gone", "there is no such file");
}

TEST_F(BadInput, WhatCouldNotBePrintedIsNoSuccess) {
  for (const char* words : {"algorithms", "--help"}) {
    const Said full = in_shell(std::string(words) + " >/dev/full");
    EXPECT_EQ(full.exit_code, 1) << words;
    EXPECT_EQ(full.err.rfind("relievo: standard output: ", 0), 0U) << full.err;
    EXPECT_EQ(std::count(full.err.begin(), full.err.end(), '\n'), 1) << full.err;
    EXPECT_EQ(in_shell(std::string(words) + " >&-").exit_code, 0) << "nobody wanted to read it";
  }
  const Said told = in_shell("calibration import rig.yml --store store >/dev/full");
  EXPECT_EQ(told.exit_code, 1);
  EXPECT_NE(told.err.find("has been done"), std::string::npos) << told.err;
  EXPECT_NE(done({"calibration", "list", "--store", "store"}).out.find("rig.yml"), std::string::npos);
}

TEST_F(BadInput, WhatNobodyReadsIsWrittenIntoNoFile) {
  EXPECT_EQ(in_shell("calibration import rig.yml --store store >&-").exit_code, 0);
  EXPECT_EQ(fs::file_size(here / "store/relievo.lock"), 0U) << read_text(here / "store/relievo.lock");
}

TEST_F(BadInput, WrongWordsAreToldFromWrongFiles) {
  for (const auto& words : std::vector<std::vector<std::string>>{
           {"--windowed", "wide"}, {"bogus"}, {"reconstruct", "left.png"}}) {
    const Said said = relievo(words);
    EXPECT_EQ(said.exit_code, 2);
    EXPECT_EQ(std::count(said.err.begin(), said.err.end(), '\n'), 1) << said.err;
  }
}

}  // namespace
}  // namespace relievo::test
