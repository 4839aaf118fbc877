// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A few of the visits by ear; ear_proof in tests/bench makes a hundred.
#include "tests/firmware/kiosk/ear_visit.h"

#include <gtest/gtest.h>

#include "tests/support/proof.h"

namespace relievo::test {
namespace {

TEST(EarVisit, WordsAndTonesLeadFromAWrongPoseToThePicture) {
  RELIEVO_MANY_TRIALS();
  Album& album = shared_album();
  GateFixture gate;
  for (const std::uint32_t seed : {1001U, 1006U, 1011U}) {
    const EarVisit visit = visit_by_ear(seed, album, gate);
    EXPECT_TRUE(visit.captured) << seed << ": from " << print(visit.first) << " to " << print(visit.last)
                                << "\n"
                                << visit.heard;
  }
}

// What leads them is what is heard, and nothing else.
TEST(EarVisit, WhoHearsNothingStaysWhereTheyAre) {
  BlindVisitor visitor(7);
  Stance stance;
  stance.right = 100;
  for (int i = 1; i <= 100; ++i) stance = visitor.move(0.24 * i, stance);
  EXPECT_NEAR(stance.right, 100, 25) << "sways";
}

}  // namespace
}  // namespace relievo::test
