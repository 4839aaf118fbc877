// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/linux/device.h"

#include <linux/input.h>

#include <algorithm>
#include <array>
#include <vector>

namespace relievo::hal {
namespace {

constexpr int kInputDevices = 32;

using Switches = std::array<unsigned long, 1>;  // one bit each
static_assert(SW_MAX < 8 * sizeof(Switches));

bool has(Kernel& kernel, int file, unsigned long request, int code) {
  Switches switches{};
  return call(kernel, file, request, switches.data()) >= 0 && (switches[0] >> code & 1U) != 0;
}

class LinuxInputSwitch final : public InputSwitch {
 public:
  LinuxInputSwitch(Kernel& kernel, std::vector<int> files, int code)
      : kernel_(kernel), files_(std::move(files)), code_(code) {}
  ~LinuxInputSwitch() override {
    for (const int file : files_) kernel_.close(file);
  }
  bool is_on() override {
    return std::ranges::any_of(
        files_, [this](int file) { return has(kernel_, file, EVIOCGSW(sizeof(Switches)), code_); });
  }

 private:
  Kernel& kernel_;
  std::vector<int> files_;
  int code_;
};

std::unique_ptr<InputSwitch> find(Kernel& kernel, int code) {
  std::vector<int> files;
  for (int i = 0; i < kInputDevices; ++i) {
    const std::string path = "/dev/input/event" + std::to_string(i);
    const int file = open_device(kernel, path.c_str());
    if (file < 0) continue;
    if (has(kernel, file, EVIOCGBIT(EV_SW, sizeof(Switches)), code)) files.push_back(file);
    else kernel.close(file);
  }
  if (files.empty()) return nullptr;
  return std::make_unique<LinuxInputSwitch>(kernel, std::move(files), code);
}

}  // namespace

std::unique_ptr<InputSwitch> find_headphone_jack(Kernel& kernel) { return find(kernel, SW_HEADPHONE_INSERT); }

std::unique_ptr<InputSwitch> find_presence_sensor(Kernel& kernel) { return find(kernel, SW_FRONT_PROXIMITY); }

}  // namespace relievo::hal
