// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The built program from pictures of a chessboard to a model that comes back out of the store, on the
// simulated rig at a third of its size; and what it does when the disk is full or somebody presses
// Ctrl-C on the way. One test: each step needs the one before.
#include <csignal>

#include "tests/system/relievo_process.h"

namespace relievo::test {
namespace {

namespace fs = std::filesystem;

class WholeWay : public RelievoProcess {
 protected:
  void expect_files(const std::string& folder, const std::vector<std::string>& names) {
    for (const std::string& name : names) {
      EXPECT_TRUE(fs::exists(here / (folder + "/" + name)) && fs::file_size(here / (folder + "/" + name)) > 0) << folder << "/" << name;
    }
  }

  void calibrate() {
    done({"simulate", "board", "-o", "board", "--scale", "0.33", "--pairs", "8"});
    done({"calibrate", "board", "--corners", "10x7", "--square-mm", "20", "-o", "rig.yml", "--report", "report", "--store", "store"});
    expect_files(".", {"rig.yml", "store/relievo.db"});
    EXPECT_NE(done({"calibration", "list", "--store", "store"}).out.find("*    1"), std::string::npos);
    done({"calibration", "export", "-o", "again.yml", "--store", "store"});
    EXPECT_EQ(done({"calibration", "show", "--store", "store"}).out, read_text(here / "again.yml") + "\n");
  }

  void reconstruct() {
    done({"simulate", "face", "-o", "face", "--scale", "0.33", "--truth"});
    done({"reconstruct", "face/left.png", "face/right.png", "--calibration", "rig.yml", "-o", "model", "--frame", "camera"});
    expect_files("model", {"model.ply", "model.obj", "model.mtl", "model.png", "model.glb", "report.json"});
    const std::string report = read_text(here / "model/report.json");
    for (const char* key : {"\"version\"", "\"calibration\"", "\"algorithms\"", "\"stages\"", "\"arena_peak_bytes\"",
                            "\"total_ms\"", "\"peak_rss_bytes\"", "\"quality\"", "Match", "Reconstruct", "Mesh", "Texture"}) {
      EXPECT_NE(report.find(key), std::string::npos) << key;
    }
    const Said compared = done({"compare", "face/left.png", "face/right.png", "--calibration", "rig.yml", "--truth", "face", "-o", "compared"});
    EXPECT_NE(compared.out.find("interior median"), std::string::npos);
    expect_files("compared", {"compare.json", "model.ply"});
  }

  void enrol() {
    fs::create_directory(here / "pairs");
    fs::copy(here / "face/left.png", here / "pairs/left_000000.png");
    fs::copy(here / "face/right.png", here / "pairs/right_000000.png");
    EXPECT_NE(done(enrol_words()).out.find("stored: Ada Lovelace"), std::string::npos);
    EXPECT_NE(done({"subjects", "list", "--store", "store"}).out.find("1 enrolment   Ada Lovelace"), std::string::npos);
    EXPECT_NE(done({"subjects", "show", "Ada Lovelace", "--store", "store"}).out.find("calibration 1"), std::string::npos);
    done({"subjects", "export", "Ada Lovelace", "-o", "exported", "--store", "store"});
    expect_files("exported", {"model.ply", "model.obj", "model.mtl", "model.png", "model.glb", "report.json"});
    EXPECT_EQ(done({"selftest", "--store", "store"}).exit_code, 0);
    refused({"subjects", "show", "Nobody", "--store", "store"}, "Nobody");
  }

  void press_control_c() {
    std::vector<std::string> words = enrol_words();
    words.insert(words.begin(), RELIEVO_BINARY);
    const Said enrolled = run_program_and_signal(words, here.path(), SIGINT, "Capture");
    EXPECT_EQ(enrolled.exit_code, 1);
    EXPECT_EQ(std::count(enrolled.err.begin(), enrolled.err.end(), '\n'), 1) << enrolled.err;
    EXPECT_NE(done({"subjects", "list", "--store", "store"}).out.find("1 enrolment "), std::string::npos);
  }

  void press_control_c_while_writing() {
    const std::string before = listing(here.path());
    for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
             {"reconstruct", "face/left.png", "face/right.png", "--calibration", "rig.yml", "-o", "stopped"},
             {"simulate", "board", "-o", "stopped", "--scale", "0.33", "--pairs", "2"},
             {"calibrate", "board", "--corners", "10x7", "--square-mm", "20", "-o", "stopped.yml", "--report", "stopped"}}) {
      std::vector<std::string> all = words;
      all.insert(all.begin(), RELIEVO_BINARY);
      const Said said = run_program_and_signal(all, here.path(), SIGTERM, words.front() == "calibrate" ? "view 01" : "");
      // Killed before it listens, stopped, or done before the signal came: never half.
      if (said.exit_code == 0) {
        fs::remove_all(here / "stopped");
        fs::remove(here / "stopped.yml");
      }
      EXPECT_EQ(listing(here.path()), before) << words.front() << " " << said.exit_code << said.err;
    }
  }

  void fill_the_disk() {
    const TinyDisk disk(200'000);
    if (!disk.mounted()) {
      std::printf("full disk: skipped, %s\n", disk.why_not().c_str());
      return;
    }
    const std::string full = disk.path().string();
    refused({"reconstruct", "face/left.png", "face/right.png", "--calibration", "rig.yml", "-o", full + "/model"}, full + "/model", "full");
    EXPECT_EQ(listing(disk.path()), "");
    refused({"subjects", "export", "Ada Lovelace", "-o", full + "/model", "--store", "store"}, full + "/model", "full");
    EXPECT_EQ(listing(disk.path()), "");
    refused({"simulate", "board", "-o", full + "/board", "--scale", "0.33", "--pairs", "2"}, full + "/board", "room");
    EXPECT_EQ(listing(disk.path()), "");
    std::vector<std::string> words = enrol_words();
    words.back() = full + "/store";
    words.insert(words.end(), {"--calibration", "rig.yml"});
    refused(words, full);
  }

  void erase() {
    done({"subjects", "erase", "Ada Lovelace", "--store", "store"});
    EXPECT_NE(done({"subjects", "list", "--store", "store"}).out.find("nobody"), std::string::npos);
    EXPECT_EQ(read_text(here / "store/relievo.db").find("Lovelace"), std::string::npos);
  }

  static std::vector<std::string> enrol_words() {
    return {"enrol", "--board", "folder:pairs", "--subject", "Ada Lovelace", "--store", "store"};
  }
};

TEST_F(WholeWay, FromAChessboardToAModelThatComesBack) {
  calibrate();
  ASSERT_FALSE(HasFailure());
  reconstruct();
  ASSERT_FALSE(HasFailure());
  enrol();
  ASSERT_FALSE(HasFailure());
  press_control_c();
  press_control_c_while_writing();
  fill_the_disk();
  erase();
}

TEST_F(WholeWay, VersionAndMemoryNeedNothing) {
  EXPECT_EQ(done({"version"}).out.rfind("relievo ", 0), 0U);
  EXPECT_NE(done({"memory"}).out.find("scratch"), std::string::npos);
}

}  // namespace
}  // namespace relievo::test
