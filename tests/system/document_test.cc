// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A reconstruction saved, loaded and calculated again from every stage: the same files, byte for byte. What
// is no whole document is refused, and a full disk keeps no half of one.
#include <filesystem>
#include <fstream>

#include "pipeline/calibrate/file/calibration_file.h"
#include "pipeline/match/rectify/rectifier.h"
#include "tests/system/relievo_process.h"

namespace relievo::test {
namespace {

namespace fs = std::filesystem;

class SavedReconstruction : public RelievoProcess {
 protected:
  // Everything but report.json, which has times.
  void expect_same_model(const std::string& a, const std::string& b) {
    for (const char* name : {"model.ply", "model.obj", "model.png", "model.stl", "model.glb",
                             "model_origin.png", "portrait.png", "range.png", "recognition.json"})
      EXPECT_EQ(read_text(here / (a + "/" + name)), read_text(here / (b + "/" + name))) << b << "/" << name;
  }
  void flip(const std::string& name, std::streamoff at) {
    std::fstream file(here / name, std::ios::in | std::ios::out | std::ios::binary);
    file.seekg(at);
    const char was = static_cast<char>(file.get());
    file.seekp(at);
    file.put(static_cast<char>(was ^ 1));
  }
};

TEST_F(SavedReconstruction, IsTheSameLoadedAndCalculatedAgainFromEveryStage) {
  simulated({"face", "--seed", "3", "--scale", "0.4"}, "face");
  const std::vector<std::string> first{
      "reconstruct",  "face/left.png", "face/right.png",       "--calibration",
      "face/rig.yml", "--set",         "texturer=single-view", "-o",
      "first"};
  auto saving = first;
  saving.insert(saving.end(), {"--save", "face.relievo"});
  EXPECT_NE(done(saving).out.find("saved, with the person's face: face.relievo"), std::string::npos);
  fs::remove_all(here / "face");  // it needs nothing beside it

  const std::string loaded =
      done({"reconstruct", "--load", "face.relievo", "--save", "again.relievo", "-o", "loaded"}).out;
  EXPECT_NE(loaded.find("(as saved)"), std::string::npos) << loaded;
  expect_same_model("first", "loaded");
  EXPECT_EQ(read_text(here / "again.relievo"), read_text(here / "face.relievo"));
  for (const std::string stage : {"match", "reconstruct", "mesh", "texture", "assemble"}) {
    done({"reconstruct", "--load", "face.relievo", "--from", stage, "-o", stage});
    expect_same_model("first", stage);
  }

  // Other settings: what they have no part in is as it was saved.
  const std::string mesh =
      done({"reconstruct", "--load", "face.relievo", "--set", "grid.max_triangles=9000", "-o", "coarse"}).out;
  EXPECT_NE(mesh.find("Reconstruct"), std::string::npos);
  EXPECT_LT(fs::file_size(here / "coarse/model.ply"), fs::file_size(here / "first/model.ply"));
  refused({"reconstruct", "--load", "face.relievo", "--set", "matcher=zmncc", "--from", "mesh", "-o", "none"},
          "--from mesh", "before this one");
  EXPECT_EQ(
      relievo({"reconstruct", "--load", "face.relievo", "left.png", "right.png", "-o", "none"}).exit_code, 2);
  EXPECT_EQ(relievo({"reconstruct", "--from", "mesh", "-o", "none"}).exit_code, 2);

  const auto load = [](const std::string& name) {
    return std::vector<std::string>{"reconstruct", "--load", name, "-o", "none"};
  };
  fs::copy(here / "face.relievo", here / "cut.relievo");
  fs::resize_file(here / "cut.relievo", fs::file_size(here / "cut.relievo") / 2);
  refused(load("cut.relievo"), "cut.relievo", "damaged");
  fs::copy(here / "face.relievo", here / "changed.relievo");
  flip("changed.relievo", static_cast<std::streamoff>(fs::file_size(here / "face.relievo") / 3));
  refused(load("changed.relievo"), "changed.relievo", "damaged");
  fs::copy(here / "face.relievo", here / "newer.relievo");
  flip("newer.relievo", 62);
  refused(load("newer.relievo"), "newer.relievo", "update Relievo");
  refused(load("first/model.ply"), "first/model.ply", "no saved reconstruction");
  refused(load("missing.relievo"), "missing.relievo");

  // The folder cannot become whole: where one of its files belongs a directory stands.
  fs::create_directories(here / "taken/model.ply");
  const Said taken =
      relievo({"reconstruct", "--load", "face.relievo", "-o", "taken", "--save", "late.relievo"});
  EXPECT_EQ(taken.exit_code, 1);
  EXPECT_NE(taken.err.find("taken/model.ply"), std::string::npos) << taken.err;
  EXPECT_FALSE(fs::exists(here / "late.relievo"));
  EXPECT_FALSE(fs::exists(here / ".late.relievo.part"));

  const TinyDisk disk(200'000);
  if (!disk.mounted()) GTEST_SKIP() << disk.why_not();
  refused({"reconstruct", "--load", "face.relievo", "-o", "none", "--save",
           (disk.path() / "full.relievo").string()},
          "full.relievo", "full");
  EXPECT_EQ(listing(disk.path()), "");
  EXPECT_FALSE(fs::exists(here / "none"));
}

TEST_F(SavedReconstruction, SaysAgainWhyItIsNotKnownToBeAFace) {
  simulated({"face", "--seed", "3", "--scale", "0.4"}, "face");
  const auto why = [](const std::string& out) {
    const std::size_t from = out.find("not judged to be a face");
    return from == std::string::npos ? "" : out.substr(from, out.find('\n', from) - from);
  };
  const std::string said =
      why(done({"reconstruct", "face/left.png", "face/right.png", "--calibration", "face/rig.yml", "--set",
                "relief.least_sigmas=90", "-o", "first", "--save", "face.relievo"})
              .out);
  EXPECT_NE(said, "");
  EXPECT_EQ(why(done({"reconstruct", "--load", "face.relievo", "-o", "loaded"}).out), said);
}

// Loaded where these files are not, it is calculated again from the first stage on.
TEST_F(SavedReconstruction, HasTheTextsThatItsAlgorithmsRead) {
  simulated({"face", "--seed", "3", "--scale", "0.4"}, "face");
  const auto rig = pipeline::read_calibration(here / "face/rig.yml");
  pipeline::RectifiedPair windows(std::pmr::get_default_resource());
  ASSERT_TRUE(rig && pipeline::lay_windows(*rig, {}, windows));
  std::string points;  // a round surface of a face's size
  const double centre_x = windows.width_px / 2.0, centre_y = windows.height_px / 2.0;
  for (double y = -85; y <= 85; y += 3)
    for (double x = -65; x <= 65; x += 3) {
      const double z_mm = 545 + 40 * (x * x / (65 * 65) + y * y / (85 * 85));
      points += std::to_string(centre_x + x * windows.focal_px / z_mm) + " " +
                std::to_string(centre_y + y * windows.focal_px / z_mm) + " " +
                std::to_string(windows.disparity_px(z_mm)) + " 0.1\n";
    }
  write_text(here / "points.csv", "x y disparity sigma\n" + points);
  std::vector<std::string> face{"reconstruct", "face/left.png", "face/right.png", "--calibration",
                                "face/rig.yml"};
  for (const char* setting : {"matcher=file-matches", "constraints=none", "mesher=delaunay", "relief=off",
                              "file-matches.path=points.csv"})
    face.insert(face.end(), {"--set", setting});
  face.emplace_back("-o");
  auto saving = face;
  saving.insert(saving.end(), {"first", "--save", "face.relievo"});
  done(saving);
  fs::remove(here / "points.csv");
  done({"reconstruct", "--load", "face.relievo", "--from", "match", "-o", "again"});
  expect_same_model("first", "again");
  // The same name with other points in it is another choice, of the first stage.
  write_text(here / "points.csv", points.substr(0, points.find('\n', 2 * points.size() / 3) + 1));
  const std::vector<std::string> other{
      "reconstruct", "--load", "face.relievo", "--set", "file-matches.path=points.csv", "-o", "other"};
  EXPECT_NE(done(other).out.find("Match"), std::string::npos);
  EXPECT_LT(fs::file_size(here / "other/model.ply"), fs::file_size(here / "first/model.ply"));
  fs::remove(here / "points.csv");
  auto none = face;
  none.emplace_back("none");
  refused(none, "points.csv", "");
}

TEST_F(SavedReconstruction, MatchesByHandFromAFileAreCalculatedWithAndKept) {
  simulated({"face", "--seed", "3", "--scale", "0.4"}, "face");
  const auto rig = pipeline::read_calibration(here / "face/rig.yml");
  pipeline::RectifiedPair windows(std::pmr::get_default_resource());
  ASSERT_TRUE(rig && pipeline::lay_windows(*rig, {}, windows));
  // 15 mm before the middle between the cameras' near and far.
  const std::string line = std::to_string(windows.width_px / 2) + " " +
                           std::to_string(windows.height_px / 2) + " " +
                           std::to_string(windows.disparity_px(545)) + "\n";
  write_text(here / "hand.txt", "# one\n" + line);
  write_text(here / "none.txt", "# none\n");
  std::vector<std::string> face{"reconstruct",   "face/left.png", "face/right.png",
                                "--calibration", "face/rig.yml",  "-o"};
  const auto reconstruct = [&](const std::string& folder, std::vector<std::string> more) {
    more.insert(more.begin(), face.begin(), face.end());
    more.insert(more.begin() + static_cast<std::ptrdiff_t>(face.size()), folder);
    return more;
  };
  done(reconstruct("without", {}));
  const std::string said =
      done(reconstruct("first", {"--by-hand", "hand.txt", "--save", "face.relievo"})).out;
  EXPECT_NE(said.find("1 of the matches made by hand"), std::string::npos) << said;
  EXPECT_NE(read_text(here / "first/report.json").find("\"matches_by_hand\": 1"), std::string::npos);
  EXPECT_NE(read_text(here / "first/model.ply"), read_text(here / "without/model.ply"));

  fs::remove(here / "hand.txt");  // it is in the document
  done({"reconstruct", "--load", "face.relievo", "-o", "loaded"});
  expect_same_model("first", "loaded");
  done({"reconstruct", "--load", "face.relievo", "--from", "match", "-o", "again"});
  expect_same_model("first", "again");
  done({"reconstruct", "--load", "face.relievo", "--by-hand", "none.txt", "-o", "taken"});
  expect_same_model("without", "taken");

  for (const char* bad :
       {"400 200\n", "400 200 x\n", "400 200 1 0\n", "-1 200 1\n", "400 1e9 1\n", "400 200 9000\n"}) {
    write_text(here / "bad.txt", line + bad + line);
    refused(reconstruct("none", {"--by-hand", "bad.txt"}), "bad.txt, line 2");
  }
  refused(reconstruct("none", {"--by-hand", "missing.txt"}), "missing.txt", "check its name");
  refused({"reconstruct", "--load", "face.relievo", "--by-hand", "none.txt", "--from", "mesh", "-o", "none"},
          "--from mesh", "before this one");
}

}  // namespace
}  // namespace relievo::test
