// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/report/page.h"

#include <clocale>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace relievo::tests {
namespace {

namespace report = pipeline::report;

std::vector<std::byte> bytes(std::string_view text) {
  std::vector<std::byte> out;
  for (const char c : text) out.push_back(static_cast<std::byte>(c));
  return out;
}

TEST(ReportText, NothingEscapes) {
  EXPECT_EQ(report::escaped("<script>alert(\"1\" & '2')</script>"),
            "&lt;script&gt;alert(&quot;1&quot; &amp; &#39;2&#39;)&lt;/script&gt;");
  EXPECT_EQ(report::escaped("Gesicht, лицо, 顔, 🙂"), "Gesicht, лицо, 顔, 🙂");
}

TEST(ReportText, WhatIsNoUtf8IsReplacedAndWhatFollowsStays) {
  const std::string unknown = "\xEF\xBF\xBD";
  EXPECT_EQ(report::escaped("a\xFFz"), "a" + unknown + "z");
  EXPECT_EQ(report::escaped("\xC3<"), unknown + "&lt;") << "a lead byte swallows no markup";
  EXPECT_EQ(report::escaped("\xE2\x82\""), unknown + unknown + "&quot;");
  EXPECT_EQ(report::escaped("\xC0\xBCx"), unknown + unknown + "x") << "< in two bytes";
  EXPECT_EQ(report::escaped("\xED\xA0\x80"), unknown + unknown + unknown) << "half a surrogate pair";
  EXPECT_EQ(report::escaped("\xF4\x90\x80\x80"), unknown + unknown + unknown + unknown) << "beyond Unicode";
  EXPECT_EQ(report::escaped("\x1B[2J\n\xC2\x85"), unknown + "[2J" + unknown + unknown) << "controls";
  EXPECT_EQ(report::escaped(std::string_view("\0x", 2)), unknown + "x");
}

// Paper cannot be scrolled: the last column would be lost.
TEST(ReportText, WhatScrollsOnAScreenIsWholeOnPaper) {
  const std::string page = report::page("", "", "");
  const std::size_t screen = page.find(".scroll { overflow-x: auto; }"), print = page.find("@media print");
  ASSERT_LT(screen, print);
  ASSERT_NE(print, std::string::npos);
  EXPECT_NE(page.find(".scroll { overflow: visible; }", print), std::string::npos);
}

TEST(ReportText, LinksHoldNothingButNames) {
  EXPECT_EQ(report::linked("corners_01.png"), "corners_01.png");
  EXPECT_EQ(report::linked("a b#?%\"/\xC3\xA4"), "a%20b%23%3F%25%22%2F%C3%A4");
}

// RFC 4648, section 10.
TEST(ReportText, Base64) {
  EXPECT_EQ(report::base64(bytes("")), "");
  EXPECT_EQ(report::base64(bytes("f")), "Zg==");
  EXPECT_EQ(report::base64(bytes("fo")), "Zm8=");
  EXPECT_EQ(report::base64(bytes("foo")), "Zm9v");
  EXPECT_EQ(report::base64(bytes("foobar")), "Zm9vYmFy");
  EXPECT_EQ(report::base64(bytes("\xFF\xFE\xFD")), "//79");
}

TEST(ReportText, NumbersAreTheSameInEveryCountry) {
  const char* const before = std::setlocale(LC_ALL, "de_DE.UTF-8");
  EXPECT_EQ(report::figure(1234.5678, 2), "1234.57");
  EXPECT_EQ(report::number(1234.5, 2), "1234.5");
  if (before != nullptr) std::setlocale(LC_ALL, "C");
}

TEST(ReportText, Figures) {
  EXPECT_EQ(report::figure(-1.005, 1),
            "\xE2\x88\x92"
            "1.0");
  EXPECT_EQ(report::figure(-0.0004, 3), "0.000") << "nought has no sign";
  EXPECT_EQ(report::figure(2, 3), "2.000");
  EXPECT_EQ(report::figure(std::nan(""), 2), "\xE2\x80\x93");
  EXPECT_EQ(report::figure(std::numeric_limits<double>::infinity(), 2), "\xE2\x80\x93");
  EXPECT_EQ(report::number(-0.0004, 3), "0");
  EXPECT_EQ(report::number(-12.50, 2), "-12.5");
  EXPECT_EQ(report::number(100, 2), "100");
  EXPECT_EQ(report::number(std::nan(""), 2), "0") << "an attribute needs a number";
}

TEST(ReportText, ASigmaKeepsTwoDigits) {
  EXPECT_EQ(report::decimals_for(2.7), 1);
  EXPECT_EQ(report::decimals_for(27), 0);
  EXPECT_EQ(report::decimals_for(2700), 0);
  EXPECT_EQ(report::decimals_for(0.0027), 4);
  EXPECT_EQ(report::decimals_for(1e-12), 7);
  EXPECT_EQ(report::decimals_for(0), 3);
}

TEST(ReportText, SmallFiguresDoNotReadAsNought) {
  EXPECT_EQ(report::figure(0.00043, report::decimals_of(0.00043)), "0.0004");
  EXPECT_EQ(report::figure(0.0234, report::decimals_of(0.0234)), "0.023");
  EXPECT_EQ(report::figure(1.234, report::decimals_of(1.234)), "1.23");
  EXPECT_EQ(report::figure(123.4, report::decimals_of(123.4)), "123");
  EXPECT_EQ(report::figure(0, report::decimals_of(0)), "0.000");
}

TEST(ReportText, ReasonsBecomeSentences) {
  EXPECT_EQ(report::sentence("the board is bent"), "The board is bent.");
  EXPECT_EQ(report::sentence("6 pairs are few"), "6 pairs are few.");
  EXPECT_EQ(report::sentence("bent by 0.32 mm (+-0.03)"), "Bent by 0.32 mm (±0.03).");
  EXPECT_EQ(report::sentence(""), "");
  EXPECT_EQ(report::counted(1, "pair", "pairs"), "1 pair");
  EXPECT_EQ(report::counted(0, "pair", "pairs"), "0 pairs");
}

}  // namespace
}  // namespace relievo::tests
