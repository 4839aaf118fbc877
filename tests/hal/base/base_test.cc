// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The floor: results, arenas, mailboxes, threads.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "hal/base/arena.h"
#include "hal/base/mailbox.h"
#include "hal/base/result.h"
#include "hal/base/thread_pool.h"
#include "hal/base/words.h"

namespace relievo {
namespace {

Result<int> half(int n) {
  if (n % 2 != 0) return Error{Errc::InvalidInput, "odd"}.at("n");
  return n / 2;
}
Result<int> quarter(int n) {
  RELIEVO_TRY_ASSIGN(const int once, half(n));
  RELIEVO_TRY(half(once));
  return half(once);
}

TEST(Result, HandsTheFirstErrorOnUnchanged) {
  EXPECT_EQ(*quarter(12), 3);
  const auto failed = quarter(6);
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().code, Errc::InvalidInput);
  EXPECT_EQ(failed.error().where(), "n");
}

TEST(Result, MovesOutWhatCannotBeCopied) {
  Result<std::unique_ptr<int>> made = std::make_unique<int>(7);
  const std::unique_ptr<int> taken = *std::move(made);
  EXPECT_EQ(*taken, 7);
}

TEST(Error, KeepsTheEndOfALongPath) {
  const std::string path = std::string(300, 'a') + "/end.png";
  const Error error = Error{Errc::NotFound, "gone"}.at(path);
  EXPECT_EQ(error.where().size(), 191U);
  EXPECT_TRUE(error.where().ends_with("/end.png"));
}

TEST(Words, ANameIsShownInItsOwnDirectionAndWithoutWhatIsNoLetter) {
  EXPECT_EQ(shown_name("Zo\xc3\xab \xd7\x90 1.relievo"), "Zo\xc3\xab \xd7\x90 1.relievo");
  EXPECT_EQ(shown_name("a\xe2\x80\xae"
                       "b\xe2\x81\xa6"
                       "c\xd8\x9c"
                       "d"),
            "a?b?c?d");
  EXPECT_EQ(shown_name("a\xe2\x80\xa8"
                       "b\xc2\x85"
                       "c\x7f\n"),
            "a?b?c??");
  EXPECT_EQ(shown_name("a\xff\xc3"), "a??");
  EXPECT_EQ(shown_name(""), "");
}

TEST(Result, AnErrorIsTakenToAPlaceAndAValueIsNot) {
  EXPECT_EQ(*half(4).at("there"), 2);
  EXPECT_EQ(half(3).at("there").error().where(), "there");
  EXPECT_TRUE(Result<void>().at("there"));
}

TEST(Words, ADetailIsOneLineWhateverTheFileIsCalled) {
  const Error error = Error{Errc::NotFound, "is not there: check the name"}.at("a\nb\x1b[31m.png");
  EXPECT_EQ(detail_of(error), "a?b?[31m.png: is not there: check the name");
  std::string long_name;
  for (int i = 0; i < 100; ++i) long_name += "\xc3\xa9";  // is cut within a letter
  EXPECT_TRUE(detail_of(Error{Errc::NotFound, "gone"}.at(long_name)).starts_with("?\xc3\xa9"));
  EXPECT_EQ(detail_of(Error{Errc::NotFound, "is not there", 2}), "is not there (No such file or directory)");
}

TEST(Words, ValuesStandInTheirPlaces) {
  EXPECT_EQ(filled("only {} of {} agree", {"5", "{}"}), "only 5 of {} agree");
  EXPECT_EQ(filled("{} of {}", {"5"}), "5 of {}");
  EXPECT_EQ(filled("none", {"5"}), "none");
  EXPECT_EQ(decimal(0.125, 2) + decimal(1.5, 1, true), "0.12+1.5");
  EXPECT_EQ(printed("%-3s|%zu|%.1f", "a", std::size_t{7}, 0.25), "a  |7|0.2");
  EXPECT_EQ(printed("%s", std::string(600, 'x').c_str()), std::string(511, 'x'));
}

TEST(Arena, GivesAlignedMemoryAndThrowsAtTheEnd) {
  alignas(64) std::array<std::byte, 256> block{};
  Arena arena(block);
  (void)arena.allocate(1, 1);
  void* aligned = arena.allocate(16, 32);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(aligned) % 32, 0U);
  EXPECT_THROW((void)arena.allocate(300, 8), std::bad_alloc);
  EXPECT_LE(arena.used(), arena.capacity());
  const std::size_t high = arena.high_water();
  arena.reset();
  EXPECT_EQ(arena.used(), 0U);
  EXPECT_EQ(arena.high_water(), high);
}

TEST(Arena, WipeLeavesNothingBehind) {
  std::array<std::byte, 128> block{};
  Arena arena(block);
  auto* secret = static_cast<std::byte*>(arena.allocate(64, 1));
  std::fill(secret, secret + 64, std::byte{0x5e});
  arena.wipe();
  for (const std::byte b : block) EXPECT_EQ(b, std::byte{0});
}

TEST(Mailbox, TheNewestReplacesWhatNobodyTook) {
  Mailbox<int> box;
  box.put(1);
  box.put(2);
  EXPECT_EQ(box.take_for(std::chrono::milliseconds(1)), 2);
  EXPECT_EQ(box.take_for(std::chrono::milliseconds(1)), std::nullopt);
}

TEST(Mailbox, WakesTheWaitingThread) {
  Mailbox<int> box;
  std::thread writer([&] { box.put(5); });
  EXPECT_EQ(box.take_for(std::chrono::seconds(10)), 5);
  writer.join();
}

TEST(ThreadPool, EveryIndexExactlyOnceWhateverTheThreads) {
  for (const int threads : {1, 2, 4}) {
    ThreadPool pool(threads);
    for (const int count : {0, 1, 7, 1000}) {
      std::vector<std::atomic<int>> hits(static_cast<std::size_t>(count));
      pool.for_each_band(count, 13, [&](int begin, int end, int) {
        for (int i = begin; i < end; ++i) ++hits[static_cast<std::size_t>(i)];
      });
      pool.for_each(count, 13, [&](int i) { ++hits[static_cast<std::size_t>(i)]; });
      pool.for_each<std::size_t>(count, 13,
                                 [&](std::size_t i, int band) { hits[i] += band >= 0 && band < 13 ? 1 : 9; });
      for (const auto& h : hits) EXPECT_EQ(h.load(), 3);
    }
  }
}

TEST(ThreadPool, BandsDoNotDependOnTheThreads) {
  const auto edges = [](int threads) {
    ThreadPool pool(threads);
    std::vector<int> begins(9);
    pool.for_each_band(100, 9,
                       [&](int begin, int, int band) { begins[static_cast<std::size_t>(band)] = begin; });
    return begins;
  };
  EXPECT_EQ(edges(1), edges(3));
}

// Rounds so short that threads arrive late, and pauses so long that they fall asleep between two.
TEST(ThreadPool, LateAndSleepingThreadsTakeNoBandTwice) {
  for (const int threads : {2, 4}) {
    ThreadPool pool(threads);
    for (int round = 0; round < 2000; ++round) {
      std::vector<int> hits(static_cast<std::size_t>(1 + round % 23));
      pool.for_each_band(static_cast<int>(hits.size()), 1 + round % 11, [&](int begin, int end, int) {
        for (int i = begin; i < end; ++i) ++hits[static_cast<std::size_t>(i)];
      });
      for (const int h : hits) ASSERT_EQ(h, 1) << "round " << round << ", " << threads << " threads";
      if (round % 500 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
}

TEST(ThreadPool, RethrowsAndStaysUsable) {
  ThreadPool pool(2);
  EXPECT_THROW(pool.for_each_band(8, 8,
                                  [](int begin, int, int) {
                                    if (begin == 5) throw std::runtime_error("x");
                                  }),
               std::runtime_error);
  std::atomic<int> sum{0};
  pool.for_each_band(8, 8, [&](int begin, int, int) { sum += begin; });
  EXPECT_EQ(sum.load(), 28);
}

}  // namespace
}  // namespace relievo
