// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/linux/device.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "tests/hal/temporary_folder.h"
#include "tests/support/kernel/v4l2_fake_kernel.h"

namespace relievo::hal {
namespace {

constexpr const char* kModeText = "[mode]\nwidth_px = 32\nheight_px = 48\nexposure_us = 4000\n";
constexpr const char* kTwo =
    "[left]\ndevice = \"/dev/a\"\nserial = \"L\"\n[right]\ndevice = \"/dev/b\"\nformat = \"GREY\"\n";
constexpr const char* kWires =
    "[trigger]\nchip = \"/dev/gpiochip0\"\nline = 17\ndelay_us = 20\n[lamp]\nline = 18\nlead_us = 200\n";

Result<LinuxDeviceOptions> read(const std::string& text) {
  const TemporaryFolder folder;
  std::ofstream(folder / "board.toml") << text;
  return read_linux_device_file(folder / "board.toml");
}

TEST(LinuxDeviceFile, SaysWhatIsWiredWhere) {
  const auto options = read(std::string(kModeText) + kTwo + kWires);
  ASSERT_TRUE(options) << options.error().where();
  EXPECT_EQ(options->mode.width_px, 32);
  EXPECT_EQ(options->mode.exposure, std::chrono::microseconds(4000));
  EXPECT_EQ(options->left.device, "/dev/a");
  EXPECT_EQ(options->left.serial, "L");
  EXPECT_TRUE(options->left.triggered);
  ASSERT_TRUE(options->right && options->trigger);
  EXPECT_EQ(options->right->fourcc, 0x59455247U);
  EXPECT_EQ(options->trigger->trigger, 17U);
  EXPECT_EQ(options->trigger->lamp, 18U);
  EXPECT_EQ(options->timing.delay, std::chrono::microseconds(20));
  EXPECT_EQ(options->timing.lamp_lead, std::chrono::microseconds(200));
}

TEST(LinuxDeviceFile, StickAndWatchdogMayBeLeftOut) {
  const auto bare = read(std::string(kModeText) + kTwo);
  ASSERT_TRUE(bare);
  EXPECT_TRUE(bare->stick_folder.empty() && !bare->watchdog);
  const auto options = read(std::string(kModeText) + kTwo +
                            "[stick]\nfolder = \"/media/relievo\"\n[watchdog]\ntimeout_s = 30\n");
  ASSERT_TRUE(options) << options.error().where();
  EXPECT_EQ(options->stick_folder, "/media/relievo");
  EXPECT_EQ(options->watchdog.value_or(WatchdogOptions{}).timeout, std::chrono::seconds(30));
}

TEST(LinuxDeviceFile, WithoutATriggerTheCamerasRunFree) {
  const auto options = read(std::string(kModeText) + kTwo);
  ASSERT_TRUE(options);
  EXPECT_FALSE(options->trigger);
  EXPECT_FALSE(options->left.triggered);
}

TEST(LinuxDeviceFile, WhatIsWrongIsNamedByItsLine) {
  const std::string good = std::string(kModeText) + kTwo;
  const std::pair<std::string, const char*> cases[] = {
      {"[mode\n", "line 1"},
      {kTwo, "[mode]"},
      {kModeText, "[left]"},
      {std::string(kModeText) + "[left]\ndevice = \"/dev/a\"\n", "[both]"},
      {good + "[both]\ndevice = \"/dev/c\"\n", "[both]"},
      {good + "[flash]\nline = 1\n", "flash"},
      {good + "[lamp]\nline = 1\n", "[trigger]"},
      {good + "[trigger]\nchip = \"/dev/x\"\n", "line 11: line"},
      {good + "[trigger]\nchip = 3\nline = 1\n", "chip"},
      {good + "[trigger]\nchip = \"/dev/x\"\nline = -1\n", "line"},
      {good + "[trigger]\nchip = \"/dev/x\"\nline = 1\ndelay_us = 999999\n", "delay_us"},
      {good + "[trigger]\nchip = \"/dev/x\"\nline = 1\n[lamp]\nline = 2\nlead_us = 200\ntime_us = 150\n",
       "time_us"},
      {good + "[trigger]\nchip = \"/dev/x\"\nline = 1\n[lamp]\nline = 2\non_trigger_wire = true\n",
       "on_trigger_wire"},
      {"[mode]\nwidth_px = 3\nheight_px = 48\n" + std::string(kTwo), "width_px"},
      {"[mode]\nwidth_px = 32.5\nheight_px = 48\n" + std::string(kTwo), "width_px"},
      {std::string(kModeText) + "[left]\ndevice = \"/dev/a\"\n[right]\ndevice = \"/dev/a\"\n", "same"},
      {std::string(kModeText) +
           "[left]\ndevice = \"/dev/a\"\nformat = \"MONO12\"\n[right]\ndevice = \"/dev/b\"\n",
       "format"},
      {std::string(kModeText) + "[both]\ndevice = \"\"\n", "device"},
      {std::string(kModeText) + "[both]\ndevice = \"video0\"\n", "device"},
      {std::string(kModeText) + "[both]\ndevice = \"/dev/a\\nb\\u001b[31m\"\n", "device"},
      {good + "[trigger]\nchip = \"gpiochip0\"\nline = 1\n", "chip"},
      {good + "[watchdog]\ndevice = \"watchdog\"\n", "device"},
      {"mode = 3\n" + std::string(kTwo), "mode"},
      {good + "[stick]\nfolder = \"media\"\n", "folder"},
      {good + "[watchdog]\ntimeout_s = 1\n", "timeout_s"},
  };
  for (const auto& [text, word] : cases) {
    const auto options = read(text);
    ASSERT_FALSE(options) << text;
    EXPECT_EQ(options.error().code, Errc::InvalidInput);
    EXPECT_NE(options.error().where().find(word), std::string_view::npos)
        << options.error().where() << " | " << word;
  }
  EXPECT_EQ(read_linux_device_file("/nowhere/board.toml").error().code, Errc::NotFound);
}

TEST(LinuxDevice, ATriggerThatIsNotThereIsToldBeforeACameraOpens) {
  FakeKernel kernel;
  auto options = read(std::string(kModeText) + kTwo + kWires);
  ASSERT_TRUE(options);
  options->trigger->chip = "/nowhere/gpiochip9";
  EXPECT_EQ(make_linux_device(*options, kernel).error().code, Errc::NotFound);
  EXPECT_EQ(kernel.calls(KernelCall::Open), 0);
}

TEST(LinuxDevice, OneDeviceGivesBothViewsTogetherWithoutAWire) {
  FakeKernel kernel;
  const auto options = read(std::string(kModeText) + "[both]\ndevice = \"/dev/c\"\n");
  ASSERT_TRUE(options) << options.error().where();
  const auto made = make_linux_device(*options, kernel);
  ASSERT_TRUE(made);
  Device& device = **made;
  EXPECT_EQ(device.name(), "linux");
  EXPECT_TRUE(device.exposes_together());
  EXPECT_TRUE(device.trigger().pulse(std::chrono::microseconds(100)));
  for (Camera* camera : {&device.left(), &device.right()}) {
    ASSERT_TRUE(camera->open(device.preferred_mode()));
    const auto limits = camera->exposure_limits();
    EXPECT_TRUE(!limits || camera->set_exposure(limits->least));
    ASSERT_TRUE(camera->start());
  }
  EXPECT_EQ(device.left().serial(), device.right().serial()) << "it is one device";
  EXPECT_EQ(kernel.open_files, 1);
  kernel.expose({3});
  const Instant soon = device.clock().now() + std::chrono::seconds(5);
  const auto left = device.left().next_frame(soon);
  const auto right = device.right().next_frame(soon);
  ASSERT_TRUE(left && right);
  EXPECT_EQ(left->raw().width_px, 32);
}

TEST(LinuxDevice, TwoCamerasWithoutAWireDoNotExposeTogether) {
  FakeKernel kernel;
  const auto made = make_linux_device(*read(std::string(kModeText) + kTwo), kernel);
  ASSERT_TRUE(made);
  EXPECT_FALSE((*made)->exposes_together());
  EXPECT_NE(&(*made)->left(), &(*made)->right());
  EXPECT_FALSE((*made)->media().current());
  EXPECT_EQ((*made)->media().flush_and_eject().error().code, Errc::MediaMissing);
  EXPECT_EQ((*made)->shot_light(), Light::Off);
  EXPECT_FALSE((*made)->trigger().pulse(std::chrono::microseconds(100), Light::Flash)) << "no wire, no lamp";
  (*made)->watchdog().kick();
}

}  // namespace
}  // namespace relievo::hal
