// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/records/receipt.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "firmware/command/commands.h"
#include "storage/record.h"
#include "storage/sqlite/sqlite_store.h"
#include "tests/storage/sample.h"
#include "tests/support/temporary_folder.h"

namespace relievo::firmware {
namespace {

storage::Subject with(std::int64_t id, std::int64_t receipt) {
  return {storage::SubjectId{id}, "Ada", {}, 1, receipt};
}

// One wrong digit, two that were swapped.
void mistakes_are_noticed(const std::string& code) {
  ASSERT_TRUE(is_receipt(code)) << code;
  for (std::size_t i = 0; i < code.size(); ++i) {
    if (code[i] == '-') continue;
    for (char digit = '0'; digit <= '9'; ++digit) {
      std::string wrong = code;
      wrong[i] = digit;
      EXPECT_EQ(is_receipt(wrong), wrong == code) << wrong;
    }
    const std::size_t next = i + 1 < code.size() && code[i + 1] == '-' ? i + 2 : i + 1;
    if (next < code.size() && code[i] != code[next]) {
      std::string swapped = code;
      std::swap(swapped[i], swapped[next]);
      EXPECT_FALSE(is_receipt(swapped)) << swapped;
    }
  }
}

TEST(Receipt, OneWrongOrSwappedDigitIsNoticed) {
  mistakes_are_noticed(receipt_of(with(1, 482'190'375'512)));
  mistakes_are_noticed(receipt_of(with(1, 42)));
  mistakes_are_noticed(receipt_of(with(1, storage::kMostReceipt)));
}

TEST(Receipt, OtherWordsAreNone) {
  for (const char* text : {"", "-", "Ada", "#3", "000123-09", "000001", "000001-", "000001-9", "00001-95",
                           "000000-98", "-00001-95", "000001-95 ", "000001 95", "0000-0000-0000-98",
                           "4821-9037-5512", "4821-9037-5512-0x", "4821-9037-5512--7", "-482190375512-07"})
    EXPECT_FALSE(is_receipt(text)) << text;
}

class ReceiptInTheStoreTest : public testing::Test {
 protected:
  test::TemporaryFolder folder;
  storage::test::StillClock clock;
};

TEST_F(ReceiptInTheStoreTest, LeadsToItsPersonHoweverItIsGrouped) {
  auto store = storage::test::opened(folder.path());
  for (int i = 0; i < 3; ++i) {
    const storage::SubjectId id = *store->add_subject({"Ada"});
    const std::string code = receipt_of(*store->subject(id));
    EXPECT_EQ(code.size(), 17U) << code;
    std::string spaced = code, bare = code;
    std::replace(spaced.begin(), spaced.end(), '-', ' ');
    bare.erase(std::remove(bare.begin(), bare.end(), '-'), bare.end());
    for (const std::string& typed : {code, spaced, bare}) {
      const auto found = find_by_receipt(*store, typed);
      ASSERT_TRUE(found.has_value()) << typed;
      EXPECT_EQ(found->id, id);
    }
  }
  EXPECT_EQ(find_by_receipt(*store, receipt_of(with(1, 42))).error().code, Errc::NotFound);
}

TEST_F(ReceiptInTheStoreTest, AnErasedPersonsCodeLeadsNowhere) {
  auto store = storage::test::opened(folder.path());
  const storage::SubjectId id = *store->add_subject({"Ada"});
  const std::string code = receipt_of(*store->subject(id));
  ASSERT_TRUE(store->erase_subject(id).has_value());
  EXPECT_EQ(find_by_receipt(*store, code).error().code, Errc::NotFound);
}

TEST_F(ReceiptInTheStoreTest, IsNobodysName) {
  auto store = storage::test::opened(folder.path());
  const storage::SubjectId id = *store->add_subject({"Ada"});
  const std::string code = receipt_of(*store->subject(id));
  const auto chosen = choose_subject(*store, code);
  ASSERT_TRUE(chosen);
  EXPECT_EQ(*chosen, id) << "its owner, not somebody new";
  EXPECT_EQ(choose_subject(*store, receipt_of(with(1, 42))).error().code, Errc::NotFound);
  const auto grace = choose_subject(*store, "Grace");
  ASSERT_TRUE(grace);
  EXPECT_EQ(*grace, std::nullopt) << "somebody new";
  EXPECT_EQ(choose_subject(*store, "").error().code, Errc::InvalidInput) << "not: the only person";
}

}  // namespace
}  // namespace relievo::firmware
