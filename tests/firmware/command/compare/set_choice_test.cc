// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <gtest/gtest.h>

#include <sstream>

#include "firmware/compare/set_run.h"
#include "tests/support/temporary_folder.h"

namespace relievo::firmware::compare {
namespace {

std::string where_of(const CompareArgs& args) {
  const auto sets = choose_sets(args);
  EXPECT_FALSE(sets);
  return sets ? "" : std::string(sets.error().where());
}

TEST(SetChoice, NothingNamedIsTheDefaultCalledByItsMatcher) {
  const auto sets = choose_sets({});
  ASSERT_TRUE(sets);
  ASSERT_EQ(sets->size(), 1U);
  EXPECT_EQ(sets->front().name, sets->front().set.get("matcher"));
}

TEST(SetChoice, AllSetsStartFromTheSettingsForAll) {
  CompareArgs args;
  args.algorithms.settings = {"dense.step_px=3"};
  args.set_words = {"soft: refined.bending=0.1", "hard:  refined.bending=2  constraints=none "};
  const auto sets = choose_sets(args);
  ASSERT_TRUE(sets);
  ASSERT_EQ(sets->size(), 2U);
  EXPECT_EQ((*sets)[0].set.get("refined.bending"), "0.1");
  EXPECT_EQ((*sets)[1].name, "hard");
  EXPECT_EQ((*sets)[1].set.get("constraints"), "none");
  for (const NamedSet& set : *sets) EXPECT_EQ(set.set.get("dense.step_px"), "3");
}

TEST(SetChoice, ScatteredPlacesGetAMesherThatJoinsThem) {
  CompareArgs args;
  args.suites = {"selectors"};
  const auto sets = choose_sets(args);
  ASSERT_TRUE(sets);
  std::size_t scattered = 0;
  for (const NamedSet& set : *sets) {
    EXPECT_TRUE(pipeline::check_neighbours(set.set)) << set.name;
    scattered += set.set.get("mesher") == "delaunay" ? 1 : 0;
  }
  EXPECT_GT(scattered, 0U);
  EXPECT_LT(scattered, sets->size()) << "a lattice keeps its own";
}

// A limit that the matcher has already held to would make a rule of figure 7 that says nothing.
TEST(SetChoice, TheDissertationsSimilarityAsksForMoreThanItsMatcher) {
  for (const auto& words : {dissertation_rule_sets(), dissertation_face_sets()}) {
    const auto sets = make_sets({}, words);
    ASSERT_TRUE(sets) << sets.error().where();
    int judged = 0;
    for (const NamedSet& set : *sets) {
      if (set.set.get("matcher") != "zmncc" ||
          set.set.get("constraints").find("similarity") == std::string::npos)
        continue;
      ++judged;
      EXPECT_LT(std::stod(set.set.get("similarity.max_cost")), 1 - std::stod(set.set.get("zmncc.min_score")))
          << set.name;
    }
    EXPECT_GE(judged, 3);
  }
}

// Scattered places make hardly a face of one, and the page is to say how good they are.
TEST(SetChoice, NobodyIsRefusedAsAPictureUnlessAskedFor) {
  AlgorithmArgs base;
  const auto sets = make_sets(base, dissertation_face_sets());
  ASSERT_TRUE(sets);
  for (const NamedSet& set : *sets) EXPECT_EQ(set.set.get("relief"), "off") << set.name;
  base.settings = {"relief=check"};
  const auto asked = make_sets(base, dissertation_face_sets());
  ASSERT_TRUE(asked);
  for (const NamedSet& set : *asked) EXPECT_EQ(set.set.get("relief"), "check") << set.name;
}

TEST(SetChoice, AFilesSetsKeepItsOrder) {
  const test::TemporaryFolder here;
  test::write_text(
      here / "sets.toml",
      "[zebra]\nmatcher = \"refined\"\nrefined.bending = 0.5\n\n[\"ant 1\"]\n[\"ant 1\".dense]\nstep_px = 4\n");
  CompareArgs args;
  args.set_files = {here / "sets.toml"};
  const auto sets = choose_sets(args);
  ASSERT_TRUE(sets);
  ASSERT_EQ(sets->size(), 2U);
  EXPECT_EQ((*sets)[0].name, "zebra");
  EXPECT_EQ((*sets)[0].set.get("refined.bending"), "0.5");
  EXPECT_EQ((*sets)[1].name, "ant 1");
  EXPECT_EQ((*sets)[1].set.get("dense.step_px"), "4");
}

TEST(SetChoice, ImpossibleSetsAreNamed) {
  CompareArgs args;
  args.set_words = {"odd: matcher=telepathy"};
  EXPECT_NE(where_of(args).find("set 'odd': matcher = telepathy"), std::string::npos);
  args.set_words = {"odd: refined.bending=1e9"};
  EXPECT_NE(where_of(args).find("odd"), std::string::npos);
  args.set_words = {"no colon"};
  EXPECT_EQ(where_of(args), "no colon");
  args.set_words = {"one:", "one: constraints=none"};
  EXPECT_EQ(where_of(args), "one");
  args.set_words = {};
  args.suites = {"everything"};
  EXPECT_NE(where_of(args).find("dissertation"), std::string::npos) << "the error lists what there is";
  args.suites = {};
  for (std::size_t i = 0; i <= kMostSets; ++i) args.set_words.push_back("s" + std::to_string(i) + ":");
  EXPECT_EQ(where_of(args), std::to_string(kMostSets + 1));
}

TEST(SetChoice, EverySuiteCanBeMade) {
  CompareArgs unknown;
  unknown.suites = {"everything"};
  std::string told = where_of(unknown);  // "everything (dissertation, peers, ...)"
  ASSERT_TRUE(told.ends_with(')'));
  told.pop_back();
  std::istringstream names(told.substr(told.find(',') + 1));
  for (std::string suite; std::getline(names >> std::ws, suite, ',');) {
    CompareArgs args;
    args.suites = {suite};
    const auto sets = choose_sets(args);
    ASSERT_TRUE(sets) << suite << ": " << sets.error().where();
    EXPECT_FALSE(sets->empty()) << suite;
  }
}

}  // namespace
}  // namespace relievo::firmware::compare
