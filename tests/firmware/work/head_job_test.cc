// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The pairs of a head that turns, from the capture thread to the head of all of them: with stages that do as
// the test says.
#include "firmware/work/jobs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <thread>

#include "hal/clock.h"
#include "tests/firmware/played_appliance.h"

namespace relievo::firmware {
namespace {

constexpr int kPairWidth = 4, kPairHeight = 3;

// A pair of one grey value, with rows that are longer than their pixels.
class Pair {
 public:
  explicit Pair(int grey, int width = kPairWidth)
      : bytes_(static_cast<std::size_t>(kPairHeight * (3 * width + 5))) {
    std::fill(bytes_.begin(), bytes_.end(), static_cast<std::byte>(grey));
    const ImageView view{bytes_.data(), width, kPairHeight, 3 * width + 5, PixelFormat::Rgb8};
    frame = {view, view};
  }
  pipeline::StereoFrame frame;

 private:
  std::vector<std::byte> bytes_;
};

class HeadJobTest : public testing::Test {
 protected:
  HeadJobTest() {
    std::fill(const_cast<std::byte*>(memory.all().data()),
              const_cast<std::byte*>(memory.all().data() + memory.all().size()), std::byte{0});
    EXPECT_TRUE(session.open("Ada"));
    session.sides().begin();
    session.products().frame = front.frame;
  }
  SidePairs& sides() { return session.sides(); }
  const pipeline::FaceModel* model() const {
    const auto& made = session.products().model;
    return made ? &*made : nullptr;
  }

  BootMemory memory{2 * 7 * 16, 1 << 16, 1 << 16, 10 * 400, 64};
  EnrolmentSession session{memory};
  Pair front{1};
  TestStages stages;
  ThreadPool pool{1};
  hal::MonotonicClock clock;
  HeadJob job{stages, session, pool, clock};
  std::atomic<bool> cancelled{false};
  pipeline::Progress progress;
  JobControl control{cancelled, progress};
};

TEST_F(HeadJobTest, PairsAreHandedOnInTheirOrderAsTheyWere) {
  for (const int grey : {11, 12, 13}) ASSERT_TRUE(sides().add(Pair(grey).frame));
  EXPECT_EQ(sides().count(), 3U);
  for (const int grey : {11, 12, 13}) {
    const auto pair = sides().next(cancelled);
    ASSERT_TRUE(pair);
    EXPECT_EQ(pair->left.stride_bytes, 3 * kPairWidth);
    EXPECT_EQ(pair->left.row(kPairHeight - 1)[3 * kPairWidth - 1], grey);
    EXPECT_EQ(pair->right.row(0)[0], grey);
  }
  std::thread later([this] {
    std::this_thread::sleep_for(milliseconds(20));
    (void)sides().add(Pair(14).frame);
    sides().end();
  });
  const auto last = sides().next(cancelled);
  later.join();
  ASSERT_TRUE(last);
  EXPECT_EQ(last->left.row(0)[0], 14);
  EXPECT_FALSE(sides().next(cancelled)) << "no more come";
  EXPECT_EQ(sides().add(Pair(15).frame).error().code, Errc::InvalidState);
}

TEST_F(HeadJobTest, PicturesThatAreTooLargeAreRefusedAndNothingIsLeftBehind) {
  EXPECT_EQ(sides().add(Pair(9, 100).frame).error().code, Errc::OutOfMemory);
  ASSERT_TRUE(sides().add(Pair(21).frame));
  ASSERT_TRUE(sides().next(cancelled));
  (void)sides().kept(1).allocate(64, 1);
  session.close();
  EXPECT_TRUE(std::all_of(memory.sides().begin(), memory.sides().end(),
                          [](std::byte b) { return b == std::byte{0}; }));
}

TEST_F(HeadJobTest, WithoutSidesTheFaceIsThatOfTheFront) {
  sides().end();
  ASSERT_TRUE(job.run(control));
  ASSERT_NE(model(), nullptr);
  EXPECT_EQ(stages.ran, "MaReMeTeAs");
  EXPECT_EQ(stages.measured, 0);
  EXPECT_EQ(job.records().size(), kStages.size());
  EXPECT_EQ(job.parts_done(), PortraitProgress::kFuse) << "stages, sides and all";
}

TEST_F(HeadJobTest, EverySideComesIntoTheHead) {
  for (const int grey : {1, 2}) ASSERT_TRUE(sides().add(Pair(grey).frame));
  sides().end();
  ASSERT_TRUE(job.run(control));
  EXPECT_EQ(stages.measured, 3) << "the front's pose, too";
  EXPECT_EQ(model()->quality.width_mm, 3) << "poses in the head";
  EXPECT_EQ(job.records().back().name, "Fuse");
}

TEST_F(HeadJobTest, WhatIsWrongWithASideSpoilsNoFace) {
  for (const int grey : {1, 2, 3}) ASSERT_TRUE(sides().add(Pair(grey).frame));
  sides().end();
  stages.pose_errors = {Errc::Cancelled, Errc::NoFace};  // the front's is well, the first side's is not
  ASSERT_TRUE(job.run(control));
  EXPECT_EQ(model()->quality.width_mm, 3);
}

TEST_F(HeadJobTest, SidesThatHadNoFrontToJoinAreToldAsLeftOut) {
  for (const int grey : {1, 2}) ASSERT_TRUE(sides().add(Pair(grey).frame));
  sides().end();
  stages.pose_errors = {Errc::NoFace, Errc::NoFace};  // the front's, for either side
  ASSERT_TRUE(job.run(control));
  ASSERT_NE(model(), nullptr);
  EXPECT_EQ(model()->poses_left_out, 2);
}

TEST_F(HeadJobTest, PosesThatDoNotMeetLeaveTheFaceAsItWas) {
  ASSERT_TRUE(sides().add(Pair(1).frame));
  sides().end();
  stages.fuse_error = Errc::PoorGeometry;
  ASSERT_TRUE(job.run(control));
  ASSERT_NE(model(), nullptr);
  EXPECT_EQ(model()->quality.width_mm, 0);
}

TEST_F(HeadJobTest, EyesThatWereNotAliveWhileTheHeadTurnedSpoilTheFaceToo) {
  ASSERT_TRUE(sides().add(Pair(1).frame));
  sides().end();
  stages.fuse_error = Errc::NoFace;
  const Result<void> done = job.run(control);
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, Errc::NoFace);
}

TEST_F(HeadJobTest, AFrontThatIsNoFaceIsAnErrorAtOnce) {
  stages.errors = {{State::Mesh, Errc::PoorGeometry}};
  const Result<void> done = job.run(control);
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, Errc::PoorGeometry);
}

TEST_F(HeadJobTest, StopsWhileItWaitsForASide) {
  std::thread later([this] {
    std::this_thread::sleep_for(milliseconds(20));
    cancelled = true;
  });
  const Result<void> done = job.run(control);
  later.join();
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, Errc::Cancelled);
}

}  // namespace
}  // namespace relievo::firmware
