// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/kiosk/receipt.h"

#include <gtest/gtest.h>

namespace relievo::firmware {
namespace {

TEST(Receipt, LeadsBackToTheSubject) {
  for (const std::int64_t number : {1LL, 97LL, 123LL, 999'999LL, 1'234'567LL, 98'765'432'101LL}) {
    const storage::SubjectId id{number};
    ASSERT_TRUE(subject_of_receipt(receipt_of(id))) << receipt_of(id);
    EXPECT_EQ(*subject_of_receipt(receipt_of(id)), id);
  }
}

TEST(Receipt, OneWrongOrSwappedDigitIsNoticed) {
  const std::string code = receipt_of(storage::SubjectId{431'508});
  for (std::size_t i = 0; i < code.size(); ++i) {
    if (code[i] == '-') continue;
    for (char digit = '0'; digit <= '9'; ++digit) {
      std::string wrong = code;
      wrong[i] = digit;
      EXPECT_EQ(subject_of_receipt(wrong).has_value(), wrong == code) << wrong;
    }
    if (i + 1 < code.size() && code[i + 1] != '-' && code[i] != code[i + 1]) {
      std::string swapped = code;
      std::swap(swapped[i], swapped[i + 1]);
      EXPECT_FALSE(subject_of_receipt(swapped)) << swapped;
    }
  }
}

TEST(Receipt, OtherWordsAreNone) {
  for (const char* text : {"", "-", "Ada", "#3", "000001", "000001-", "000001-9", "00001-95", "000000-98", "-00001-95", "000001-95 "}) EXPECT_FALSE(subject_of_receipt(text)) << text;
}

}  // namespace
}  // namespace relievo::firmware
