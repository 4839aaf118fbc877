// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Real voices, and a sound card that SDL plays.
#include "hal/sound/speaker.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <string>
#include <thread>
#include <vector>

namespace relievo::hal {
namespace {

using Samples = std::vector<std::int16_t>;

const std::map<std::string, std::string> kSaid{{"en", "Please hold still"},
                                               {"de", "Bitte still halten"},
                                               {"fr", "Ne bougez plus"},
                                               {"es", "No se mueva, por favor"},
                                               {"zh-Hans", "请保持不动"}};

Samples spoken(const Speech& speech) {
  Samples all;
  const auto done = synthesize(speech, [&](std::span<const std::int16_t> samples) {
    all.insert(all.end(), samples.begin(), samples.end());
    return true;
  });
  EXPECT_TRUE(done.has_value()) << done.error().what.view();
  return all;
}

TEST(Synthesizer, EveryVoiceSpeaksAndTheyDiffer) {
  ASSERT_TRUE(open_synthesizer().has_value());
  for (const auto& [language, words] : kSaid) {
    EXPECT_TRUE(has_voice_for(language));
    const Samples samples = spoken({words, language});
    EXPECT_GT(samples.size(), 10'000U) << language;
    EXPECT_GT(std::ranges::max(samples), 3000) << language;
  }
  EXPECT_NE(spoken({"Version", "en"}), spoken({"Version", "de"}));
  for (const char* language : {"ar", "he", "ja", "", "en-x"}) {
    EXPECT_FALSE(has_voice_for(language));
    const auto sink = [](std::span<const std::int16_t>) { return true; };
    EXPECT_EQ(synthesize({"a", language}, sink).error().code, Errc::NotFound);
  }
}

TEST(Synthesizer, ReadsChineseAsChinese) {
  ASSERT_TRUE(open_synthesizer().has_value());
  // A letter it does not know it would spell out in English.
  EXPECT_LT(spoken({"请保持不动", "zh-Hans"}).size(), 50'000U);
}

TEST(Synthesizer, VolumeAndSpeedAreHeard) {
  ASSERT_TRUE(open_synthesizer().has_value());
  const Speech usual{"Please hold your head upright", "en"};
  Speech half = usual, fast = usual;
  half.volume_percent = 50;
  fast.speed_percent = 150;
  const Samples samples = spoken(usual);
  EXPECT_NEAR(std::ranges::max(spoken(half)), std::ranges::max(samples) / 2, 2000);
  EXPECT_LT(spoken(fast).size(), samples.size() * 4 / 5);
}

TEST(Synthesizer, StopsWhenNoMoreIsWanted) {
  ASSERT_TRUE(open_synthesizer().has_value());
  std::string long_text;
  for (int i = 0; i < 200; ++i) long_text += "Please hold your head upright. ";
  int pieces = 0;
  EXPECT_TRUE(
      synthesize({long_text, "en"}, [&](std::span<const std::int16_t>) { return ++pieces < 3; }).has_value());
  EXPECT_EQ(pieces, 3);
  EXPECT_GT(spoken({"Go on", "en"}).size(), 1000U) << "and it speaks again";
}

class Plug final : public InputSwitch {
 public:
  explicit Plug(const bool& in) : in_(in) {}
  bool is_on() override { return in_; }

 private:
  const bool& in_;
};

class SdlSpeakerTest : public testing::Test {
 protected:
  SdlSpeakerTest() { setenv("SDL_AUDIODRIVER", "dummy", 1); }
  ~SdlSpeakerTest() override { unsetenv("SDL_AUDIODRIVER"); }
  // Minutes are "never".
  static bool until_silent(const Speaker& speaker) {
    for (int i = 0; i < 100'000 && speaker.is_speaking(); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    return !speaker.is_speaking();
  }
  bool plugged = false;
};

TEST_F(SdlSpeakerTest, SpeaksToTheEndAndIsCutInTheMiddle) {
  auto speaker = open_sdl_speaker(std::make_unique<Plug>(plugged));
  ASSERT_TRUE(speaker.has_value()) << speaker.error().what.view();
  Speaker& s = **speaker;
  EXPECT_FALSE(s.is_speaking());
  s.say({"Yes", "en"});
  EXPECT_TRUE(s.is_speaking());
  EXPECT_TRUE(until_silent(s));
  const std::string long_text(4000, 'a');
  s.say({long_text, "en"});
  s.hush();
  EXPECT_FALSE(s.is_speaking());
  s.say({long_text, "en"});
  s.say({"No", "de"});
  EXPECT_TRUE(until_silent(s)) << "the newest counts";
  s.say({"", "en"});
  EXPECT_FALSE(s.is_speaking());
  s.say({"x", "xx"});
  EXPECT_TRUE(until_silent(s)) << "a language without a voice is over at once";
  s.play(Sound::Done, 1);
  s.say({long_text, "en"});  // and ends in the middle of it
}

TEST_F(SdlSpeakerTest, ThePlugThatIsPulledEndsWhatIsSaid) {
  auto speaker = open_sdl_speaker(std::make_unique<Plug>(plugged));
  ASSERT_TRUE(speaker.has_value());
  Speaker& s = **speaker;
  EXPECT_FALSE(s.has_headphones());
  plugged = true;
  EXPECT_TRUE(s.has_headphones());
  s.say({std::string(4000, 'a'), "en"});
  EXPECT_TRUE(s.has_headphones());
  EXPECT_TRUE(s.is_speaking());
  plugged = false;
  EXPECT_FALSE(s.has_headphones());
  EXPECT_FALSE(s.is_speaking());
}

TEST_F(SdlSpeakerTest, WithoutACardItIsAnError) {
  setenv("SDL_AUDIODRIVER", "no such driver", 1);
  const auto speaker = open_sdl_speaker(nullptr);
  ASSERT_FALSE(speaker.has_value());
  EXPECT_EQ(speaker.error().code, Errc::Unsupported);
}

}  // namespace
}  // namespace relievo::hal
