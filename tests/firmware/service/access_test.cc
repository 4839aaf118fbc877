// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Guessing PINs: right ones lead in, wrong ones cost time, and neither a restart nor a clock that was set
// back gives a further try. On a real store; time moves by hand.
#include "firmware/service/access.h"

#include <gtest/gtest.h>

#include <memory>
#include <numeric>
#include <optional>
#include <string>

#include "firmware/service/statistics.h"
#include "storage/sqlite/sqlite_store.h"
#include "tests/support/temporary_folder.h"

namespace relievo::firmware {
namespace {

using std::chrono::seconds;
using ui::StaffRole;

class WallClock final : public hal::Clock {
 public:
  hal::Instant now() const override { return {}; }
  std::chrono::system_clock::time_point wall_now() const override { return at; }
  std::chrono::system_clock::time_point at{seconds(1'772'000'000)};
};

class AccessTest : public testing::Test {
 protected:
  AccessTest() { restart(); }
  void restart() {
    store.reset();
    auto opened = storage::open_sqlite_store(folder.path() / "store", clock, {});
    ASSERT_TRUE(opened.has_value());
    store = std::move(*opened);
    access.emplace(*store, clock);
  }
  Attempt attempt(const char* pin) {
    const auto answer = access->attempt(pin);
    EXPECT_TRUE(answer.has_value());
    return answer ? *answer : Attempt{};
  }
  test::TemporaryFolder folder;
  WallClock clock;
  std::unique_ptr<storage::Store> store;
  std::optional<Access> access;
};

TEST_F(AccessTest, EachPinOpensItsOwnRoleAndNoneIsKeptReadable) {
  EXPECT_FALSE(*access->is_set_up());
  EXPECT_EQ(attempt("4711").role, StaffRole::None) << "nobody has chosen anything";
  clock.at += seconds(5);
  ASSERT_TRUE(access->set_up("4711", "80526").has_value());
  restart();
  EXPECT_TRUE(*access->is_set_up());
  EXPECT_EQ(attempt("4711").role, StaffRole::Technician);
  EXPECT_EQ(attempt("80526").role, StaffRole::Operator);
  const std::string kept = *store->setting(kAccessSetting);
  EXPECT_EQ(kept.find("4711"), std::string::npos);
  EXPECT_EQ(kept.find("80526"), std::string::npos);
}

TEST_F(AccessTest, WrongPinsCostTimeAndARestartGivesNoFurtherTry) {
  ASSERT_TRUE(access->set_up("4711", "80526").has_value());
  seconds waited{0};
  for (int wrong = 1; wrong <= 6; ++wrong) {
    const Attempt tried = attempt("1999");
    EXPECT_TRUE(tried.wrong);
    EXPECT_EQ(tried.wait, wait_after(wrong));
    EXPECT_EQ(tried.locked, tried.wait >= seconds(60));
    restart();
    EXPECT_EQ(*access->is_locked(), tried.locked);
    EXPECT_EQ(attempt("4711").role, StaffRole::None) << "the right one, too early";
    EXPECT_EQ(*access->wait(), wait_after(wrong)) << "asking early costs nothing more";
    clock.at += tried.wait;
    waited += tried.wait;
  }
  EXPECT_GE(waited, seconds(900));
  EXPECT_EQ(attempt("4711").role, StaffRole::Technician);
  EXPECT_EQ(*access->wait(), seconds(0)) << "who was right begins anew";
}

TEST_F(AccessTest, AClockSetBackBeginsTheWaitAnew) {
  ASSERT_TRUE(access->set_up("4711", "80526").has_value());
  for (int wrong = 1; wrong <= 5; ++wrong) {
    attempt("1999");
    if (wrong < 5) clock.at += wait_after(wrong);
  }
  clock.at -= std::chrono::hours(24);
  EXPECT_EQ(*access->wait(), wait_after(5));
  clock.at += wait_after(5);
  EXPECT_EQ(attempt("80526").role, StaffRole::Operator);
}

// Written by libsodium, which earlier versions used (the format is that of the reference implementation).
TEST(PinHash, OpensWithTextsOfEarlierVersionsAndWithNothingElse) {
  const std::string kept =
      "$argon2id$v=19$m=19456,t=2,p=1$98ubdDgCzeJau498SEUjRA$ig493pltmQqRYfekK0ftZWDTVSH41iqexTFZZ4fs2AU";
  EXPECT_TRUE(*is_pin_of("4711", kept));
  EXPECT_FALSE(*is_pin_of("4712", kept));
  EXPECT_FALSE(*is_pin_of("4711", kept.substr(0, 60)));
  EXPECT_FALSE(*is_pin_of("4711", ""));
  const std::string now = *stretched("4711");
  EXPECT_TRUE(now.starts_with(kept.substr(0, kept.rfind("p=1$") + 4))) << now;
  EXPECT_NE(now, *stretched("4711")) << "each has a salt of its own";
  EXPECT_TRUE(*is_pin_of("4711", now));
}

TEST(AccessWait, TenThousandGuessesTakeAYear) {
  seconds all{0};
  for (int wrong = 1; wrong <= 10'000; ++wrong) all += wait_after(wrong);
  EXPECT_GT(all, std::chrono::hours(24 * 365));
}

TEST_F(AccessTest, WeakSharedAndOddPinsAreRefused) {
  for (const char* pin : {"1111", "1234", "87654321", "123", "123456789", "12a4", ""})
    EXPECT_FALSE(access->check_new(StaffRole::Operator, pin).has_value()) << pin;
  EXPECT_FALSE(access->set_up("4711", "4711").has_value());
  ASSERT_TRUE(access->set_up("4711", "80526").has_value());
  EXPECT_EQ(access->set(StaffRole::Operator, "4711").error().code, Errc::InvalidState);
  ASSERT_TRUE(access->set(StaffRole::Operator, "2718").has_value());
  EXPECT_EQ(attempt("2718").role, StaffRole::Operator);
  EXPECT_EQ(attempt("80526").role, StaffRole::None) << "the old one is gone";
}

TEST(Statistics, CountsWhatBecameOfEveryVisitAndComesBackFromItsText) {
  const std::chrono::sys_days first = std::chrono::year{2026} / 3 / 2, later = first + std::chrono::days(3);
  Statistics counts;
  counts.begin("2026-03-02");
  const Error refused{Errc::TooFewMatches, "as the test says"};
  const auto seconds_of = [](double s) {
    return std::chrono::nanoseconds(static_cast<std::int64_t>(s * 1e9));
  };
  counts.noted({State::Idle, Event::PoseAsked, State::Position}, nullptr, {}, first);
  counts.noted({State::Capture, Event::Triggered, State::Match}, nullptr, {}, first);
  counts.noted({State::Match, Event::AdviceGiven, State::Position}, &refused, {}, first);
  counts.noted({State::Capture, Event::Triggered, State::Match}, nullptr, {}, first);
  counts.noted({State::Assemble, Event::StageDone, State::Review}, nullptr, seconds_of(2.6), first);
  counts.noted({State::Store, Event::StageDone, State::Idle}, nullptr, {}, first);
  counts.noted({State::Idle, Event::PoseAsked, State::Position}, nullptr, {}, later);
  counts.noted({State::Position, Event::Cancel, State::Idle}, nullptr, {}, later);
  Statistics read;
  ASSERT_TRUE(read.read(counts.text()));
  const ui::StatisticsView seen = read.view(later);
  EXPECT_EQ(seen.since, "2026-03-02");
  EXPECT_EQ(seen.visits, 2U);
  EXPECT_EQ(seen.captures, 2U);
  EXPECT_EQ(seen.models, 1U);
  EXPECT_EQ(seen.stored, 1U);
  EXPECT_EQ(seen.left, 1U);
  EXPECT_EQ(seen.refused[static_cast<std::size_t>(ui::Refusal::TooFewMatches)], 1U);
  EXPECT_DOUBLE_EQ(seen.median_s, 2.75);
  // Each day by itself, those without anybody between them; the last is today.
  const auto day = [](const auto& values, std::size_t ago) { return values[ui::kStatisticsDays - 1 - ago]; };
  EXPECT_EQ(day(seen.days.visits, 3), 1);
  EXPECT_EQ(day(seen.days.stored, 3), 1);
  EXPECT_EQ(day(seen.days.refused, 3), 1);
  EXPECT_EQ(day(seen.days.visits, 2), 0);
  EXPECT_EQ(day(seen.days.visits, 0), 1);
  EXPECT_EQ(day(seen.days.stored, 0), 0);
  EXPECT_STREQ(day(seen.days.date, 3).data(), "2026-03-02");
  EXPECT_STREQ(day(seen.days.date, 0).data(), "2026-03-05");
  const ui::StatisticsView a_month_on = read.view(later + std::chrono::days(26));
  EXPECT_EQ(day(a_month_on.days.visits, 26), 1);
  EXPECT_EQ(std::accumulate(a_month_on.days.visits.begin(), a_month_on.days.visits.end(), 0.0F), 1)
      << "what is older is in the sum alone";
  EXPECT_EQ(a_month_on.visits, 2U);
  EXPECT_EQ(day(read.view(first).days.visits, 0), 1) << "a clock that was set back changes no day";
  EXPECT_FALSE(Statistics().read("1 2026-03-02 7"));
  EXPECT_FALSE(Statistics().read(counts.text().substr(0, counts.text().size() - 6)));
}

TEST(Statistics, WhoTurnsForTooLongIsNotRefused) {
  const std::chrono::sys_days day = std::chrono::year{2026} / 3 / 2;
  Statistics counts;
  counts.noted({State::Turn, Event::Timeout, State::Fuse}, nullptr, {}, day);
  counts.noted({State::Fuse, Event::StageDone, State::Review}, nullptr, {}, day);
  const ui::StatisticsView seen = counts.view(day);
  EXPECT_EQ(seen.models, 1U);
  EXPECT_EQ(std::accumulate(seen.refused.begin(), seen.refused.end(), std::uint64_t{0}), 0U);
}

}  // namespace
}  // namespace relievo::firmware
