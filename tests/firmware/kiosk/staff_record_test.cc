// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The technician's test capture, recorded on a stick through its page: folder:DIR gives back every bit of it,
// and what goes wrong has words, a way on, and leaves no half folder.
#include <cstring>
#include <random>

#include "hal/recording/capture_file.h"
#include "tests/firmware/kiosk/staff_hands.h"
#include "tests/support/faulty_stick.h"

namespace relievo::firmware {
namespace {

using test::FaultyStick;
using ui::Outcome;

class StaffRecordTest : public StaffHands {
 protected:
  StaffRecordTest() {
    changes.media = &faulty;
    std::mt19937 random(7);
    for (std::size_t side = 0; side < 2; ++side) {
      hal::Picture& noise = taken[side];
      noise.width_px = tiny_rig().width_px;
      noise.height_px = tiny_rig().height_px;
      noise.bytes.resize(std::size_t{3} * static_cast<std::size_t>(noise.width_px) *
                         static_cast<std::size_t>(noise.height_px));
      for (std::byte& byte : noise.bytes) byte = static_cast<std::byte>(random());
      EXPECT_TRUE(
          hal::write_picture(folder.path() / "pairs" / (side == 0 ? "left_000000.png" : "right_000000.png"),
                             noise.view())
              .has_value());
    }
  }
  const ui::TechnicianView& technician() const { return *kiosk->view().service->technician; }
  void capture() {
    start();
    if (!signed_in_before) first_start();
    signed_in_before = true;
    sign_in("4711", StaffRole::Technician);
    tap("open stages");
    EXPECT_EQ(find("record"), nullptr) << "nothing to be recorded yet";
    tap("capture");
    ASSERT_TRUE(until([this] { return find("record") != nullptr; })) << technician().problem.detail;
  }
  // The cameras are set while their page is open.
  void watch(bool brighter) {
    tap("back");
    tap("open cameras");
    ASSERT_TRUE(until([this] { return find("brighter") != nullptr && technician().cameras.watched; }));
    if (brighter) {
      tap("brighter");
      ASSERT_TRUE(until([this] { return technician().cameras.exposure_us > 4500; }));
    }
    tap("back");
    ASSERT_TRUE(until([this] { return !kiosk->staff().side_tasks().busy(JobLane::Capture); }));
    tap("open stages");
  }
  // Whose light can be set, and is 4000 us.
  void settable_cameras() {
    hal::CaptureFile pairs;
    pairs.frames.push_back({.exposure_us = 4000});
    ASSERT_TRUE(hal::write_capture_file(folder.path() / "pairs" / "capture.json", pairs));
    changes.settable = true;
  }
  std::int64_t recorded_us() {
    EXPECT_EQ(record(), Outcome::Done);
    const auto names = recordings_on(stick());
    if (names.size() != 1) return -1;
    const auto recorded = hal::read_capture_file(stick() / "captures" / names.front() / "capture.json");
    return recorded ? recorded->frames.front().exposure_us : -1;
  }
  Outcome record() { return use_stick("record"); }
  Outcome use_stick(const char* button) {
    tap(button);
    until([this] { return technician().recording.outcome != Outcome::None; });
    kiosk->turn();
    EXPECT_NE(find("record"), nullptr) << "the way on";
    return technician().recording.outcome;
  }
  static std::vector<std::string> recordings_on(const Path& root) { return names_on(root, "captures"); }
  static std::vector<std::string> names_on(const Path& root, const char* inside) {
    std::vector<std::string> names;
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(root / inside, none))
      names.push_back(entry.path().filename().string());
    return names;
  }
  // By the device that folder:DIR is.
  void is_replayed_bit_for_bit(const Path& recording) {
    auto made = hal::make_folder_device(recording);
    ASSERT_TRUE(made.has_value()) << made.error().what.view();
    hal::Device& device = **made;
    hal::Camera* const cameras[] = {&device.left(), &device.right()};
    for (hal::Camera* camera : cameras) ASSERT_TRUE(camera->open(device.preferred_mode()) && camera->start());
    ASSERT_TRUE(device.trigger().pulse(std::chrono::microseconds(100)).has_value());
    for (std::size_t side = 0; side < 2; ++side) {
      const auto frame = cameras[side]->next_frame(device.clock().now() + std::chrono::seconds(5));
      ASSERT_TRUE(frame.has_value());
      const hal::RawImage& seen = frame->raw();
      const hal::RawImage wanted = hal::raw_of(taken[side].view());
      ASSERT_EQ(seen.width_px, wanted.width_px);
      ASSERT_EQ(seen.height_px, wanted.height_px);
      ASSERT_EQ(seen.format, wanted.format);
      for (int y = 0; y < seen.height_px; ++y)
        ASSERT_EQ(std::memcmp(seen.bytes + y * seen.stride_bytes, wanted.bytes + y * wanted.stride_bytes,
                              static_cast<std::size_t>(3 * seen.width_px)),
                  0)
            << side << ' ' << y;
    }
  }
  FaultyStick faulty{stick()};
  std::unique_ptr<test::TinyDisk> disk;
  std::unique_ptr<FaultyStick> on_disk;
  std::array<hal::Picture, 2> taken;
  bool signed_in_before = false;
};

TEST_F(StaffRecordTest, WhatWasCapturedIsReplayedBitForBit) {
  capture();
  EXPECT_EQ(record(), Outcome::Done);
  const auto names = recordings_on(stick());
  ASSERT_EQ(names.size(), 1U);
  EXPECT_TRUE(says("captures/" + names.front())) << "where it lies";
  is_replayed_bit_for_bit(stick() / "captures" / names.front());
  EXPECT_EQ(record(), Outcome::NoStick) << "it was let go";
  EXPECT_TRUE(says("No stick is ready"));
}

TEST_F(StaffRecordTest, TheLightThatIsRecordedIsTheOneTheCaptureWasTakenIn) {
  settable_cameras();
  capture();
  watch(true);  // for the next one
  EXPECT_EQ(recorded_us(), 4000);
}

TEST_F(StaffRecordTest, TheLightOfTheCamerasStaysAsItWasSetWhenTheyAreWatchedAgain) {
  settable_cameras();
  capture();
  watch(true);
  watch(false);
  const std::uint32_t before = technician().model_number;
  tap("capture");
  ASSERT_TRUE(until([&] { return technician().can_record && technician().model_number > before; }));
  EXPECT_EQ(recorded_us(), 5040) << "a third of a stop";
}

TEST_F(StaffRecordTest, AStickThatIsPulledOutHasNoHalfRecording) {
  capture();
  faulty.fail(FaultyStick::Fault::Pulled);
  EXPECT_EQ(record(), Outcome::StickGone);
  EXPECT_TRUE(says("pulled out too early"));
  for (const std::string& name : recordings_on(stick().string() + " in a hand"))
    EXPECT_TRUE(name.starts_with('.')) << name << " could be taken for a recording";
  faulty.fail(FaultyStick::Fault::None);
  faulty.plug_in_again();
  EXPECT_EQ(record(), Outcome::Done);
  const auto names = recordings_on(stick());
  ASSERT_EQ(names.size(), 1U) << "what the pulled stick had kept is cleared away";
  is_replayed_bit_for_bit(stick() / "captures" / names.front());
}

// Of noise, in which no face is found: what there is of it.
TEST_F(StaffRecordTest, AReconstructionThatFailedIsSavedAndLoadedAsFarAsItCame) {
  capture();
  faulty.fail(FaultyStick::Fault::Pulled);
  EXPECT_EQ(use_stick("save"), Outcome::StickGone);
  for (const std::string& name : names_on(stick().string() + " in a hand", "reconstructions"))
    EXPECT_TRUE(name.starts_with('.')) << name << " could be taken for a document";
  faulty.fail(FaultyStick::Fault::None);
  faulty.plug_in_again();
  EXPECT_EQ(use_stick("save"), Outcome::Done);
  const auto names = names_on(stick(), "reconstructions");
  ASSERT_EQ(names.size(), 1U) << "what the pulled stick had kept is cleared away";
  EXPECT_TRUE(says("reconstructions/" + names.front())) << "where it lies";
  EXPECT_EQ(use_stick("list saved"), Outcome::NoStick) << "it was let go";

  faulty.plug_in_again();
  tap("capture");
  ASSERT_TRUE(until([this] { return find("list saved") != nullptr && technician().can_record; }));
  tap("stage 0");  // the pictures: there is nothing else
  const std::uint32_t before = technician().shown[0].version;
  tap("list saved");
  ASSERT_TRUE(until([this] { return find("saved 0") != nullptr; }));
  tap("saved 0");
  ASSERT_TRUE(until([this, before] {
    return technician().can_record && technician().shown[0].version != before;
  })) << technician().problem.detail;
  EXPECT_FALSE(technician().result.failure.empty());
  EXPECT_EQ(record(), Outcome::Done);
  is_replayed_bit_for_bit(stick() / "captures" / recordings_on(stick()).front());
}

TEST_F(StaffRecordTest, AStickThatGivesBackOtherBitsIsFoundOut) {
  capture();
  faulty.fail(FaultyStick::Fault::Forgets);
  EXPECT_EQ(record(), Outcome::StickBad);
  EXPECT_TRUE(says("does not keep"));
  EXPECT_TRUE(recordings_on(stick()).empty());
}

TEST_F(StaffRecordTest, WhoStopsItOrLeavesLeavesNothingHalfWritten) {
  capture();
  faulty.fail(FaultyStick::Fault::Waits);
  tap("record");
  ASSERT_TRUE(until([this] { return faulty.waits() && find("stop recording") != nullptr; }));
  tap("stop recording");
  faulty.let_go_on();
  ASSERT_TRUE(until([this] { return technician().recording.outcome != Outcome::None; }));
  EXPECT_EQ(technician().recording.outcome, Outcome::Cancelled);
  EXPECT_TRUE(recordings_on(stick()).empty());
  faulty.fail(FaultyStick::Fault::Waits);
  tap("record");
  ASSERT_TRUE(until([this] { return faulty.waits(); }));
  tap("sign out");
  ASSERT_TRUE(until([this] { return kiosk->appliance().state() == State::Idle; }))
      << "a slow stick holds nobody";
  EXPECT_FALSE(kiosk->appliance().session().is_open());
  faulty.let_go_on();
  kiosk.reset();
  EXPECT_TRUE(recordings_on(stick()).empty());
}

TEST_F(StaffRecordTest, AFullStickAndAWriteProtectedOneAreNamedSo) {
  disk = std::make_unique<test::TinyDisk>(std::size_t{150}
                                          << 10);  // less than one picture of noise and its partner
  if (!disk->mounted()) GTEST_SKIP() << disk->why_not();
  on_disk = std::make_unique<FaultyStick>(disk->path());
  changes.media = on_disk.get();
  capture();
  EXPECT_EQ(record(), Outcome::StickFull);
  EXPECT_TRUE(says("no room left"));
  EXPECT_TRUE(recordings_on(disk->path()).empty());
  ASSERT_TRUE(disk->protect(true));
  EXPECT_EQ(record(), Outcome::StickLocked);
  EXPECT_TRUE(says("write-protected"));
  ASSERT_TRUE(disk->protect(false));
}

}  // namespace
}  // namespace relievo::firmware
