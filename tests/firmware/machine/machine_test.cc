// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rows: time, event, expected state.
#include "firmware/machine/machine.h"

#include <gtest/gtest.h>

#include <set>
#include <string_view>
#include <vector>

#include "firmware/base/budget.h"
#include "tests/firmware/machine/event_names.h"
#include "ui/device/settings.h"
#include "ui/view/visit.h"

namespace relievo::firmware {
namespace {

using std::chrono::milliseconds;
using S = State;
using E = Event;

struct Row {
  milliseconds at{0};
  E event = E::Count;  // Count: only time passes
  S expected = S::Count;
};

void play(const std::vector<Row>& rows) {
  const hal::Instant boot{};
  Machine machine(boot);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Row& row = rows[i];
    (void)machine.tick(boot + row.at);
    if (row.event != E::Count) (void)machine.handle(row.event, boot + row.at);
    ASSERT_EQ(machine.state(), row.expected) << "row " << i << ": " << name_of(row.event) << " led to "
                                             << name_of(machine.state()) << ", not " << name_of(row.expected);
  }
}

milliseconds ms(int n) { return milliseconds(n); }

TEST(Machine, EveryStateAndEventHasANameOfItsOwn) {
  std::set<std::string_view> names;
  for (int s = 0; s < static_cast<int>(S::Count); ++s) names.insert(name_of(static_cast<S>(s)));
  EXPECT_EQ(names.size(), static_cast<std::size_t>(S::Count));
  names.clear();
  for (int e = 0; e < static_cast<int>(E::Count); ++e) names.insert(name_of(static_cast<E>(e)));
  EXPECT_EQ(names.size(), static_cast<std::size_t>(E::Count));
  EXPECT_EQ(name_of(S::Count), "?");
  EXPECT_EQ(name_of(E::Count), "?");
}

TEST(Machine, OnlyWaitingForSomebodyToComeLastsForEver) {
  for (int s = 0; s <= static_cast<int>(S::Count); ++s) {
    const auto state = static_cast<S>(s);
    EXPECT_EQ(limit_of(state).has_value(), state != S::Idle && state != S::Count) << name_of(state);
  }
  Machine machine(hal::Instant{});
  EXPECT_FALSE(machine.handle(E::Accept, hal::Instant{})) << "what nobody listens to changes nothing";
  EXPECT_EQ(machine.state(), S::SelfTest);
}

TEST(Machine, OneEnrolment) {
  play({{ms(0), E::Passed, S::Idle},
        {ms(10), E::Begin, S::Capture},
        {ms(20), E::Triggered, S::Match},
        {ms(30), E::StageDone, S::Reconstruct},
        {ms(40), E::StageDone, S::Mesh},
        {ms(50), E::StageDone, S::Texture},
        {ms(50), E::StageDone, S::Assemble},
        {ms(60), E::StageDone, S::Review},
        {ms(70), E::Accept, S::Store},
        {ms(80), E::StageDone, S::Idle}});
}

TEST(Machine, RetakeAndAdviceLeadBackToCapture) {
  play({{ms(0), E::Passed, S::Idle},
        {ms(1), E::Begin, S::Capture},
        {ms(2), E::StageFailed, S::Capture},
        {ms(3), E::Triggered, S::Match},
        {ms(4), E::StageFailed, S::Capture},
        {ms(5), E::Triggered, S::Match},
        {ms(6), E::StageDone, S::Reconstruct},
        {ms(7), E::StageFailed, S::Capture},
        {ms(8), E::Triggered, S::Match},
        {ms(9), E::StageDone, S::Reconstruct},
        {ms(10), E::StageDone, S::Mesh},
        {ms(11), E::StageDone, S::Texture},
        {ms(11), E::StageDone, S::Assemble},
        {ms(12), E::StageDone, S::Review},
        {ms(13), E::Retake, S::Capture}});
}

TEST(Machine, APersonAtTheScreenFindsTheirPlaceFirst) {
  play({{ms(0), E::Passed, S::Idle},
        {ms(1), E::PoseAsked, S::Position},
        {ms(2), E::Begin, S::Capture},
        {ms(3), E::Triggered, S::Match},
        {ms(4), E::AdviceGiven, S::Position},
        {ms(5), E::Begin, S::Capture},
        {ms(6), E::AdviceGiven, S::Position},
        {ms(7), E::Begin, S::Capture},
        {ms(8), E::Triggered, S::Match},
        {ms(9), E::StageDone, S::Reconstruct},
        {ms(10), E::AdviceGiven, S::Position},
        {ms(11), E::StageFailed, S::Idle}});
}

TEST(Machine, WhoIsStillThereGetsTheWholeTimeAgain) {
  const hal::Instant boot{};
  Machine machine(boot);
  (void)machine.handle(E::Passed, boot);
  (void)machine.handle(E::PoseAsked, boot);
  const milliseconds most = budget::kPositionLimit - ms(1);
  machine.renew(boot + most);
  EXPECT_FALSE(machine.tick(boot + most + most));
  EXPECT_TRUE(machine.tick(boot + most + budget::kPositionLimit));
  (void)machine.handle(E::PoseAsked, boot);
  (void)machine.handle(E::Begin, boot);
  machine.renew(boot + budget::kCaptureLimit);  // a machine's own work gets no more time for that
  EXPECT_TRUE(machine.tick(boot + budget::kCaptureLimit));
}

TEST(Machine, AStateThatWaitsForAPersonOutlastsWhatItsPageWaits) {
  const auto most = [](ui::Setting setting) {
    return std::chrono::seconds(std::ranges::max(ui::info_of(setting).values));
  };
  for (const S state : {S::Position, S::Review})
    EXPECT_GT(*limit_of(state), most(ui::Setting::PatienceS) + ui::kLastCall) << name_of(state);
  EXPECT_GT(*limit_of(S::Staff), most(ui::Setting::StaffPatienceS));
}

TEST(Machine, AFullDiskLeadsBackToReview) {
  play({{ms(0), E::Passed, S::Idle},
        {ms(1), E::Begin, S::Capture},
        {ms(2), E::Triggered, S::Match},
        {ms(3), E::StageDone, S::Reconstruct},
        {ms(4), E::StageDone, S::Mesh},
        {ms(5), E::StageDone, S::Texture},
        {ms(5), E::StageDone, S::Assemble},
        {ms(6), E::StageDone, S::Review},
        {ms(7), E::Accept, S::Store},
        {ms(8), E::StageFailed, S::Review},
        {ms(9), E::Accept, S::Store},
        {ms(10), E::Cancel, S::Store},
        {ms(11), E::StageDone, S::Idle}});
}

TEST(Machine, NoAnswerIsNoConsent) {
  play({{ms(0), E::Passed, S::Idle},
        {ms(0), E::Begin, S::Capture},
        {ms(0), E::Triggered, S::Match},
        {ms(0), E::StageDone, S::Reconstruct},
        {ms(0), E::StageDone, S::Mesh},
        {ms(0), E::StageDone, S::Texture},
        {ms(0), E::StageDone, S::Assemble},
        {ms(0), E::StageDone, S::Review},
        {budget::kReviewLimit - ms(1), E::Count, S::Review},
        {budget::kReviewLimit, E::Count, S::Idle},
        {budget::kReviewLimit + ms(1), E::Accept, S::Idle}});
}

TEST(Machine, AHeadThatTurnsIsFusedHoweverTheTurningEnds) {
  for (const E end : {E::StageDone, E::Count})  // Count: nothing but time
    play({{ms(0), E::Passed, S::Idle},
          {ms(0), E::PoseAsked, S::Position},
          {ms(0), E::Begin, S::Capture},
          {ms(0), E::TurnAsked, S::Turn},
          {end == E::Count ? budget::kTurnLimit : ms(1), end, S::Fuse},
          {budget::kTurnLimit + ms(1), E::StageDone, S::Review}});
  EXPECT_EQ(next(S::Turn, E::AdviceGiven), S::Position) << "the frontal picture was no good";
  EXPECT_EQ(next(S::Fuse, E::AdviceGiven), S::Position);
}

TEST(Machine, AnotherTryGetsItsTimeAnew) {
  const milliseconds most = budget::kCaptureLimit - ms(1);
  play({{ms(0), E::Passed, S::Idle},
        {ms(0), E::Begin, S::Capture},
        {most, E::StageFailed, S::Capture},
        {most + most, E::Count, S::Capture},
        {most + budget::kCaptureLimit, E::Count, S::Idle}});
}

TEST(Machine, AFaultTestsItselfAgain) {
  play({{ms(0), E::Failed, S::Fault},
        {budget::kFaultRetry, E::Count, S::SelfTest},
        {budget::kFaultRetry, E::Passed, S::Idle},
        {budget::kFaultRetry, E::StaffIn, S::Staff},
        {budget::kFaultRetry, E::CalibrateAsked, S::Calibrate},
        {budget::kFaultRetry, E::StageFailed, S::Staff},
        {budget::kFaultRetry, E::ExportAsked, S::Export},
        {budget::kFaultRetry, E::Cancel, S::Staff},
        {budget::kFaultRetry, E::StaffOut, S::Idle}});
}

// The answer of every state to the three events nobody may forget.
struct Answer {
  S state;
  S cancel, timeout, failed;
};

TEST(Machine, EveryStateAnswersCancelTimeoutAndFailure) {
  const std::vector<Answer> answers{
      {S::SelfTest, S::SelfTest, S::Fault, S::Fault}, {S::Idle, S::Idle, S::Idle, S::Fault},
      {S::Position, S::Idle, S::Idle, S::Fault},      {S::Capture, S::Idle, S::Idle, S::Fault},
      {S::Turn, S::Idle, S::Fuse, S::Fault},          {S::Fuse, S::Idle, S::Idle, S::Fault},
      {S::Match, S::Idle, S::Idle, S::Fault},         {S::Reconstruct, S::Idle, S::Idle, S::Fault},
      {S::Mesh, S::Idle, S::Idle, S::Fault},          {S::Texture, S::Idle, S::Idle, S::Fault},
      {S::Assemble, S::Idle, S::Idle, S::Fault},      {S::Review, S::Idle, S::Idle, S::Fault},
      {S::Store, S::Store, S::Fault, S::Fault},       {S::Staff, S::Idle, S::Idle, S::Fault},
      {S::Calibrate, S::Staff, S::Staff, S::Fault},   {S::Export, S::Staff, S::Staff, S::Fault},
      {S::Fault, S::Fault, S::SelfTest, S::Fault}};
  ASSERT_EQ(answers.size(), static_cast<std::size_t>(S::Count));
  for (const Answer& a : answers) {
    EXPECT_EQ(next(a.state, E::Cancel).value_or(a.state), a.cancel) << name_of(a.state);
    EXPECT_EQ(next(a.state, E::Timeout).value_or(a.state), a.timeout) << name_of(a.state);
    EXPECT_EQ(next(a.state, E::Failed).value_or(a.state), a.failed) << name_of(a.state);
  }
}

TEST(Machine, EveryStateWithATimeoutHasALimit) {
  for (std::size_t s = 0; s < static_cast<std::size_t>(S::Count); ++s) {
    const auto state = static_cast<S>(s);
    EXPECT_EQ(next(state, E::Timeout).has_value(), limit_of(state).has_value()) << name_of(state);
  }
}

TEST(Machine, RandomEventsNeverLeaveTheTable) {
  const hal::Instant boot{};
  Machine machine(boot);
  unsigned seed = 1;
  for (int i = 0; i < 100'000; ++i) {
    seed = seed * 1664525u + 1013904223u;
    const S before = machine.state();
    const auto event = static_cast<E>((seed >> 16) % static_cast<unsigned>(E::Count));
    const auto change = machine.handle(event, boot);
    ASSERT_EQ(machine.state(), change ? *next(before, event) : before);
  }
}

TEST(Machine, EveryStateAndEventHasAName) {
  for (std::size_t s = 0; s < static_cast<std::size_t>(S::Count); ++s)
    EXPECT_NE(name_of(static_cast<S>(s)), "?");
  for (std::size_t e = 0; e < static_cast<std::size_t>(E::Count); ++e)
    EXPECT_NE(name_of(static_cast<E>(e)), "?");
}

}  // namespace
}  // namespace relievo::firmware
