// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// `relievo compare --suite dissertation`: every table and figure of the dissertation is there, on the page
// and in the figures, with the same numbers on both.
#include <nlohmann/json.hpp>

#include <csignal>
#include <cstdio>

#include "tests/support/html_reader.h"
#include "tests/system/relievo_process.h"

namespace relievo::test {
namespace {

using Json = nlohmann::json;

class DissertationReport : public RelievoProcess {
 protected:
  void SetUp() override {
    simulated({"face", "--scale", "0.4", "--truth"}, "face");
    done({"compare", "face/left.png", "face/right.png", "--calibration", "face/rig.yml", "--truth", "face",
          "--suite", "dissertation", "-o", "out"});
    json = Json::parse(read_text(here / "out/compare.json"));
    html = read_text(here / "out/index.html");
  }
  // What stands in a section of the page, its tags and pictures with it.
  std::string section(const std::string& id) const {
    const std::size_t from = html.find("<section id=\"" + id + "\">");
    EXPECT_NE(from, std::string::npos) << id << " is missing on the page";
    return from == std::string::npos ? "" : html.substr(from, html.find("</section>", from) - from);
  }
  static std::string text(double value, int decimals) {
    char words[40];
    std::snprintf(words, sizeof words, "%.*f", decimals, value);
    return words;
  }
  static std::string percent(const Json& part, const Json& whole) {
    return text(100 * part.get<double>() / whole.get<double>(), 1) + " %";
  }
  void says(const std::string& id, const std::string& words) const {
    EXPECT_NE(section(id).find(words), std::string::npos) << id << " does not say " << words;
  }
  // A rule's run, its constraint the last of them.
  void agrees(int number, const std::string& rule) const {
    const std::string id = std::to_string(number);
    const Json& run = json.at("figure_" + id).at("runs").at(0);
    const Json& last = run.at("matches").at("constraints").back();
    EXPECT_EQ(last["name"], rule);
    EXPECT_GT(last["judged"], 0) << "the truth is known";
    says("figure-" + id, "<td class=\"value\">" + last["rejected"].dump() + "</td><td class=\"value\">" +
                             percent(last["truly_bad"], last["judged"]) + "</td>");
    says("figure-" + id, percent(run["matches"]["accepted_bad"], run["matches"]["accepted_judged"]));
  }

  Json json;
  std::string html;
};

TEST_F(DissertationReport, HasEveryTableAndFigureWithTheFiguresOfTheJson) {
  const tests::HtmlReader page(html);
  EXPECT_EQ(page.error(), "");
  for (const char* outside : {"http", "url(", "@import", "<script"})
    EXPECT_EQ(html.find(outside), std::string::npos) << outside;
  for (const char* never : {"nan", "inf "}) EXPECT_EQ(page.text().find(never), std::string::npos) << never;

  const Json& rig = json.at("table_1").at("relievo");
  // The dissertation was off by 0.716 units.
  EXPECT_NEAR(rig["baseline_units"].get<double>(), 20, 0.03);
  for (const Json& focal : rig["focal_px"])
    EXPECT_NEAR(focal.get<double>(), rig["true_focal_px"].get<double>(), 1.5);
  EXPECT_NEAR(rig["true_focal_px"].get<double>(), 771, 1e-6);
  for (const std::string& words :
       {text(rig["baseline_units"], 3), text(rig["focal_px"][0], 1), text(rig["focal_px"][1], 1),
        std::string("19.284"), std::string("771.6"), std::string("770.6"), std::string("not recorded")})
    says("table-1", words);

  const Json& cube = json.at("table_2").at("relievo");
  ASSERT_EQ(cube["corners"].size(), 8U);
  EXPECT_LT(cube["worst_units"], 1) << "as the dissertation's";
  EXPECT_GT(cube["rms_units"], 0.05) << "no hand is that steady";
  EXPECT_LT(cube["rms_units"], 0.4);
  EXPECT_NEAR(cube["side_units"].get<double>(), 25, 0.3);
  double worst = 0;
  for (const Json& corner : cube["corners"]) {
    worst = std::max(worst, corner["off_units"].get<double>());
    says("table-2", text(corner["off_units"], 2) + "</td></tr>");
  }
  EXPECT_EQ(worst, cube["worst_units"]);
  for (const char* key : {"worst_units", "rms_units", "side_units"}) says("table-2", text(cube[key], 2));

  const Json& six = json.at("figure_6").at("runs");
  ASSERT_EQ(six.size(), 3U);
  for (const Json& run : six)
    says("figure-6",
         run["set"].get<std::string>() + " " + text(100 * run["disparity"]["bad"].get<double>(), 1));
  EXPECT_LT(six[2]["disparity"]["bad"], six[1]["disparity"]["bad"]) << "ours beside its ZMNCC";
  const char* const rules[] = {"similarity", "uniqueness", "continuity",
                               "ordering",   "left-right", "statistical"};
  for (int i = 0; i < 6; ++i) agrees(7 + i, rules[i]);

  const Json& face = json.at("figure_17").at("runs");
  ASSERT_EQ(face.size(), 4U);
  for (const Json& run : face) {
    EXPECT_TRUE(run["failure"].is_null()) << run["failure"];
    says("figure-17", text(run["model"]["interior_median_mm"], 3) + " mm, " +
                          text(100 * run["model"]["complete_0.5mm"].get<double>(), 1) + " %");
  }
  EXPECT_EQ(listing(here / "out"), "compare.json\nindex.html\n") << "what was simulated is gone";
}

class DissertationWords : public RelievoProcess {};

TEST_F(DissertationWords, AreRefusedWhereTheyDoNotFit) {
  const auto wrong = [this](std::vector<std::string> more) {
    more.insert(more.begin(), {"compare", "--suite", "dissertation", "-o", "out"});
    EXPECT_EQ(relievo(more).exit_code, 2) << more.back();
  };
  wrong({"--suite", "peers"});
  wrong({"--set-of", "one:"});
  wrong({"--keep-maps"});
  wrong({"--rectified"});
  wrong({"--truth", "face"});
  wrong({"--rectified", "a.png", "b.png", "c.png", "d.png"});
  refused({"compare", "a.png", "b.png", "--rectified", "--suite", "dissertation", "-o", "out"}, "a.png");
  refused({"compare", "--suite", "dissertation", "--set", "matcher=none-such", "-o", "out"}, "none-such");
}

TEST_F(DissertationWords, AnInterruptLeavesNothing) {
  const Said said =
      run_program_and_signal({RELIEVO_BINARY, "compare", "--suite", "dissertation", "-o", "out"}, here.path(),
                             SIGINT, "a minute or two");
  EXPECT_EQ(said.exit_code, 1) << said.out << said.err;
  EXPECT_NE(said.err.find("cancelled"), std::string::npos) << said.err;
  EXPECT_EQ(listing(here.path()), "");
}

}  // namespace
}  // namespace relievo::test
