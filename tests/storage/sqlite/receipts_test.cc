// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The numbers that lead a person to their record: nobody has another's, and none is told by the others.
#include "storage/record.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

#include "tests/storage/sample.h"
#include "tests/support/temporary_folder.h"

namespace relievo::storage {
namespace {

using test::opened;

TEST(Receipts, AreSpreadOverTheWholeRange) {
  constexpr int kDraws = 20'000, kParts = 20;
  std::set<std::int64_t> all;
  std::array<int, kParts> in_part{};
  int rises = 0;
  std::int64_t before = 0;
  for (int i = 0; i < kDraws; ++i) {
    const std::int64_t drawn = draw_receipt();
    ASSERT_GE(drawn, kLeastReceipt);
    ASSERT_LE(drawn, kMostReceipt);
    all.insert(drawn);
    ++in_part[static_cast<std::size_t>((drawn - kLeastReceipt) * kParts /
                                       (kMostReceipt - kLeastReceipt + 1))];
    rises += drawn > before ? 1 : 0;
    before = drawn;
  }
  EXPECT_GE(all.size(), kDraws - 1U) << "two of 20 000 meet once in 5000 runs";
  // Five standard deviations: a fair generator leaves them once in 100 000 runs.
  const double expected = static_cast<double>(kDraws) / kParts;
  for (const int count : in_part) EXPECT_NEAR(count, expected, 5 * std::sqrt(expected));
  EXPECT_NEAR(rises, kDraws / 2.0, 5 * std::sqrt(kDraws / 12.0)) << "the next is as often less as more";
}

std::int64_t next_drawn = 0;

TEST(Receipts, OneThatIsTakenIsNotGivenAgain) {
  const relievo::test::TemporaryFolder folder;
  // Every number comes three times.
  next_drawn = 0;
  const auto store = opened(folder.path(), {.draw_receipt = [] { return 1000 + next_drawn++ / 3; }});
  std::set<std::int64_t> given;
  for (int i = 0; i < 5; ++i) {
    const auto id = store->add_subject({"Ada"});
    ASSERT_TRUE(id.has_value());
    EXPECT_TRUE(given.insert(store->subject(*id)->receipt).second);
  }
  EXPECT_EQ(given.size(), 5U);
  for (const std::int64_t receipt : given) {
    const auto found = store->subjects({.receipt = receipt});
    ASSERT_TRUE(found.has_value());
    ASSERT_EQ(found->size(), 1U);
    EXPECT_EQ(found->front().receipt, receipt);
  }
}

TEST(Receipts, AGeneratorThatRepeatsItselfStoresNobody) {
  const relievo::test::TemporaryFolder folder;
  const auto store = opened(folder.path(), {.draw_receipt = [] { return std::int64_t{7}; }});
  ASSERT_TRUE(store->add_subject({"Ada"}).has_value());
  const auto model = test::sample_model();
  EXPECT_EQ(store->add_enrolment(NewSubject{"Bob"}, test::sample_enrolment(model)).error().code,
            Errc::LibraryFailed);
  EXPECT_EQ(store->subjects({})->size(), 1U) << "nothing half stored";
  EXPECT_TRUE(store->check().has_value());
}

}  // namespace
}  // namespace relievo::storage
