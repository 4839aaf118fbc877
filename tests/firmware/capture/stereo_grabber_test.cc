// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cameras that fail on purpose: what a person and a technician are told in each case, and what is counted.
#include "firmware/capture/stereo_grabber.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/firmware/capture/grabber_fixture.h"
#include "tests/support/allocation_counter.h"

namespace relievo::firmware {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

TEST_F(StereoGrabberTest, CopiesEachPictureOnceAndReturnsTheBufferAtOnce) {
  int held_while_waiting = 0;
  right.on_wait = [&] { held_while_waiting += left.held; };
  const auto pair = grabber.grab(slot, cancelled);
  ASSERT_TRUE(pair);
  EXPECT_EQ(held_while_waiting, 0) << "the left driver waits for its buffer while the right camera exposes";
  EXPECT_EQ(line.pulses, 1);
  EXPECT_EQ(pair->skew_ns, 10'000);
  EXPECT_EQ(pair->sequence, 1U);
  EXPECT_EQ(pair->left.bytes, memory.data());
  EXPECT_EQ(pair->left.stride_bytes, 8);
  EXPECT_EQ(left.held + right.held, 0);
  EXPECT_EQ(grabber.counts().pairs, 1U);
}

TEST_F(StereoGrabberTest, NothingIsAllocatedBetweenTriggerAndHandOver) {
  ASSERT_TRUE(grabber.grab(slot, cancelled));
  const AllocationCounter counter;
  const auto pair = grabber.grab(slot, cancelled);
  EXPECT_EQ(counter.made(), 0);
  EXPECT_TRUE(pair);
}

TEST_F(StereoGrabberTest, APairTooFarApartIsRefusedCountedAndTakenAgain) {
  right.script = {Fault::Apart};
  expect_pair_of_pulse(2);
  EXPECT_EQ(grabber.counts().apart, 1U);
}

TEST_F(StereoGrabberTest, CamerasThatNeverExposeTogetherAreAnError) {
  right.script.assign(budget::kGrabTries, Fault::Apart);
  EXPECT_EQ(error_of_grab(), Errc::Timeout);
  EXPECT_EQ(line.pulses, budget::kGrabTries);
  EXPECT_EQ(grabber.counts().apart, std::uint64_t{budget::kGrabTries});
  EXPECT_EQ(grabber.counts().pairs, 0U);
}

TEST_F(StereoGrabberTest, TheLimitIsInclusiveAndConfigurable) {
  StereoGrabber exact(left, right, line, clock, {true, microseconds(10)});
  EXPECT_TRUE(exact.grab(slot, cancelled));
  StereoGrabber strict(left, right, line, clock, {true, microseconds(9)});
  EXPECT_FALSE(strict.grab(slot, cancelled));
}

TEST_F(StereoGrabberTest, NoPictureIsATimeoutAndTheStreamsStartAnew) {
  left.script = {Fault::Miss};
  const hal::Instant begin = clock.now();
  EXPECT_EQ(error_of_grab(), Errc::Timeout);
  EXPECT_GE(clock.now() - begin, budget::kFrameWait);
  EXPECT_EQ(of_left().missing, 1U);
  EXPECT_EQ(left.starts, 2);
  EXPECT_EQ(right.starts, 2);
  expect_pair_of_pulse(2);
}

TEST_F(StereoGrabberTest, AFrameThatComesAfterTheNextPulseIsNotTakenForIt) {
  right.script = {Fault::None, Fault::Hold};
  expect_pair_of_pulse(1);
  ASSERT_TRUE(
      line.pulse(microseconds(100)));  // pulse 2: right withholds its frame, left's stays in the queue
  expect_pair_of_pulse(3);
  EXPECT_EQ(of_left().late, 1U);
  EXPECT_EQ(grabber.counts().right.late, 1U);
}

TEST_F(StereoGrabberTest, ALostFrameIsCountedByItsNumber) {
  expect_pair_of_pulse(1);
  left.sequence += 3;  // the driver had no buffer three times
  right.sequence += 3;
  expect_pair_of_pulse(2);
  EXPECT_EQ(of_left().lost, 3U);
  EXPECT_EQ(grabber.counts().slipped, 0U);
}

TEST_F(StereoGrabberTest, AFrameThatANewerOneOvertookIsLateAndNotLost) {
  expect_pair_of_pulse(1);
  for (const std::uint32_t before : {3, 2, 1}) {  // 4 comes, then 3 and 2, all before the pulse
    left.sequence = before;
    left.pulse(9, clock.now());
  }
  left.sequence = 4;
  clock.time += milliseconds(50);
  expect_pair_of_pulse(2);
  EXPECT_EQ(of_left().late, 3U);
  EXPECT_EQ(of_left().lost, 0U);
}

TEST_F(StereoGrabberTest, ACameraThatMissedAPulseIsNoticedByItsNumbers) {
  expect_pair_of_pulse(1);
  right.sequence += 1;
  expect_pair_of_pulse(2);
  EXPECT_EQ(grabber.counts().slipped, 1U);
  expect_pair_of_pulse(3);
  EXPECT_EQ(grabber.counts().slipped, 1U);
}

TEST_F(StereoGrabberTest, TheSequenceMayWrapAround) {
  left.sequence = right.sequence = 0xFFFF'FFFE;
  for (int i = 1; i <= 4; ++i) expect_pair_of_pulse(i);
  EXPECT_EQ(of_left().lost + of_left().late + of_left().duplicate, 0U);
}

TEST_F(StereoGrabberTest, AFrameThatComesTwiceIsTakenOnce) {
  left.script = {Fault::Twice};
  expect_pair_of_pulse(1);
  expect_pair_of_pulse(2);
  EXPECT_EQ(of_left().duplicate, 1U);
}

TEST_F(StereoGrabberTest, DamagedAndShortFramesAreRefusedAndTakenAgain) {
  left.script = {Fault::Damage, Fault::Short};
  expect_pair_of_pulse(3);
  EXPECT_EQ(of_left().damaged, 1U);
  EXPECT_EQ(of_left().too_short, 1U);
  right.script.assign(budget::kGrabTries, Fault::Damage);
  EXPECT_EQ(error_of_grab(), Errc::IoFailed);
  expect_pair_of_pulse(7);
}

TEST_F(StereoGrabberTest, ADriversErrorRestartsTheStreams) {
  right.script.assign(budget::kGrabTries, Fault::Fail);
  EXPECT_EQ(error_of_grab(), Errc::IoFailed);
  EXPECT_EQ(right.starts, 2);
  expect_pair_of_pulse(budget::kGrabTries + 1);
}

TEST_F(StereoGrabberTest, ViewsOfDifferentSizesAreRefused) {
  right.width_px = 6;
  EXPECT_EQ(error_of_grab(), Errc::InvalidInput);
}

TEST_F(StereoGrabberTest, APictureLargerThanItsRoomIsRefused) {
  std::vector<std::byte> small(7 * 8 * 2);
  StereoSlot narrow{small};
  const auto pair = grabber.grab(narrow, cancelled);
  ASSERT_FALSE(pair);
  EXPECT_EQ(pair.error().code, Errc::InvalidInput);
  EXPECT_EQ(left.held + right.held, 0);
}

TEST_F(StereoGrabberTest, ABrokenTriggerIsTold) {
  line.broken = true;
  EXPECT_EQ(error_of_grab(), Errc::IoFailed);
}

TEST_F(StereoGrabberTest, CancelEndsTheWait) {
  cancelled.store(true);
  EXPECT_EQ(error_of_grab(), Errc::Cancelled);
  cancelled.store(false);
  expect_pair_of_pulse(2);
}

TEST_F(StereoGrabberTest, WipeLeavesNoPixel) {
  ASSERT_TRUE(grabber.grab(slot, cancelled));
  slot.wipe();
  for (const std::byte b : memory) ASSERT_EQ(b, std::byte{0});
}

// Cameras that run on their own, 33 ms a frame, the right one 5 ms behind; their pulse moves time only.
TEST_F(StereoGrabberTest, WithoutATriggerTheNearestFramesArePaired) {
  StereoGrabber free(left, right, line, clock, {false, microseconds(6000)});
  const hal::Instant now = clock.now();
  left.script.assign(1, Fault::Miss);
  right.script.assign(1, Fault::Miss);
  int waits = 0;
  left.on_wait = [&] {
    ++waits;
    if (waits == 1) left.pulse(1, now + milliseconds(30));
    if (waits == 2) left.pulse(2, now + milliseconds(63));
  };
  right.on_wait = [&] { right.pulse(2, now + milliseconds(68)); };
  const auto pair = free.grab(slot, cancelled);
  ASSERT_TRUE(pair) << pair.error().what.view();
  EXPECT_EQ(pair->skew_ns, 5'000'000);
  EXPECT_EQ(pair->left.row(0)[0], 2);
  EXPECT_EQ(free.counts().apart, 1U);
}

// Whatever fails, and in whatever order: no pair of two pulses is ever handed over, and a buffer never kept.
TEST_F(StereoGrabberTest, OfTwentyThousandPulsesWithFaultsNoPairIsMixed) {
  std::mt19937 random(1);
  const auto any_fault = [&] { return random() % 4 == 0 ? static_cast<Fault>(random() % 11) : Fault::None; };
  std::uint64_t good = 0;
  while (line.pulses < 20'000) {
    if (left.script.empty()) left.script.push_back(any_fault());
    if (right.script.empty()) right.script.push_back(any_fault());
    const auto pair = grabber.grab(slot, cancelled);
    ASSERT_EQ(left.held + right.held, 0);
    if (pair) {
      ++good;
      ASSERT_EQ(pair->left.row(3)[3], line.pulses % 256);
      ASSERT_EQ(pair->right.row(3)[3], line.pulses % 256);
      ASSERT_LE(std::abs(pair->skew_ns), 100'000);
      continue;
    }
    left.plugged = right.plugged = true;
    while (!grabber.start(kMode)) clock.time += milliseconds(100);
  }
  EXPECT_EQ(grabber.counts().pairs, good);
  EXPECT_GT(good, 10'000U);
  for (const CameraCounts* c : {&grabber.counts().left, &grabber.counts().right})
    for (const std::uint64_t n :
         {c->late, c->lost, c->duplicate, c->damaged, c->too_short, c->missing, c->vanished})
      EXPECT_GT(n, 50U);
  EXPECT_EQ(grabber.counts().left.vanished, grabber.counts().left.returned);
}

// Two halves of one camera stop when neither is wanted: a stream that broke must end before it begins anew.
TEST_F(StereoGrabberTest, AfterAnErrorBothStreamsStopBeforeEitherBegins) {
  int beside_the_other = 0;
  left.on_start = [&] { beside_the_other += right.state() == hal::Camera::State::Running; };
  right.script = {Fault::Miss, Fault::Miss, Fault::Miss};
  EXPECT_EQ(error_of_grab(), Errc::Timeout);
  EXPECT_EQ(left.starts, 2);
  EXPECT_EQ(right.starts, 2);
  EXPECT_EQ(beside_the_other, 0);
}

// A lamp on the trigger's wire: every pair is a flash, whoever asks for it.
TEST_F(StereoGrabberTest, WaitsForTheRestOfALampOnTheTriggersWire) {
  line.lamp_on_it = true;
  for (int i = 1; i <= 12; ++i) expect_pair_of_pulse(i);
}

TEST_F(StereoGrabberTest, WhoCancelsWhileALampRestsTakesNoPictureAndStopsNoStream) {
  line.lamp_on_it = true;
  expect_pair_of_pulse(1);
  StereoGrabber left_alone(left, right, line, clock,
                           {.wait = [this](hal::Instant, const std::atomic<bool>&) { cancelled = true; }});
  const auto pair = left_alone.grab(slot, cancelled);
  ASSERT_FALSE(pair);
  EXPECT_EQ(pair.error().code, Errc::Cancelled);
  EXPECT_EQ(line.pulses, 1);
  EXPECT_EQ(left.starts, 1);
}

}  // namespace
}  // namespace relievo::firmware
