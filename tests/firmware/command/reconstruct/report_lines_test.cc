// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What `reconstruct` says of light and motion: the picture and how much of the face, and nothing where
// nothing is wrong.
#include <gtest/gtest.h>

#include <string>

#include "firmware/report/report.h"

namespace relievo::firmware {
namespace {

TEST(ReportLines, NameThePictureThatIsWhite) {
  const std::string right = line_of_light({0.01, 0.31}), left = line_of_light({0.4, 0.31});
  EXPECT_NE(right.find("31 % of the face is white in the right picture"), std::string::npos) << right;
  EXPECT_NE(left.find("40 % of the face is white in the left picture"), std::string::npos) << left;
  EXPECT_EQ(line_of_light({0.01, 0}), "") << "a shine on the nose";
}

TEST(ReportLines, SpeakOfMotionOnlyWhereItMatters) {
  const std::string line = line_of_motion(0.33);
  EXPECT_NE(line.find("0.33 px"), std::string::npos) << line;
  EXPECT_EQ(line_of_motion(0.06), "");
  EXPECT_EQ(line_of_motion(0), "");
}

}  // namespace
}  // namespace relievo::firmware
