// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/kiosk/code/code_scanner.h"

#include <gtest/gtest.h>

namespace relievo::firmware {
namespace {

TEST(CodeText, NamesAndNumbersPass) {
  for (const char* good :
       {"A-2041", "000123-09", "Zoë Müller-Lüdenscheidt", "عائشة", "王小明", "山田 太郎", "𠮷野"})
    EXPECT_EQ(code_text(good), good);
  EXPECT_EQ(code_text("  Ada \t\r\n"), "Ada");
  EXPECT_EQ(code_text("Ada   Lovelace"), "Ada Lovelace");
  EXPECT_EQ(code_text(std::string(128, 'x')), std::string(128, 'x'));
}

TEST(CodeText, WhatCouldHarmOrHideDoesNot) {
  for (const char* bad : {"", " \n ", "two\nlines", "bell\a", "https://example.org/x", "\xC3\x28", "\xE2\x82",
                          "\xC0\xAF", "\xED\xA0\x80", "\xF5\x80\x80\x80", "\xFF", "right\xE2\x80\xAEleft",
                          "in\xE2\x80\x8Bvisible", "\xEF\xBB\xBFmark", "soft\xC2\xADhyphen", "\xEE\x80\x80"})
    EXPECT_FALSE(code_text(bad)) << bad;
  EXPECT_FALSE(code_text(std::string(129, 'x')));
  EXPECT_FALSE(code_text(std::string("nul\0inside", 10)));
}

}  // namespace
}  // namespace relievo::firmware
