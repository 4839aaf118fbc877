// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/recording_speaker.h"

#include <gtest/gtest.h>

#include "tests/support/manual_clock.h"

namespace relievo::hal {
namespace {

using namespace std::chrono_literals;

TEST(RecordingSpeaker, WritesDownWhatWhenAndForWhom) {
  ManualClock clock;
  RecordingSpeaker speaker(clock, {"en", "de"});
  EXPECT_TRUE(speaker.has_voice("de"));
  EXPECT_FALSE(speaker.has_voice("ja"));
  speaker.say({"Good morning", "en", 80, 150});
  EXPECT_TRUE(speaker.is_speaking());
  clock.advance(1h);
  EXPECT_FALSE(speaker.is_speaking());
  speaker.plug(true);
  speaker.say({"Guten Tag", "de"});
  clock.advance(1ms);
  speaker.play(Sound::Done, 1);
  EXPECT_TRUE(speaker.is_speaking()) << "a sound is heard beside it";
  speaker.plug(false);
  EXPECT_FALSE(speaker.is_speaking());
  ASSERT_EQ(speaker.heard().size(), 3U);
  const auto &first = speaker.heard()[0], &second = speaker.heard()[1], &third = speaker.heard()[2];
  EXPECT_EQ(first.text, "Good morning");
  EXPECT_EQ(first.volume_percent, 80);
  EXPECT_EQ(first.speed_percent, 150);
  EXPECT_FALSE(first.alone);
  EXPECT_FALSE(first.cut);
  EXPECT_EQ(second.at - first.at, 1h);
  EXPECT_EQ(second.language, "de");
  EXPECT_TRUE(second.alone);
  EXPECT_TRUE(second.cut) << "the plug was pulled";
  EXPECT_TRUE(third.text.empty());
  EXPECT_EQ(third.sound, Sound::Done);
}

}  // namespace
}  // namespace relievo::hal
