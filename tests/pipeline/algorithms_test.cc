// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/algorithms.h"

#include <gtest/gtest.h>

namespace relievo::pipeline {
namespace {

TEST(Algorithms, EveryDescribedChoiceCanBeMade) {
  for (const OptionDescription& option : describe_algorithms()) {
    EXPECT_FALSE(option.sentence.empty()) << option.key;
    for (const std::string& name : option.names) {
      AlgorithmSet set;
      ASSERT_TRUE(set.set(option.key, name)) << option.key << " " << name;
      EXPECT_TRUE(make_preprocessor(set));
      EXPECT_TRUE(make_selector(set));
      EXPECT_TRUE(make_matcher(set));
      EXPECT_TRUE(make_constraints(set));
      EXPECT_TRUE(make_triangulator(set));
      EXPECT_TRUE(make_mesher(set));
      EXPECT_TRUE(make_relief_check(set));
      EXPECT_TRUE(make_texturer(set));
    }
  }
}

TEST(Algorithms, WhatIsMadeIsWhatWasNamed) {
  AlgorithmSet set;
  ASSERT_TRUE(set.set("triangulator", "linear-least-squares"));
  ASSERT_TRUE(set.set("texturer", "single-view"));
  EXPECT_EQ((*make_triangulator(set))->name(), "linear-least-squares");
  EXPECT_EQ((*make_texturer(set))->name(), "single-view");
  EXPECT_EQ((*make_matcher(set))->name(), "refined");
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
    for (const double value : {option.least, option.most}) {
      AlgorithmSet set;
      ASSERT_TRUE(set.set(option.key, std::to_string(value))) << option.key;
      EXPECT_TRUE(make_preprocessor(set)) << option.key << " = " << value;
      EXPECT_TRUE(make_selector(set)) << option.key << " = " << value;
      EXPECT_TRUE(make_matcher(set)) << option.key << " = " << value;
      EXPECT_TRUE(make_mesher(set)) << option.key << " = " << value;
      EXPECT_TRUE(make_texturer(set)) << option.key << " = " << value;
      EXPECT_TRUE(make_constraints(set)) << option.key << " = " << value;
    }
  }
}

TEST(Algorithms, ConstraintsAreJoinedAndKeepTheirOrder) {
  AlgorithmSet set;
  ASSERT_TRUE(set.set("constraints", "uniqueness+similarity"));
  const auto constraints = make_constraints(set);
  ASSERT_TRUE(constraints);
  ASSERT_EQ(constraints->size(), 2U);
  EXPECT_EQ((*constraints)[0]->name(), "uniqueness");
  ASSERT_TRUE(set.set("constraints", "none"));
  EXPECT_TRUE(make_constraints(set)->empty());
}

TEST(Algorithms, WrongWordsAreRefusedAndSayWhatWouldDo) {
  AlgorithmSet set;
  const auto unknown_key = set.set("macher", "refined");
  ASSERT_FALSE(unknown_key);
  EXPECT_EQ(unknown_key.error().code, Errc::NotFound);
  EXPECT_NE(unknown_key.error().where().find("macher"), std::string_view::npos);
  const auto unknown_name = set.set("matcher", "magic");
  ASSERT_FALSE(unknown_name);
  EXPECT_NE(unknown_name.error().where().find("refined"), std::string_view::npos);
  for (const char* value : {"", "x", "1x", "nan", "-1", "1e9"}) {
    const auto refused = set.set("refined.bending", value);
    ASSERT_FALSE(refused) << value;
    EXPECT_EQ(refused.error().code, Errc::InvalidInput);
  }
  EXPECT_EQ(set.to_text(), AlgorithmSet{}.to_text()) << "a refused setting must change nothing";
}

}  // namespace
}  // namespace relievo::pipeline
