// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The built program from pictures of a chessboard to a model that comes back out of the store, on the
// simulated rig at a third of its size; and what it does when the disk is full or somebody presses
// Ctrl-C on the way. One test: each step needs the one before.
#include <csignal>

#include "pipeline/calibrate/file/calibration_file.h"
#include "tests/support/rig_calibration.h"
#include "tests/system/relievo_process.h"

namespace relievo::test {
namespace {

namespace fs = std::filesystem;

class WholeWay : public RelievoProcess {
 protected:
  void expect_files(const std::string& folder, const std::vector<std::string>& names) {
    for (const std::string& name : names) {
      EXPECT_TRUE(fs::exists(here / (folder + "/" + name)) && fs::file_size(here / (folder + "/" + name)) > 0)
          << folder << "/" << name;
    }
  }

  void calibrate() {
    done({"simulate", "board", "-o", "board", "--scale", "0.33", "--pairs", "8"});
    done({"calibrate", "board/", "--corners", "10x7", "--square-mm", "20", "-o", "rig.yml", "--report",
          "report", "--store", "store"});
    expect_files(".", {"rig.yml", "store/relievo.db", "report/index.html", "report/report.json",
                       "report/corners_00.png"});
    const std::string list = done({"calibration", "list", "--store", "store"}).out;
    EXPECT_NE(list.find("*    1"), std::string::npos) << list;
    EXPECT_NE(list.find("calibrated from board"), std::string::npos) << list;
    EXPECT_TRUE(list.find("pass") != std::string::npos || list.find("usable") != std::string::npos) << list;
    refused({"calibrate", "board", "--corners", "10x7", "--square-mm", "20.5", "-o", "wrong.yml", "--store",
             "store"},
            "board", "refused");
    done({"calibration", "export", "-o", "again.yml", "--store", "store"});
    EXPECT_EQ(done({"calibration", "show", "--store", "store"}).out, read_text(here / "again.yml") + "\n");
  }

  void reconstruct() {
    simulated({"face", "--scale", "0.33", "--truth"}, "face");
    done({"reconstruct", "face/left.png", "face/right.png", "--calibration", "rig.yml", "-o", "model",
          "--frame", "camera"});
    expect_files("model", {"model.ply", "model.stl", "model.obj", "model.mtl", "model.png", "model.glb",
                           "portrait.png", "range.png", "recognition.json", "report.json"});
    const std::string report = read_text(here / "model/report.json");
    for (const char* key : {"\"version\"", "\"calibration\"", "\"algorithms\"", "\"stages\"",
                            "\"arena_peak_bytes\"", "\"total_ms\"", "\"peak_rss_bytes\"", "\"quality\"",
                            "\"texture_sharpness\"", "Match", "Reconstruct", "Mesh", "Texture"}) {
      EXPECT_NE(report.find(key), std::string::npos) << key;
    }
    const Said compared = done({"compare", "face/left.png", "face/right.png", "--calibration", "rig.yml",
                                "--truth", "face", "-o", "compared"});
    EXPECT_NE(compared.out.find("interior median"), std::string::npos);
    expect_files("compared", {"compare.json", "model.ply"});
    compare_surfaces();
  }

  // Each mesher's own, with what it took; one map for what they share, and how many windows a correlation is
  // of.
  void compare_surfaces() {
    const Said said =
        done({"compare", "face/left.png", "face/right.png", "--calibration", "rig.yml", "--set-of",
              "grid: mesher=grid", "--set-of", "delaunay: mesher=delaunay", "-o", "surfaces"});
    EXPECT_NE(said.out.find("mesh "), std::string::npos) << said.out;
    const std::string html = read_text(here / "surfaces/index.html");
    std::vector<std::string> pictures;
    for (const char* set : {"grid", "delaunay"}) {
      const std::size_t at = html.find(std::string(set) + ": its surface");
      ASSERT_NE(at, std::string::npos) << set;
      const std::size_t from = html.find("base64,", at);
      pictures.push_back(html.substr(from, html.find('"', from) - from));
    }
    EXPECT_GT(pictures[0].size(), 10000U);
    EXPECT_NE(pictures[0], pictures[1]) << "two surfaces";
    for (const char* words : {"ms to mesh", "grid, delaunay: disparities", " windows</small>",
                              "class=\"kept\">\n<h3 class=\"topic\">Time and memory"})
      EXPECT_NE(html.find(words), std::string::npos) << words;
  }

  void enrol() {
    fs::create_directory(here / "pairs");
    fs::copy(here / "face/left.png", here / "pairs/left_000000.png");
    fs::copy(here / "face/right.png", here / "pairs/right_000000.png");
    EXPECT_NE(done(enrol_words()).out.find("stored: Ada Lovelace"), std::string::npos);
    EXPECT_NE(done({"subjects", "list", "--store", "store"}).out.find("1 enrolment   Ada Lovelace"),
              std::string::npos);
    EXPECT_NE(done({"subjects", "show", "Ada Lovelace", "--store", "store"}).out.find("calibration 1"),
              std::string::npos);
    done({"subjects", "export", "Ada Lovelace", "-o", "exported", "--store", "store"});
    expect_files("exported", {"model.ply", "model.stl", "model.obj", "model.mtl", "model.png", "model.glb",
                              "portrait.png", "range.png", "recognition.json", "report.json", "person.record",
                              "manifest.json", "signature.json"});
    export_sealed();
    import_it();
    EXPECT_EQ(done({"selftest", "--store", "store"}).exit_code, 0);
    refused({"subjects", "show", "Nobody", "--store", "store"}, "Nobody");
  }

  // Another device takes her in, when it was told whom to believe.
  void import_it() {
    done({"calibration", "import", "rig.yml", "--store", "store2"});
    refused({"subjects", "import", "exported", "--store", "store2"}, "signed this copy, not this store");
    const std::string told = done({"store", "check", "--store", "store"}).out;
    const std::size_t at = told.find("signed by ");
    ASSERT_NE(at, std::string::npos) << told;
    EXPECT_NE(
        done({"subjects", "import", "exported", "--store", "store2", "--signed-by", told.substr(at + 10, 64)})
            .out.find("taken in: #1 Ada Lovelace"),
        std::string::npos);
    EXPECT_NE(done({"subjects", "show", "Ada Lovelace", "--store", "store2"}).out.find("1 enrolment"),
              std::string::npos);
    done({"store", "check", "--store", "store2"});
    done({"subjects", "erase", "Ada Lovelace", "--store", "store2"});
    refused({"subjects", "import", "exported", "--store", "store2", "--signed-by", told.substr(at + 10, 64)},
            "exported", "was erased from this store");
  }

  // One file, which tells nobody anything but whom it is for.
  void export_sealed() {
    if (test::run_program({"/usr/bin/age-keygen", "-o", "key"}, here.path()).exit_code != 0) return;
    const std::string key = test::read_text(here / "key");
    const std::vector<std::string> words{"subjects", "export",  "Ada Lovelace", "-o",
                                         "ada.age",  "--store", "store",        "--to"};
    auto to = words;
    to.push_back(key.substr(key.find("age1"), 62));
    done(to);
    const std::string sealed = test::read_text(here / "ada.age");
    for (const char* inside : {"model.ply", "Ada Lovelace", "manifest"})
      EXPECT_EQ(sealed.find(inside), std::string::npos) << inside;
    EXPECT_EQ(test::run_program({"/usr/bin/age", "-d", "-i", "key", "-o", "ada.tar", "ada.age"}, here.path())
                  .exit_code,
              0);
    fs::create_directory(here / "unsealed");
    EXPECT_EQ(test::run_program({"/usr/bin/tar", "xf", "../ada.tar"}, here / "unsealed").exit_code, 0);
    expect_files("unsealed", {"model.ply", "model.stl", "model.obj", "model.mtl", "model.png", "model.glb",
                              "portrait.png", "range.png", "recognition.json", "report.json", "person.record",
                              "manifest.json", "signature.json"});
    EXPECT_TRUE(test::read_text(here / "unsealed/model.ply") == test::read_text(here / "exported/model.ply"));
    EXPECT_NE(test::read_text(here / "unsealed/manifest.json").find("\"name\": \"Ada Lovelace\""),
              std::string::npos);
    to.back() = "age1nobody";
    refused(to, "age1nobody");
    to.insert(to.end(), {"--watertight"});
    EXPECT_EQ(relievo(to).exit_code, 2);
  }

  // The right camera nods after the calibration: what makes so many pixels across the rows.
  void knock(double px, const std::string& file) {
    const auto rig = pipeline::read_calibration(here / "rig.yml");
    ASSERT_TRUE(rig);
    ASSERT_TRUE(pipeline::write_calibration(here / file, turned(*rig, px / rig->right.focal_px.y, 0, 0)));
  }

  void name_a_calibration_of_a_file(const std::string& file) {
    std::vector<std::string> words = enrol_words();
    words[4] = "Bob";
    words.insert(words.end(), {"--calibration", file});
    EXPECT_NE(done(words).out.find("Calibration  warn"), std::string::npos);
    EXPECT_NE(done({"subjects", "show", "Bob", "--store", "store"}).out.find("calibration 2"),
              std::string::npos);
    const std::string list = done({"calibration", "list", "--store", "store"}).out;
    EXPECT_NE(list.find("*    1"), std::string::npos)
        << "to measure with one is not to put it in use: " << list;
    EXPECT_NE(list.find("1  of an enrolment, from " + file), std::string::npos) << list;
    done({"subjects", "erase", "Bob", "--store", "store"});
  }

  void notice_a_knock() {
    const auto reconstruct = [](const std::string& calibration) {
      return std::vector<std::string>{
          "reconstruct", "face/left.png", "face/right.png", "--calibration", calibration, "-o", "knocked"};
    };
    EXPECT_NE(read_text(here / "model/report.json").find("\"verdict\": \"ok\""), std::string::npos)
        << read_text(here / "model/report.json");
    knock(0.5, "nudged.yml");
    EXPECT_NE(done(reconstruct("nudged.yml")).out.find("Calibration  warn"), std::string::npos);
    EXPECT_NE(read_text(here / "knocked/report.json").find("\"verdict\": \"warn\""), std::string::npos);
    fs::remove_all(here / "knocked");
    name_a_calibration_of_a_file("nudged.yml");
    knock(3, "knocked.yml");
    refused(reconstruct("knocked.yml"), "face/left.png", "calibrate again");
    std::vector<std::string> words = reconstruct("knocked.yml");
    words.emplace_back("--despite-drift");
    done(words);
    fs::remove_all(here / "knocked");
    done({"calibration", "import", "knocked.yml", "--store", "store"});
    const Said enrolled = relievo(enrol_words());
    EXPECT_EQ(enrolled.exit_code, 1);
    EXPECT_NE(enrolled.err.find("calibrate again"), std::string::npos) << enrolled.err;
    EXPECT_NE(done({"subjects", "list", "--store", "store"}).out.find("1 enrolment "), std::string::npos);
    EXPECT_NE(read_text(here / "store/relievo.db").find("calibration.drift"), std::string::npos)
        << "in the log of events";
    done({"calibration", "activate", "1", "--store", "store"});
    EXPECT_NE(done({"calibration", "list", "--store", "store"}).out.find("*    1"), std::string::npos);
  }

  void press_control_c() {
    std::vector<std::string> words = enrol_words();
    words.insert(words.begin(), RELIEVO_BINARY);
    const Said enrolled = run_program_and_signal(words, here.path(), SIGINT, "Capture");
    EXPECT_EQ(enrolled.exit_code, 1);
    EXPECT_EQ(std::count(enrolled.err.begin(), enrolled.err.end(), '\n'), 1) << enrolled.err;
    EXPECT_NE(done({"subjects", "list", "--store", "store"}).out.find("1 enrolment "), std::string::npos);
  }

  // One transaction cannot be stopped: what was said of it is true.
  void press_control_c_while_storing() {
    std::vector<std::string> words = enrol_words();
    words[4] = "Eve";
    words.insert(words.begin(), RELIEVO_BINARY);
    const Said enrolled = run_program_and_signal(words, here.path(), SIGINT, "Assemble");
    const Said erased = relievo({"subjects", "erase", "Eve", "--store", "store"});
    EXPECT_EQ(enrolled.exit_code, erased.exit_code) << "told as it is: " << enrolled.err << erased.err;
    EXPECT_EQ(done({"subjects", "list", "--store", "store"}).out.find("Eve"), std::string::npos);
  }

  void press_control_c_while_writing() {
    const std::string before = listing(here.path());
    for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
             {"reconstruct", "face/left.png", "face/right.png", "--calibration", "rig.yml", "-o", "stopped"},
             {"simulate", "board", "-o", "stopped", "--scale", "0.33", "--pairs", "2"},
             {"calibrate", "board", "--corners", "10x7", "--square-mm", "20", "-o", "stopped.yml", "--report",
              "stopped"}}) {
      std::vector<std::string> all = words;
      all.insert(all.begin(), RELIEVO_BINARY);
      const Said said =
          run_program_and_signal(all, here.path(), SIGTERM, words.front() == "calibrate" ? "view 01" : "");
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
    refused(
        {"reconstruct", "face/left.png", "face/right.png", "--calibration", "rig.yml", "-o", full + "/model"},
        full + "/model", "full");
    EXPECT_EQ(listing(disk.path()), "");
    refused({"subjects", "export", "Ada Lovelace", "-o", full + "/model", "--store", "store"},
            full + "/model", "full");
    EXPECT_EQ(listing(disk.path()), "");
    refused({"simulate", "board", "-o", full + "/board", "--scale", "0.33", "--pairs", "2"}, full + "/board",
            "room");
    EXPECT_EQ(listing(disk.path()), "");
    refused({"calibrate", "board", "--corners", "10x7", "--square-mm", "20", "-o", "unwritten.yml",
             "--report", full + "/report"},
            full + "/report", "room");
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
  notice_a_knock();
  press_control_c();
  press_control_c_while_storing();
  press_control_c_while_writing();
  fill_the_disk();
  erase();
}

TEST_F(WholeWay, TheSimulatedRigNeedsNoCalibration) {
  EXPECT_NE(done({"enrol", "--board", "sim", "--subject", "Ada", "--store", "fresh"}).out.find("stored: Ada"),
            std::string::npos);
  // It is kept for the model, and not taken into use.
  EXPECT_NE(done({"calibration", "list", "--store", "fresh"}).out.find("relievo calibration activate"),
            std::string::npos);
  refused({"selftest", "--store", "fresh"}, "fresh", "is in use");
  done({"calibration", "activate", "1", "--store", "fresh"});
  EXPECT_NE(done({"selftest", "--store", "fresh"}).out.find("calibration  in order"), std::string::npos);
}

TEST_F(WholeWay, AlgorithmsAreListedWithOptionsRangesAndSources) {
  const std::string all = done({"algorithms"}).out;
  for (const char* word : {"selector: ", "grid-points", "zmncc", "Bardsley 2004", "default refined"})
    EXPECT_NE(all.find(word), std::string::npos) << word;
  const std::string one = done({"algorithms", "zmncc"}).out;
  for (const char* word : {"matcher = zmncc", "source: ", "zmncc.window_px = 25", "3 to 63"})
    EXPECT_NE(one.find(word), std::string::npos) << word;
  refused({"algorithms", "magic"}, "magic", "relievo algorithms");
}

TEST_F(WholeWay, VersionAndMemoryNeedNothing) {
  EXPECT_EQ(done({"version"}).out.rfind("relievo ", 0), 0U);
  const std::string plan = done({"memory"}).out;
  for (const char* part : {"scratch", "sides of a head"})
    EXPECT_NE(plan.find(part), std::string::npos) << part;
}

}  // namespace
}  // namespace relievo::test
