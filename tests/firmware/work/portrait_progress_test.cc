// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/work/jobs.h"

#include <gtest/gtest.h>

#include <random>

namespace relievo::firmware {
namespace {

using std::chrono::milliseconds;

// Whatever the parts take, and whichever are left out.
TEST(PortraitProgress, NeverFallsAndNeverEndsBeforeItsEnd) {
  std::mt19937 random(11);
  for (int run = 0; run < 200; ++run) {
    const bool head = run % 2 == 0;
    PortraitProgress progress;
    progress.begin(head);
    EXPECT_EQ(progress.share(), 0);
    hal::Instant now{};
    float before = 0;
    for (std::size_t part = 0; part <= (head ? PortraitProgress::kFuse : kStages.size() - 1); ++part) {
      if (part >= kStages.size() && part < PortraitProgress::kFuse && random() % 2 == 0) continue;
      for (int looks = static_cast<int>(random() % 40); looks >= 0; --looks) {
        now += milliseconds(random() % 300);
        progress.works_on(part, now);
        EXPECT_GE(progress.share(), before);
        EXPECT_LT(progress.share(), 1);
        before = progress.share();
      }
    }
    progress.done();
    EXPECT_EQ(progress.share(), 1);
    progress.begin(head);
    EXPECT_EQ(progress.share(), 0) << "a new photograph begins anew";
  }
}

TEST(PortraitProgress, APartCountsAsLongAsItTakes) {
  PortraitProgress progress;
  progress.begin();
  progress.works_on(0, hal::Instant{});
  progress.works_on(1, hal::Instant(milliseconds(1)));
  const float matched = progress.share();
  progress.works_on(2, hal::Instant(milliseconds(2)));
  EXPECT_GT(matched, 5 * (progress.share() - matched)) << "matching is the longest part, points the shortest";
}

}  // namespace
}  // namespace relievo::firmware
