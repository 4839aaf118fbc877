// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// People: who stands before the small simulated rig, photographed before anybody comes, so that a visit costs
// no rendering; and a device that shows them. Thread: shows and plug any; the device as hal/device.h says.
#pragma once

#include <array>
#include <atomic>
#include <memory>

#include "hal/device.h"
#include "hal/sim/render.h"
#include "pipeline/model/calibration.h"

namespace relievo::test {

class People {
 public:
  static constexpr std::size_t kMany = 4;  // each stands in another way
  // So many of them, of all the first also turned: a second or two each.
  explicit People(std::size_t many);
  pipeline::StereoCalibration calibration() const;
  // Shows them as long as this lives.
  std::unique_ptr<hal::Device> device();
  void shows(std::size_t person) { person_ = person, yaw_ = 0; }
  void turn(double yaw_deg);             // to the nearest side that was photographed
  void plug(bool in) { plugged_ = in; }  // the right camera

 private:
  class Source;
  static constexpr std::array kYawsDeg{0.0, -25.0, 25.0, -45.0, 45.0};
  static constexpr std::size_t kRolls = 2;  // of noise
  using Rolls = std::array<hal::sim::PicturePair, kRolls>;
  std::array<Rolls, kMany> in_front_;
  std::array<Rolls, kYawsDeg.size()> turned_;
  std::atomic<std::size_t> person_{0}, yaw_{0};
  std::atomic<bool> plugged_{true};
};

}  // namespace relievo::test
