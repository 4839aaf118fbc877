// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/memory/people.h"

#include <algorithm>
#include <cmath>

#include "hal/sim/replay/replay_device.h"
#include "tests/support/rig_calibration.h"
#include "tests/support/small_rig.h"

namespace relievo::test {
namespace {

using hal::sim::HeadPose;

constexpr double kScale = 0.3;
hal::sim::SimRig rig() { return hal::sim::make_rig(small_rig(kScale)); }

struct Stands {
  std::uint32_t person = 1;
  HeadPose pose;
};
const std::array<Stands, People::kMany> kPeople{{{4, {}},
                                                 {2, {.yaw_deg = 4}},
                                                 {7, {.pitch_deg = 4, .distance_mm = 585}},
                                                 {9, {.roll_deg = 5, .right_mm = 12}}}};

}  // namespace

People::People(std::size_t many) {
  ThreadPool pool(2);
  const auto photograph = [&](const std::shared_ptr<const hal::sim::HeadModel>& head, const HeadPose& pose) {
    const auto scene = hal::sim::make_head_scene(head, pose, pool);
    const hal::sim::LightPicture left = expose(*scene, rig().left, {}, pool);
    const hal::sim::LightPicture right = expose(*scene, rig().right, {}, pool);
    Rolls rolls;
    for (std::size_t roll = 0; roll < kRolls; ++roll)
      rolls[roll] = {read_sensor(left, {}, 2 * roll), read_sensor(right, {}, 2 * roll + 1)};
    return rolls;
  };
  for (std::size_t who = 0; who < many; ++who) {
    const auto head = hal::sim::make_head(hal::sim::traits_of(kPeople[who].person), pool);
    in_front_[who] = photograph(head, kPeople[who].pose);
    for (std::size_t yaw = 0; many == kMany && who == 0 && yaw < kYawsDeg.size(); ++yaw)
      turned_[yaw] = photograph(head, hal::sim::turned_about_neck(kPeople[who].pose, kYawsDeg[yaw]));
  }
}

pipeline::StereoCalibration People::calibration() const { return true_calibration(rig()); }

void People::turn(double yaw_deg) {
  const auto far = [&](double yaw) { return std::abs(yaw - yaw_deg); };
  yaw_ = std::size_t(std::ranges::min_element(kYawsDeg, {}, far) - kYawsDeg.begin());
}

class People::Source final : public hal::PairSource {
 public:
  explicit Source(const People& people) : people_(people) {}
  Result<Exposure> expose(Side side, std::uint32_t number) override {
    if (side == Side::Right && !people_.plugged_.load())
      return Error{Errc::Disconnected, "the plug was pulled"};
    const std::size_t yaw = people_.yaw_;
    const Rolls& rolls = yaw == 0 ? people_.in_front_[people_.person_] : people_.turned_[yaw];
    const hal::sim::PicturePair& pair = rolls[number % kRolls];
    return Exposure{side == Side::Left ? pair.left : pair.right, std::chrono::nanoseconds(0)};
  }

 private:
  const People& people_;
};

std::unique_ptr<hal::Device> People::device() {
  const hal::Picture& any = in_front_[0][0].left;
  return std::make_unique<hal::ReplayDevice>(
      "sim", std::make_unique<Source>(*this),
      hal::CaptureMode{any.width_px, any.height_px, std::chrono::microseconds(4000)}, true);
}

}  // namespace relievo::test
