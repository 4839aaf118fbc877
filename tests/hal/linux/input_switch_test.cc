// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/linux/device.h"

#include <gtest/gtest.h>
#include <linux/input.h>

#include <cerrno>
#include <map>
#include <set>
#include <string>

namespace relievo::hal {
namespace {

// Input devices by their number: what switches each has, and which are on.
class InputKernel final : public Kernel {
 public:
  struct Device {
    unsigned long has = 0, on = 0;
    int error = 0;
  };
  std::map<int, Device> devices;
  std::set<int> opened;
  int interruptions = 0;

  int open(const char* path) override {
    if (interruptions > 0) return --interruptions, -EINTR;
    const int number = std::stoi(std::string(path).substr(std::string("/dev/input/event").size()));
    if (!devices.contains(number)) return -ENOENT;
    opened.insert(100 + number);
    return 100 + number;
  }
  int close(int file) override { return opened.erase(file) == 1 ? 0 : -EBADF; }
  int ioctl(int file, unsigned long request, void* argument) override {
    if (interruptions > 0) return --interruptions, -EINTR;
    const Device& device = devices.at(file - 100);
    if (device.error != 0) return -device.error;
    auto& bits = *static_cast<unsigned long*>(argument);
    if (request == EVIOCGBIT(EV_SW, sizeof bits)) return bits = device.has, 0;
    if (request == EVIOCGSW(sizeof bits)) return bits = device.on, 0;
    return -EINVAL;
  }
  void* map(int, std::size_t, std::uint32_t) override { return nullptr; }
  void unmap(void*, std::size_t) override {}
  int poll(int, int) override { return 0; }
  std::string serial_of(const char*) override { return {}; }
};

constexpr unsigned long kLid = 1UL << SW_LID, kHeadphones = 1UL << SW_HEADPHONE_INSERT,
                        kNear = 1UL << SW_FRONT_PROXIMITY;

TEST(InputSwitch, FollowsTheSwitchOfTheDeviceThatHasOne) {
  InputKernel kernel;
  kernel.devices[0] = {kLid, kLid};
  kernel.devices[7] = {kHeadphones, 0};
  {
    const auto jack = find_headphone_jack(kernel);
    ASSERT_NE(jack, nullptr);
    EXPECT_EQ(kernel.opened, std::set{107}) << "the lid's is closed again";
    EXPECT_FALSE(jack->is_on()) << "the lid is none";
    kernel.devices[7].on = kHeadphones;
    EXPECT_TRUE(jack->is_on());
    kernel.interruptions = 3;
    EXPECT_TRUE(jack->is_on()) << "a signal in the middle";
    kernel.devices[7].on = 0;
    EXPECT_FALSE(jack->is_on());
    kernel.devices[7] = {kHeadphones, kHeadphones, ENODEV};
    EXPECT_FALSE(jack->is_on()) << "a device that is gone is not private";
  }
  EXPECT_TRUE(kernel.opened.empty());
}

TEST(InputSwitch, EitherOfTwoIsEnough) {
  InputKernel kernel;
  kernel.devices[1] = {kHeadphones | kLid, 0};
  kernel.devices[31] = {kHeadphones, kHeadphones};
  const auto jack = find_headphone_jack(kernel);
  ASSERT_NE(jack, nullptr);
  EXPECT_TRUE(jack->is_on());
}

TEST(InputSwitch, ASignalWhileItIsOpenedHidesNone) {
  InputKernel kernel;
  kernel.devices[0] = {kHeadphones, kHeadphones};
  kernel.interruptions = 3;
  EXPECT_NE(find_headphone_jack(kernel), nullptr);
}

TEST(InputSwitch, APresenceSensorIsNoHeadphoneJack) {
  InputKernel kernel;
  kernel.devices[2] = {kHeadphones, kHeadphones};
  EXPECT_EQ(find_presence_sensor(kernel), nullptr);
  kernel.devices[5] = {kNear, 0};
  const auto sensor = find_presence_sensor(kernel);
  ASSERT_NE(sensor, nullptr);
  EXPECT_FALSE(sensor->is_on());
  kernel.devices[5].on = kNear;
  EXPECT_TRUE(sensor->is_on());
}

TEST(InputSwitch, WithoutOneThereIsNone) {
  InputKernel kernel;
  EXPECT_EQ(find_headphone_jack(kernel), nullptr);
  kernel.devices[0] = {kLid, kLid | kHeadphones};
  kernel.devices[1] = {kHeadphones, kHeadphones, EACCES};
  EXPECT_EQ(find_headphone_jack(kernel), nullptr);
  EXPECT_TRUE(kernel.opened.empty());
}

}  // namespace
}  // namespace relievo::hal
