// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// `relievo compare` as a person and a script meet it: a rectified pair whose every disparity is known, a page
// that needs nothing else, figures that agree with errors put in on purpose, and refusals.
#include <nlohmann/json.hpp>

#include <csignal>
#include <fstream>
#include <memory_resource>

#include "hal/picture_file.h"
#include "tests/support/bump_scene.h"
#include "tests/support/html_reader.h"
#include "tests/system/relievo_process.h"

namespace relievo::test {
namespace {

using Json = nlohmann::json;

class Compare : public RelievoProcess {
 protected:
  void SetUp() override {
    std::pmr::monotonic_buffer_resource memory;
    const pipeline::RectifiedPair pair = scene.render(&memory);
    write_view("left.png", pair.left);
    write_view("right.png", pair.right);
    write_truth("truth.pfm", 0);
  }
  void write_view(const std::string& name, const pipeline::RectifiedView& view) const {
    std::vector<std::byte> grey;
    for (const float g : view.grey)
      grey.push_back(static_cast<std::byte>(std::clamp(std::lround(g), 0L, 255L)));
    ASSERT_TRUE(hal::write_picture(
        here / name, {grey.data(), scene.width_px, scene.height_px, scene.width_px, PixelFormat::Grey8}));
  }
  // Off by `error_px`; unknown where the scene itself does not judge.
  void write_truth(const std::string& name, double error_px) const {
    std::ofstream file(here / name, std::ios::binary);
    file << "Pf\n" << scene.width_px << " " << scene.height_px << "\n-1\n";
    for (int y = scene.height_px - 1; y >= 0; --y)
      for (int x = 0; x < scene.width_px; ++x) {
        const auto d = static_cast<float>(scene.judged(x, y) ? scene.disparity(x, y) + error_px
                                                             : std::numeric_limits<double>::infinity());
        file.write(reinterpret_cast<const char*>(&d), 4);
      }
  }
  static std::vector<std::string> words(std::vector<std::string> more) {
    more.insert(more.begin(), {"compare", "left.png", "right.png", "--rectified", "--region", "all",
                               "--disparities", "5:45"});
    return more;
  }
  Json figures(const std::string& folder) const {
    return Json::parse(read_text(here / (folder + "/compare.json")));
  }

  BumpScene scene;
};

TEST_F(Compare, FiguresFollowTheTruthAndAnErrorPutIn) {
  done(words({"--truth", "truth.pfm", "-o", "right"}));
  const Json exact = figures("right")["runs"][0]["disparity"];
  EXPECT_LT(exact["bad"].get<double>(), 0.02);
  EXPECT_LT(exact["median_px"].get<double>(), 0.1);
  EXPECT_LT(std::abs(exact["bias_px"].get<double>()), 0.02);
  write_truth("off.pfm", 1.5);
  done(words({"--truth", "off.pfm", "-o", "wrong"}));
  const Json off = figures("wrong")["runs"][0]["disparity"];
  EXPECT_GT(off["bad"].get<double>(), 0.99);
  EXPECT_NEAR(off["median_px"].get<double>(), 1.5, 0.1);
  EXPECT_EQ(off["judged_px"], exact["judged_px"]);
  done(words({"--truth", "off.pfm", "--bad-px", "2", "-o", "lenient"}));
  EXPECT_LT(figures("lenient")["runs"][0]["disparity"]["bad"].get<double>(), 0.02);
}

TEST_F(Compare, AMatrixOfSetsAsPageAndFigures) {
  const std::string odd = "<b>no rule & no fear</b>";
  const Said said = done(words({"--truth", "truth.pfm", "--set-of", odd + ": constraints=none", "--set-of",
                                "picky: refined.sigma_limit_px=0.01", "--set-of", "plain:", "-o", "out"}));
  EXPECT_NE(said.out.find("picky: failed: match: "), std::string::npos) << said.out;
  const Json json = figures("out");
  for (const char* key : {"version", "made_at", "bad_beyond_px", "sets", "pairs", "runs", "shared_pixels"})
    EXPECT_TRUE(json.contains(key)) << key;
  ASSERT_EQ(json["runs"].size(), 3U);
  EXPECT_EQ(json["runs"][0]["set"], odd);
  EXPECT_TRUE(json["runs"][0]["failure"].is_null());
  EXPECT_TRUE(json["runs"][1]["failure"].is_string()) << "a set that fails is a row that says why";
  EXPECT_EQ(json["runs"][2]["matches"]["constraints"].size(), 3U);
  for (const auto& rule : json["runs"][2]["matches"]["constraints"])
    EXPECT_LE(rule["truly_bad"], rule["judged"]);
  EXPECT_EQ(json["sets"][0]["algorithms"]["constraints"], "none");
  ASSERT_EQ(json["shared_pixels"].size(), 1U) << "of the two that give something";
  const std::string html = read_text(here / "out/index.html");
  const tests::HtmlReader page(html);
  EXPECT_EQ(page.error(), "");
  for (const char* outside : {"http", "url(", "@import", "<script", "<b>no rule"})
    EXPECT_EQ(html.find(outside), std::string::npos) << outside;
  EXPECT_NE(page.text().find(odd), std::string::npos) << "a name is text";
  EXPECT_NE(page.text().find("match: "), std::string::npos) << "the page says why a set failed";
  for (const char* never : {"nan", "inf "}) EXPECT_EQ(page.text().find(never), std::string::npos) << never;
}

TEST_F(Compare, ThePageSaysFirstThatNoTruthIsKnownAndExplainsOnlyWhatItHas) {
  const auto text = [this](const std::string& folder) {
    const std::string html = read_text(here / (folder + "/index.html"));
    const tests::HtmlReader page(html);
    EXPECT_EQ(page.error(), "");
    return page.text();
  };
  const auto has = [](const std::string& page, const char* words) {
    return page.find(words) != std::string::npos;
  };
  const Said said = done(words({"-o", "untold"}));
  EXPECT_TRUE(said.out.find("no truth is known") < said.out.find("matched")) << said.out;
  const std::string untold = text("untold");
  EXPECT_LT(untold.find("No truth is known."), untold.find("Left-right")) << "before any figure is explained";
  for (const char* words : {"A pixel is bad", "seen by both", "Photo:", "Surfaces", "best figure"})
    EXPECT_FALSE(has(untold, words)) << words;
  done(words({"--truth", "truth.pfm", "-o", "told"}));
  const std::string told = text("told");
  EXPECT_FALSE(has(told, "No truth is known"));
  EXPECT_TRUE(has(told, "A pixel is bad"));
}

TEST_F(Compare, SetsWithTheSameMatchesAreDrawnOnce) {
  done(words({"--set-of", "one: mesher=grid", "--set-of", "two: mesher=delaunay", "--set-of",
              "other: constraints=none", "-o", "out"}));
  const std::string html = read_text(here / "out/index.html");
  std::size_t drawn = 0;
  for (std::size_t at = html.find(": disparities\""); at != std::string::npos;
       at = html.find(": disparities\"", at + 1))
    ++drawn;
  EXPECT_EQ(drawn, 2U);
  EXPECT_NE(html.find("one, two: disparities"), std::string::npos);
}

TEST_F(Compare, AKeptMapIsATruthToItself) {
  done(words({"--keep-maps", "--set-of", "the one: constraints=none", "-o", "first"}));
  ASSERT_EQ(listing(here / "first"),
            "1-1_" + here.path().filename().string() + "_the_one.pfm\ncompare.json\nindex.html\n");
  done(words({"--set-of", "again: constraints=none", "--truth",
              "first/1-1_" + here.path().filename().string() + "_the_one.pfm", "-o", "second"}));
  const Json same = figures("second")["runs"][0]["disparity"];
  EXPECT_EQ(same["bad"], 0);
  EXPECT_EQ(same["rms_px"], 0) << "the same twice, to the last bit";
}

TEST_F(Compare, ManyPairsEachWithItsTruth) {
  write_truth("off.pfm", 3);
  done({"compare", "left.png", "right.png", "left.png", "right.png", "--rectified", "--region", "all",
        "--disparities", "5:45", "--truth", "truth.pfm", "--truth", "off.pfm", "-o", "out"});
  const Json json = figures("out");
  ASSERT_EQ(json["pairs"].size(), 2U);
  EXPECT_NE(json["pairs"][0]["name"], json["pairs"][1]["name"]);
  EXPECT_LT(json["runs"][0]["disparity"]["bad"].get<double>(), 0.02);
  EXPECT_GT(json["runs"][1]["disparity"]["bad"].get<double>(), 0.98);
}

TEST_F(Compare, RefusesInOneLineAndLeavesNothing) {
  const auto refused_words = [this](const std::vector<std::string>& more, const std::string& place) {
    refused(words(more), place);
  };
  write_text(here / "file", "taken");
  write_text(here / "bad.toml", "matcher = \n");
  write_text(here / "short.pfm", "Pf 3 3 -1 x");
  const std::vector<std::byte> small(64 * 64);
  ASSERT_TRUE(hal::write_picture(here / "small.png", {small.data(), 64, 64, 64, PixelFormat::Grey8}));
  refused_words({"--set-of", "odd: matcher=none-such", "-o", "out"}, "set 'odd'");
  refused_words({"--suite", "none-such", "-o", "out"}, "none-such");
  refused_words({"--sets", "bad.toml", "-o", "out"}, "bad.toml:1");
  refused_words({"--sets", "missing.toml", "-o", "out"}, "missing.toml");
  refused_words({"--truth", "missing.pfm", "-o", "out"}, "missing.pfm");
  refused_words({"--truth", "short.pfm", "-o", "out"}, "short.pfm");
  refused_words({"--truth", "small.png", "-o", "out"}, "small.png");
  refused_words({"-o", "file"}, "file");
  refused_words({"-o", "/proc/out"}, "/proc/out");
  refused({"compare", "left.png", "missing.png", "--rectified", "-o", "out"}, "missing.png");
  refused({"compare", "left.png", "small.png", "--rectified", "-o", "out"}, "small.png");
  refused({"compare", "left.png", "right.png", "--calibration", "missing.yml", "-o", "out"}, "missing.yml");
}

TEST_F(Compare, WrongWordsAreWrongUsage) {
  const auto wrong = [this](const std::vector<std::string>& call) {
    EXPECT_EQ(relievo(call).exit_code, 2) << call[1];
  };
  wrong({"compare", "left.png", "--rectified", "-o", "out"});
  wrong({"compare", "left.png", "right.png", "-o", "out"});
  wrong({"compare", "left.png", "right.png", "--rectified", "--calibration", "rig.yml", "-o", "out"});
  wrong(words({"--disparities", "9", "-o", "out"}));
  wrong({"compare", "left.png", "right.png", "--rectified", "--truth", "a", "--truth", "b", "-o", "out"});
  EXPECT_FALSE(std::filesystem::exists(here / "out"));
}

TEST_F(Compare, AnInterruptEndsItAndLeavesNothing) {
  const std::string before = listing(here.path());
  std::vector<std::string> call = words({"-o", "out"});
  for (int i = 0; i < 60; ++i) call.insert(call.end(), {"--set-of", std::to_string(i) + ":"});
  call.insert(call.begin(), RELIEVO_BINARY);
  const Said said = run_program_and_signal(call, here.path(), SIGINT, "60 sets on 1 pair");
  EXPECT_EQ(said.exit_code, 1) << said.out << said.err;
  EXPECT_NE(said.err.find("cancelled"), std::string::npos) << said.err;
  EXPECT_EQ(listing(here.path()), before);
}

class CompareFace : public RelievoProcess {};

TEST_F(CompareFace, AModelThatCannotBeWrittenFailsAndLeavesNothing) {
  simulated({"face", "--scale", "0.25"}, "face");
  const std::string before = listing(here.path());
  // Room for the page, not for the model.
  const Said said = run_program(
      {"/usr/bin/env", "--ignore-signal=XFSZ", "/usr/bin/prlimit", "--fsize=1000000", RELIEVO_BINARY,
       "compare", "face/left.png", "face/right.png", "--calibration", "face/rig.yml", "-o", "out"},
      here.path());
  EXPECT_EQ(said.exit_code, 1) << said.out << said.err;
  EXPECT_NE(said.err.find("out: not written"), std::string::npos) << said.err;
  EXPECT_EQ(listing(here.path()), before);
}

}  // namespace
}  // namespace relievo::test
