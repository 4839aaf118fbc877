// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Watchdog and stick over a played kernel: armed, kicked, put to rest; flushed before it is unmounted; every
// refusal in words.
#include <gtest/gtest.h>
#include <linux/watchdog.h>

#include <cerrno>
#include <functional>
#include <future>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "hal/linux/device.h"
#include "hal/linux/mounted_stick.h"
#include "tests/hal/temporary_folder.h"

namespace relievo::hal {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

class HandClock final : public Clock {
 public:
  Instant at = Instant{} + seconds(9);
  Instant now() const override { return at; }
  std::chrono::system_clock::time_point wall_now() const override { return {}; }
};

// A watchdog device that bites when nobody has kicked it for its time.
class DogKernel final : public Kernel {
 public:
  explicit DogKernel(HandClock& clock) : clock_(clock) {}
  std::map<unsigned long, int> refuses;  // of the next such call, an errno
  int open_error = 0, own_seconds = 60, kicks = 0, open_files = 0;
  bool armed = false;
  bool bites() const { return armed && clock_.at - heard_ > seconds(own_seconds); }

  int open(const char*) override {
    if (open_error != 0) return -std::exchange(open_error, 0);
    armed = true;
    heard_ = clock_.at;
    ++open_files;
    return 3;
  }
  int close(int) override { return --open_files, 0; }
  int ioctl(int, unsigned long request, void* argument) override {
    if (const auto refused = refuses.find(request); refused != refuses.end()) {
      const int error = refused->second;
      if (error == EINTR) refuses.erase(refused);
      return -error;
    }
    int& value = *static_cast<int*>(argument);
    if (request == WDIOC_SETTIMEOUT) own_seconds = value;
    if (request == WDIOC_GETTIMEOUT) value = own_seconds;
    if (request == WDIOC_SETOPTIONS && value == WDIOS_DISABLECARD) armed = false;
    if (request == WDIOC_KEEPALIVE) heard_ = clock_.at, ++kicks;
    return 0;
  }
  void* map(int, std::size_t, std::uint32_t) override { return nullptr; }
  void unmap(void*, std::size_t) override {}
  int poll(int, int) override { return 0; }
  std::string serial_of(const char*) override { return {}; }

 private:
  HandClock& clock_;
  Instant heard_{};
};

TEST(HardwareWatchdog, BitesWhoStopsKickingAndNobodyElse) {
  HandClock clock;
  DogKernel kernel(clock);
  auto dog = open_hardware_watchdog({"/dev/watchdog", seconds(10)}, kernel, clock);
  ASSERT_TRUE(dog);
  EXPECT_EQ(kernel.own_seconds, 10);
  for (int i = 0; i < 3000; ++i, clock.at += milliseconds(20)) {
    (*dog)->kick();
    ASSERT_FALSE(kernel.bites());
  }
  EXPECT_NEAR(kernel.kicks, 60 / 2.5,
              2);  // the loop turns 50 times a second, the device hears it four times in its time
  clock.at += seconds(11);
  EXPECT_TRUE(kernel.bites());
  dog->reset();
  EXPECT_FALSE(kernel.armed);
  EXPECT_EQ(kernel.open_files, 0);
}

TEST(HardwareWatchdog, SaysWhyItCannotBeUsedAndLeavesNothingArmed) {
  HandClock clock;
  const std::pair<int, Errc> opens[] = {{ENOENT, Errc::NotFound},
                                        {ENODEV, Errc::NotFound},
                                        {EBUSY, Errc::IoFailed},
                                        {EACCES, Errc::IoFailed},
                                        {EIO, Errc::IoFailed}};
  for (const auto& [number, code] : opens) {
    DogKernel kernel(clock);
    kernel.open_error = number;
    const auto dog = open_hardware_watchdog({}, kernel, clock);
    ASSERT_FALSE(dog) << number;
    EXPECT_EQ(dog.error().code, code) << number;
    EXPECT_EQ(dog.error().sys_errno, number);
  }
  DogKernel strict(clock);
  strict.refuses[WDIOC_SETTIMEOUT] = EINVAL;
  const auto refused = open_hardware_watchdog({}, strict, clock);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::InvalidInput);
  EXPECT_FALSE(strict.armed);
  EXPECT_EQ(strict.open_files, 0);
  DogKernel none(clock);
  EXPECT_FALSE(open_hardware_watchdog({"", seconds(10)}, none, clock));
  EXPECT_FALSE(open_hardware_watchdog({"/dev/watchdog", seconds(1)}, none, clock));
  EXPECT_FALSE(none.armed);
}

TEST(HardwareWatchdog, ADriverMayHaveATimeOfItsOwnAndSignalsInterrupt) {
  HandClock clock;
  DogKernel kernel(clock);
  kernel.open_error = EINTR;
  kernel.refuses[WDIOC_SETTIMEOUT] = EOPNOTSUPP;
  kernel.refuses[WDIOC_GETTIMEOUT] = EINTR;
  const auto dog = open_hardware_watchdog({}, kernel, clock);
  ASSERT_TRUE(dog);
  for (const int later : {0, 7, 7, 1}) {
    clock.at += seconds(later);
    (*dog)->kick();
  }
  EXPECT_EQ(kernel.kicks, 2) << "four in the 60 seconds that it waits";
  DogKernel hasty(clock);
  hasty.own_seconds = 1;
  hasty.refuses[WDIOC_SETTIMEOUT] = EOPNOTSUPP;
  EXPECT_FALSE(open_hardware_watchdog({}, hasty, clock));
  EXPECT_FALSE(hasty.armed);
}

class PlayedMounts final : public Mounts {
 public:
  std::set<std::string> mounted;
  std::vector<std::string> calls;
  std::function<void()> while_flushing;
  int flush_result = 0, unmount_result = 0;
  bool is_mounted(const std::filesystem::path& folder) override { return mounted.contains(folder.native()); }
  int flush(const std::filesystem::path& folder) override {
    if (while_flushing) while_flushing();
    return calls.push_back("flush " + folder.native()), flush_result;
  }
  int unmount(const std::filesystem::path& folder) override {
    calls.push_back("unmount " + folder.native());
    if (unmount_result == 0) mounted.erase(folder.native());
    return unmount_result;
  }
  int mount_result = 0;
  std::optional<MountSource> source_of(const std::filesystem::path& folder) override {
    return mounted.contains(folder.native()) ? std::optional(MountSource{"/dev/sdx1", "vfat"}) : std::nullopt;
  }
  int mount_read_only(const MountSource& source, const std::filesystem::path& folder) override {
    calls.push_back("mount " + source.type + " " + source.device + " " + folder.native());
    if (mount_result == 0) mounted.insert(folder.native());
    return mount_result;
  }
};

TEST(MountedStick, IsTakenUpAgainWhereItWasOnceForEveryEjection) {
  const TemporaryFolder folder;
  const std::string root = folder.path().native();
  PlayedMounts mounts;
  MountedStick stick(root, mounts);
  EXPECT_EQ(stick.take_up_again().error().code, Errc::MediaMissing) << "nothing was ejected";
  mounts.mounted.insert(root);
  ASSERT_TRUE(stick.flush_and_eject());
  ASSERT_TRUE(stick.take_up_again());
  EXPECT_EQ(mounts.calls.back(), "mount vfat /dev/sdx1 " + root);
  ASSERT_TRUE(stick.current());
  EXPECT_TRUE(stick.is_taken_up()) << "nobody has plugged it";
  ASSERT_TRUE(stick.flush_and_eject());
  EXPECT_FALSE(stick.current());
  mounts.mounted.insert(root);
  ASSERT_TRUE(stick.current());
  EXPECT_FALSE(stick.is_taken_up()) << "another, by a hand";
  ASSERT_TRUE(stick.flush_and_eject());
  ASSERT_TRUE(stick.take_up_again());
  mounts.mounted.erase(root);  // pulled out
  EXPECT_FALSE(stick.current());
  mounts.mounted.insert(root);
  ASSERT_TRUE(stick.current());
  EXPECT_FALSE(stick.is_taken_up());
  for (const auto& [refused, code] :
       {std::pair{-ENXIO, Errc::MediaMissing}, std::pair{-ENOENT, Errc::MediaMissing},
        std::pair{-EPERM, Errc::Unsupported}, std::pair{-EIO, Errc::Unsupported}}) {
    mounts.mounted.insert(root);
    mounts.mount_result = refused;
    ASSERT_TRUE(stick.flush_and_eject());
    EXPECT_EQ(stick.take_up_again().error().code, code) << refused;
    EXPECT_EQ(stick.take_up_again().error().code, Errc::MediaMissing) << "it is asked for once";
  }
}

TEST(MountedStick, FindsItsDeviceInTheTableOfTheKernel) {
  constexpr std::string_view kTable =
      "24 1 8:2 / / rw,relatime shared:1 - ext4 /dev/sda2 rw\n"
      "88 24 8:17 / /media/relievo/MY\\040STICK rw,nosuid,nodev shared:7 master:3 - vfat /dev/sdb1 rw,uid=1000\n"
      "89 24 8:33 / /media/relievo rw - exfat /dev/sdc1 rw\n"
      "90 24 8:34 / /media/relievo rw - ext4 /dev/sdc2 rw\n"
      "91 24 cut off\n";
  const auto stick = source_in(kTable, "/media/relievo/MY STICK");
  ASSERT_TRUE(stick);
  EXPECT_EQ(stick->device, "/dev/sdb1");
  EXPECT_EQ(stick->type, "vfat");
  EXPECT_EQ(source_in(kTable, "/media/relievo")->device, "/dev/sdc2") << "the newest lies on top";
  EXPECT_FALSE(source_in(kTable, "/media"));
  EXPECT_TRUE(real_mounts().source_of("/proc")) << "the real table is read";
}

TEST(MountedStick, IsSeenFlushedThenUnmounted) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "A");
  std::filesystem::create_directory(folder / "B");
  PlayedMounts mounts;
  MountedStick stick(folder.path(), mounts);
  EXPECT_FALSE(stick.current());
  EXPECT_EQ(stick.flush_and_eject().error().code, Errc::MediaMissing);
  const std::string own = (folder / "B").native();
  mounts.mounted.insert(own);
  ASSERT_TRUE(stick.current());
  EXPECT_EQ(*stick.current(), own);
  ASSERT_TRUE(stick.flush_and_eject());
  EXPECT_EQ(mounts.calls, (std::vector<std::string>{"flush " + own, "unmount " + own}));
  EXPECT_FALSE(stick.current());
}

// The main thread asks, and kicks the watchdog: a slow stick must not hold it.
TEST(MountedStick, WhoAsksForAStickThatIsBeingFlushedDoesNotWait) {
  const TemporaryFolder folder;
  const std::string root = folder.path().native();
  PlayedMounts mounts;
  mounts.mounted.insert(root);
  MountedStick stick(root, mounts);
  std::future<bool> asked;
  bool answered = false;
  mounts.while_flushing = [&] {
    asked = std::async(std::launch::async, [&] { return stick.current().has_value(); });
    answered = asked.wait_for(seconds(10)) == std::future_status::ready;
  };
  ASSERT_TRUE(stick.flush_and_eject());
  EXPECT_TRUE(answered);
  EXPECT_TRUE(asked.get() || !answered) << "it is still there";
}

TEST(MountedStick, WhatIsNotFlushedIsNotUnmountedAndNothingIsPromised) {
  const TemporaryFolder folder;
  const std::string root = folder.path().native();
  for (const auto& [flushed, unmounted, code] :
       {std::tuple{-EIO, 0, Errc::IoFailed}, std::tuple{-ENOENT, 0, Errc::MediaMissing},
        std::tuple{0, -EBUSY, Errc::IoFailed}, std::tuple{0, -EPERM, Errc::IoFailed},
        std::tuple{0, -EINVAL, Errc::MediaMissing}}) {
    PlayedMounts mounts;
    mounts.mounted.insert(root);
    mounts.flush_result = flushed, mounts.unmount_result = unmounted;
    const auto ejected = MountedStick(root, mounts).flush_and_eject();
    ASSERT_FALSE(ejected);
    EXPECT_EQ(ejected.error().code, code) << flushed << " " << unmounted;
    EXPECT_EQ(mounts.calls.size(), flushed < 0 ? 1U : 2U);
  }
}

TEST(MountedStick, TheRealTableTellsAMountFromAFolder) {
  const TemporaryFolder folder;
  EXPECT_FALSE(real_mounts().is_mounted(folder.path()));
  EXPECT_FALSE(real_mounts().is_mounted("/nowhere"));
  EXPECT_TRUE(real_mounts().is_mounted("/proc"));
  EXPECT_EQ(real_mounts().flush("/nowhere"), -ENOENT);
  EXPECT_FALSE(MountedStick("/nowhere").current());
}

}  // namespace
}  // namespace relievo::hal
