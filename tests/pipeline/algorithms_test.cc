// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/algorithms.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <clocale>
#include <cmath>
#include <functional>
#include <typeinfo>

#include "pipeline/match/constraints/constraints.h"
#include "pipeline/match/refine/refined_matcher.h"
#include "pipeline/match/window/window_matchers.h"
#include "pipeline/reconstruct/triangulators.h"
#include "pipeline/texture/texturers.h"

namespace relievo::pipeline {
namespace {

TEST(Algorithms, EveryDescribedChoiceCanBeMade) {
  for (const OptionDescription& option : describe_algorithms()) {
    EXPECT_FALSE(option.sentence.empty()) << option.key;
    for (const std::string& name : option.names) {
      AlgorithmSet set;
      ASSERT_TRUE(set.set(option.key, name)) << option.key << " " << name;
      EXPECT_TRUE(make_algorithms(set));
    }
  }
}

TEST(Algorithms, EachSaysWhatItIsAndWhereItComesFrom) {
  for (const OptionDescription& kind : describe_algorithms()) {
    if (kind.is_option()) continue;
    ASSERT_EQ(kind.algorithms.size(), kind.names.size()) << kind.key;
    for (std::size_t k = 0; k < kind.names.size(); ++k) {
      EXPECT_EQ(kind.algorithms[k].name, kind.names[k]);
      EXPECT_GT(std::string_view(kind.algorithms[k].sentence).size(), 10U) << kind.names[k];
      EXPECT_GE(std::string_view(kind.algorithms[k].source).size(), 3U) << kind.names[k];
    }
  }
}

// An option is named after its algorithm, and so is found where the algorithm is.
TEST(Algorithms, OptionsBearTheNameOfTheirAlgorithm) {
  const auto all = describe_algorithms();
  for (const OptionDescription& option : all) {
    if (!option.is_option()) continue;
    const std::string section = option.key.substr(0, option.key.find('.'));
    const bool named = std::any_of(all.begin(), all.end(), [&](const OptionDescription& kind) {
      return std::find(kind.names.begin(), kind.names.end(), section) != kind.names.end();
    });
    EXPECT_TRUE(named || section == "face" || section == "relief") << option.key;
  }
}

template <typename Concrete, typename Returned, typename... Taken>
bool is(const std::function<Returned(Taken...)>& made, Returned (Concrete::*run)(Taken...) const) {
  return made.target_type() == typeid(std::bind_front(run, Concrete{}));
}

TEST(Algorithms, WhatIsMadeIsWhatWasNamed) {
  AlgorithmSet set;
  ASSERT_TRUE(set.set("triangulator", "linear-least-squares"));
  ASSERT_TRUE(set.set("texturer", "single-view"));
  const auto made = make_algorithms(set);
  ASSERT_TRUE(made);
  EXPECT_TRUE(is(made->triangulator, &LinearTriangulator::triangulate));
  EXPECT_TRUE(is(made->texturer, &SingleViewTexturer::texture));
  EXPECT_TRUE(is(made->matcher, &RefinedMatcher::match));
}

TEST(Algorithms, DefaultsLieInTheirOwnRange) {
  for (const OptionDescription& option : describe_algorithms()) {
    AlgorithmSet set;
    EXPECT_TRUE(set.set(option.key, option.value)) << option.key << " = " << option.value;
  }
}

TEST(Algorithms, RangesAreWhatTheAlgorithmsThemselvesAccept) {
  for (const OptionDescription& option : describe_algorithms()) {
    if (!option.names.empty() || option.text) continue;
    for (const double value : {option.range.least, option.range.most}) {
      AlgorithmSet set;
      ASSERT_TRUE(set.set(option.key, std::to_string(value))) << option.key;
      EXPECT_TRUE(make_algorithms(set)) << option.key << " = " << value;
    }
  }
}

TEST(Algorithms, WhatIsOutOfRangeIsNamedWithItsValueAndItsRange) {
  EXPECT_TRUE(check_options(SsdMatcher{}, "ssd"));
  const auto even = check_options(SsdMatcher{.window_px = 10}, "ssd");
  ASSERT_FALSE(even);
  EXPECT_EQ(even.error().code, Errc::InvalidInput);
  EXPECT_EQ(even.error().where(), "ssd.window_px = 10 (3 to 63 in steps of 2)");
  EXPECT_FALSE(check_options(SsdMatcher{.max_difference = NAN}, "ssd"));
  const auto set = AlgorithmSet{}.set("ssd.window_px", "10");
  ASSERT_FALSE(set);
  EXPECT_EQ(set.error().where(), even.error().where()) << "one range, wherever it is asked";
}

TEST(Algorithms, WholeNumbersTakeNoFractions) {
  const auto refused = AlgorithmSet{}.set("sgm.band", "4.5");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::InvalidInput);
  EXPECT_TRUE(refused.error().where().starts_with("sgm.band = 4.5 (")) << refused.error().where();
  EXPECT_NE(refused.error().where().find("in steps of 1)"), std::string_view::npos);
  for (const char* whole : {"sgm.band", "refined.follow_motion", "ssd.window_px", "rbf.max_centres"}) {
    const auto options = describe_algorithms();
    const auto described = std::ranges::find(options, std::string_view(whole), &OptionDescription::key);
    ASSERT_TRUE(described != options.end()) << whole;
    EXPECT_FALSE(AlgorithmSet{}.set(whole, number_text(described->range.least + 0.5))) << whole;
  }
}

TEST(Algorithms, ModesAreChosenByName) {
  AlgorithmSet set;
  EXPECT_EQ(set.get("opencv-sgbm.mode"), "3way");
  ASSERT_TRUE(set.set("opencv-sgbm.mode", "hh"));
  ASSERT_TRUE(set.set("matcher", "opencv-sgbm"));
  EXPECT_TRUE(make_algorithms(set));
  for (const char* number : {"1", "2", "", "HH"}) {
    const auto refused = set.set("opencv-sgbm.mode", number);
    ASSERT_FALSE(refused) << number;
    EXPECT_NE(refused.error().where().find("3way or hh"), std::string_view::npos) << number;
  }
  EXPECT_EQ(set.get("opencv-sgbm.mode"), "hh");
}

TEST(Algorithms, ConstraintsAreJoinedAndKeepTheirOrder) {
  AlgorithmSet set;
  ASSERT_TRUE(set.set("constraints", "uniqueness+similarity"));
  const auto made = make_algorithms(set);
  ASSERT_TRUE(made);
  ASSERT_EQ(made->constraints.size(), 2U);
  EXPECT_TRUE(is(made->constraints[0], &UniquenessConstraint::judge));
  ASSERT_TRUE(set.set("constraints", "none"));
  EXPECT_TRUE(make_algorithms(set)->constraints.empty());
}

TEST(Algorithms, AConstraintIsNamedOnce) {
  AlgorithmSet set;
  const auto refused = set.set("constraints", "similarity+uniqueness+similarity");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::InvalidInput);
  EXPECT_EQ(refused.error().where(), "constraints = similarity+uniqueness+similarity");
  for (const char* both : {"none+similarity", "similarity+none"}) {
    const auto contradicts = set.set("constraints", both);
    ASSERT_FALSE(contradicts) << both;
    EXPECT_EQ(contradicts.error().code, Errc::InvalidInput);
  }
}

TEST(Algorithms, MatchesOfAFileAreNoLattice) {
  AlgorithmSet set;
  EXPECT_TRUE(check_neighbours(set));
  ASSERT_TRUE(set.set("matcher", "file-matches"));
  const auto refused = check_neighbours(set);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::InvalidInput);
  EXPECT_EQ(refused.error().where(), "selector=dense matcher=file-matches mesher=grid");
  ASSERT_TRUE(set.set("mesher", "delaunay"));
  EXPECT_TRUE(check_neighbours(set));
}

// One is in median edges, the other in distances of points spread evenly.
TEST(Algorithms, WhatIsMeasuredOtherwiseIsSaidOtherwise) {
  const auto all = describe_algorithms();
  const auto sentence = [&](std::string_view key) {
    return std::ranges::find(all, key, &OptionDescription::key)->sentence;
  };
  EXPECT_NE(sentence("delaunay.max_edge_ratio"), sentence("advancing-front.max_edge_ratio"));
}

TEST(Algorithms, WrongWordsAreRefusedAndSayWhatWouldDo) {
  AlgorithmSet set;
  const auto unknown_key = set.set("macher", "refined");
  ASSERT_FALSE(unknown_key);
  EXPECT_EQ(unknown_key.error().code, Errc::NotFound);
  EXPECT_NE(unknown_key.error().where().find("macher"), std::string_view::npos);
  EXPECT_NE(unknown_key.error().where().find("matcher"), std::string_view::npos) << "what there is";
  const auto unknown_option = set.set("zmncc.windw", "3");
  ASSERT_FALSE(unknown_option);
  EXPECT_NE(unknown_option.error().where().find("window_px"), std::string_view::npos);
  for (const OptionDescription& option : describe_algorithms()) {
    if (!option.is_option()) continue;
    const std::string misspelt = option.key.substr(0, option.key.find('.')) + ".misspelt";
    const auto refused = set.set(misspelt, "1");
    ASSERT_FALSE(refused);
    const std::string_view where = refused.error().where();
    EXPECT_TRUE(where.starts_with(misspelt)) << "cut: " << where;
    EXPECT_TRUE(where == misspelt ||
                where.find(option.key.substr(option.key.find('.') + 1)) != std::string_view::npos)
        << option.key;
    EXPECT_NE(refused.error().what.view().find("relievo algorithms"), std::string_view::npos);
  }
  const auto unknown_name = set.set("matcher", "magic");
  ASSERT_FALSE(unknown_name);
  EXPECT_NE(unknown_name.error().where().find("refined"), std::string_view::npos);
  for (const char* value : {"", "x", "1x", "nan", "-1", "1e9", "0x1", "0,5"}) {
    const auto refused = set.set("refined.bending", value);
    ASSERT_FALSE(refused) << value;
    EXPECT_EQ(refused.error().code, Errc::InvalidInput);
  }
  EXPECT_EQ(set.to_text(), AlgorithmSet{}.to_text()) << "a refused setting must change nothing";
}

TEST(AlgorithmSet, NumbersAreTheSameInEveryCountry) {
  const char* const before = std::setlocale(LC_ALL, "de_DE.UTF-8");
  AlgorithmSet set;
  EXPECT_TRUE(set.set("refined.bending", "0.5"));
  EXPECT_FALSE(set.set("refined.bending", "0,5"));
  EXPECT_TRUE(make_algorithms(set));
  if (before != nullptr) std::setlocale(LC_ALL, "C");
}

TEST(AlgorithmSet, ReadsWhatOlderStoresCallThings) {
  const auto set =
      AlgorithmSet::from_text("selector = grid\ngrid-points.max_points = 20000\ngrid-points.step_px = 6\n");
  ASSERT_TRUE(set);
  EXPECT_EQ(set->get("selector"), "grid-points");
  EXPECT_EQ(set->get("grid-points.step_px"), "6");
  EXPECT_EQ(AlgorithmSet::from_text("selector = file\n")->get("selector"), "file-points");
}

TEST(AlgorithmSet, EveryValueItTakesComesBackFromItsText) {
  AlgorithmSet set;
  for (const char* value : {"a\nb", "a\r", "a\tb", " a", "a "}) {
    const auto refused = set.set("file-points.path", value);
    ASSERT_FALSE(refused) << value;
    EXPECT_EQ(refused.error().code, Errc::InvalidInput);
  }
  ASSERT_TRUE(set.set("file-points.path", "/media/points of a = \xc3\xa4.csv"));
  const auto read = AlgorithmSet::from_text(set.to_text());
  ASSERT_TRUE(read);
  EXPECT_EQ(read->get("file-points.path"), set.get("file-points.path"));
}

}  // namespace
}  // namespace relievo::pipeline
