// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "storage/export/format/export_mesh.h"

#include <gtest/gtest.h>

#include <string>

namespace relievo::storage {
namespace {

TEST(NumberText, RoundsAndKeepsNoNeedlessDigit) {
  const struct {
    double value;
    int decimals;
    const char* text;
  } kCases[] = {{0, 3, "0"},       {-0.0004, 3, "0"},        {-0.0006, 3, "-0.001"},
                {12.5, 3, "12.5"}, {-12.0625, 3, "-12.063"}, {100, 3, "100"},
                {0.99999, 3, "1"}, {0.00001, 5, "0.00001"},  {7.25, 0, "7"}};
  for (const auto& c : kCases) {
    std::string text;
    append_rounded(text, c.value, c.decimals);
    EXPECT_EQ(text, c.text);
  }
}

}  // namespace
}  // namespace relievo::storage
