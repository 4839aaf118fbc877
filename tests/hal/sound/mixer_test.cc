// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/sound/mixer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <vector>

namespace relievo::hal {
namespace {

using Samples = std::vector<std::int16_t>;

Samples played(Mixer& mixer, std::size_t count) {
  Samples samples(count, 77);
  mixer.fill(samples);
  return samples;
}

bool silent(const Samples& samples) {
  return std::ranges::all_of(samples, [](std::int16_t s) { return s == 0; });
}

// How often a pure tone goes up through zero.
int rounds(const Samples& samples) {
  int count = 0;
  for (std::size_t i = 1; i < samples.size(); ++i) count += samples[i - 1] <= 0 && samples[i] > 0;
  return count;
}

std::size_t heard_for(const Samples& samples) {
  const auto last = std::find_if(samples.rbegin(), samples.rend(), [](std::int16_t s) { return s != 0; });
  return static_cast<std::size_t>(samples.rend() - last);
}

TEST(Mixer, PlaysEverySampleOnceAndInOrder) {
  Mixer mixer;
  const auto text = mixer.begin();
  EXPECT_TRUE(mixer.is_speaking());
  Samples all(3000);
  std::iota(all.begin(), all.end(), std::int16_t{1});
  Samples heard;
  std::size_t at = 0;
  bool finished = false;
  while (!finished) {
    while (at < all.size() &&
           mixer.put(text, std::span(all).subspan(at, std::min(Mixer::kPiece, all.size() - at))))
      at = std::min(all.size(), at + Mixer::kPiece);
    if (at == all.size()) finished = mixer.finish(text);
    const Samples some = played(mixer, 333);
    heard.insert(heard.end(), some.begin(), some.end());
  }
  const Samples rest = played(mixer, 4000);
  heard.insert(heard.end(), rest.begin(), rest.end());
  EXPECT_TRUE(std::equal(all.begin(), all.end(), heard.begin()));
  EXPECT_EQ(heard_for(heard), all.size());
  EXPECT_FALSE(mixer.is_speaking());
}

TEST(Mixer, TakesNoMoreThanThereIsRoomFor) {
  Mixer mixer;
  const auto text = mixer.begin();
  const Samples piece(Mixer::kPiece, 5);
  int taken = 0;
  while (mixer.put(text, piece) && taken < 1000) ++taken;
  EXPECT_LT(taken, 1000);
  EXPECT_FALSE(mixer.finish(text));
  (void)played(mixer, Mixer::kPiece + 1);
  EXPECT_TRUE(mixer.put(text, piece));
}

TEST(Mixer, WhatIsCutIsSilentAtOnceHoweverLateItComes) {
  Mixer mixer;
  const auto first = mixer.begin();
  ASSERT_TRUE(mixer.put(first, Samples(Mixer::kPiece, 100)));
  EXPECT_FALSE(silent(played(mixer, 10)));
  mixer.cut();
  EXPECT_FALSE(mixer.is_speaking());
  EXPECT_FALSE(mixer.is_wanted(first));
  EXPECT_TRUE(mixer.put(first, Samples(Mixer::kPiece, 100))) << "made before the voice noticed";
  EXPECT_TRUE(mixer.finish(first));
  EXPECT_TRUE(silent(played(mixer, 2000)));
  EXPECT_FALSE(mixer.is_speaking());
  // The next text follows without what was left of the one before.
  const auto old = mixer.begin();
  ASSERT_TRUE(mixer.put(old, Samples(Mixer::kPiece, 100)));
  const auto second = mixer.begin();
  ASSERT_TRUE(mixer.put(old, Samples(8, 100)));
  ASSERT_TRUE(mixer.put(second, Samples(8, 7)));
  ASSERT_TRUE(mixer.finish(old));
  EXPECT_EQ(played(mixer, 8), Samples(8, 7));
  EXPECT_TRUE(mixer.is_speaking()) << "the old one's end is not the new one's";
  ASSERT_TRUE(mixer.finish(second));
  EXPECT_TRUE(silent(played(mixer, 8)));
  EXPECT_FALSE(mixer.is_speaking());
}

// A visitor's name may have been spelled.
TEST(Mixer, KeepsNothingOfWhatItPlayedOrWillNot) {
  Mixer mixer;
  const Samples spoken(Mixer::kPiece, 0x5AC3);
  // In whole words of it: no other number of the mixer is one.
  const auto kept = [&mixer] {
    const std::span bytes(reinterpret_cast<const std::byte*>(&mixer), sizeof mixer);
    int count = 0;
    for (std::size_t at = 0; at + 2 <= bytes.size(); at += 2)
      count += bytes[at] == std::byte{0xC3} && bytes[at + 1] == std::byte{0x5A};
    return count;
  };
  const auto text = mixer.begin();
  ASSERT_TRUE(mixer.put(text, spoken));
  ASSERT_TRUE(mixer.put(text, spoken));
  EXPECT_EQ(kept(), 2 * static_cast<int>(Mixer::kPiece))
      << "there is nothing to wipe: this test shows nothing";
  (void)played(mixer, Mixer::kPiece + 1);
  EXPECT_EQ(kept(), static_cast<int>(Mixer::kPiece)) << "what was played is gone";
  while (mixer.put(text, spoken)) {
  }
  mixer.cut();
  (void)played(mixer, 1);
  EXPECT_EQ(kept(), 0) << "and what is not to be played any more";
}

TEST(Mixer, EverySoundIsShortQuietAndItsOwn) {
  std::vector<Samples> all;
  for (std::size_t i = 0; i < kSounds; ++i) {
    Mixer mixer;
    EXPECT_TRUE(silent(played(mixer, 100)));
    mixer.play(static_cast<Sound>(i), 1);
    const Samples samples = played(mixer, kSamplesPerSecond);
    const auto loudest = std::ranges::max(samples);
    EXPECT_GT(loudest, 1000) << i;
    EXPECT_LT(loudest, 6000) << i << ": quiet";
    EXPECT_LT(heard_for(samples), kSamplesPerSecond / 2) << i << ": short";
    EXPECT_LT(std::abs(samples[0]), 100) << i << ": it does not crack";
    EXPECT_EQ(std::ranges::count(all, samples), 0) << i << " sounds as another one does";
    all.push_back(samples);
  }
}

TEST(Mixer, ThePitchIsTheFrequency) {
  Mixer mixer;
  mixer.play(Sound::Guide, 1);
  const int low = rounds(played(mixer, kSamplesPerSecond));
  mixer.play(Sound::Guide, 2);
  EXPECT_NEAR(rounds(played(mixer, kSamplesPerSecond)), 2 * low, 2);
  EXPECT_GT(low, 20);
}

TEST(Mixer, ASoundIsHeardBesideSpeechAndNothingOverflows) {
  Mixer mixer;
  const auto text = mixer.begin();
  ASSERT_TRUE(mixer.put(text, Samples(Mixer::kPiece, 32767)));
  mixer.play(Sound::Done, 1);
  const Samples samples = played(mixer, Mixer::kPiece);
  EXPECT_GT(std::ranges::min(samples), 20000) << "no sample has turned round";
  EXPECT_LT(std::ranges::min(samples), 32000) << "the tone is in it";
}

}  // namespace
}  // namespace relievo::hal
