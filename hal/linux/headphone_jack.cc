// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/linux/headphone_jack.h"

#include <linux/input.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace relievo::hal {
namespace {

constexpr int kInputDevices = 32;

using Switches = std::array<unsigned long, 1>;  // one bit each
static_assert(SW_MAX < 8 * sizeof(Switches));

bool has_headphones(Kernel& kernel, int file, unsigned long request) {
  Switches switches{};
  return call(kernel, file, request, switches.data()) >= 0 && (switches[0] >> SW_HEADPHONE_INSERT & 1U) != 0;
}

class LinuxHeadphoneJack final : public HeadphoneJack {
 public:
  LinuxHeadphoneJack(Kernel& kernel, std::vector<int> files) : kernel_(kernel), files_(std::move(files)) {}
  ~LinuxHeadphoneJack() override {
    for (const int file : files_) kernel_.close(file);
  }
  bool is_plugged() override {
    return std::ranges::any_of(
        files_, [this](int file) { return has_headphones(kernel_, file, EVIOCGSW(sizeof(Switches))); });
  }

 private:
  Kernel& kernel_;
  std::vector<int> files_;
};

}  // namespace

std::unique_ptr<HeadphoneJack> find_headphone_jack(Kernel& kernel) {
  std::vector<int> files;
  for (int i = 0; i < kInputDevices; ++i) {
    const int file = kernel.open(("/dev/input/event" + std::to_string(i)).c_str());
    if (file < 0) continue;
    if (has_headphones(kernel, file, EVIOCGBIT(EV_SW, sizeof(Switches)))) files.push_back(file);
    else kernel.close(file);
  }
  if (files.empty()) return nullptr;
  return std::make_unique<LinuxHeadphoneJack>(kernel, std::move(files));
}

}  // namespace relievo::hal
