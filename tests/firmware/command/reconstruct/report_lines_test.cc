// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What `reconstruct` says of light and motion: the picture and how much of the face, and nothing where nothing is wrong.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "firmware/command/reconstruct/report.h"

namespace relievo::firmware {
namespace {

using testing::HasSubstr;

TEST(ReportLines, NameThePictureThatIsWhite) {
  EXPECT_THAT(line_of_light({0.01, 0.31}), HasSubstr("31 % of the face is white in the right picture"));
  EXPECT_THAT(line_of_light({0.4, 0.31}), HasSubstr("40 % of the face is white in the left picture"));
  EXPECT_EQ(line_of_light({0.01, 0}), "") << "a shine on the nose";
}

TEST(ReportLines, SpeakOfMotionOnlyWhereItMatters) {
  EXPECT_THAT(line_of_motion(0.33), HasSubstr("0.33 px"));
  EXPECT_EQ(line_of_motion(0.06), "");
  EXPECT_EQ(line_of_motion(0), "");
}

}  // namespace
}  // namespace relievo::firmware
