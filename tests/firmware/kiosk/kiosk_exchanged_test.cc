// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The real kiosk before which other cameras are plugged in than its calibration was made with: at the start
// and while it runs. What visitors are told, what the technician reads, and that it serves again with the
// right camera, or the right calibration.
#include "tests/firmware/kiosk/staff_hands.h"
#include "tests/support/played_device.h"
#include "tests/support/rig_calibration.h"

namespace relievo::firmware {
namespace {

class KioskExchangedTest : public StaffHands {
 protected:
  KioskExchangedTest() {
    services.open_device = [this](std::string_view) {
      auto device = std::make_unique<test::PlayedDevice>(world, tiny_rig().width_px, tiny_rig().height_px);
      played = device.get();
      played->left_camera.number = "L1";
      played->right_camera.number = right;
      return std::unique_ptr<hal::Device>(std::make_unique<ChangedDevice>(std::move(device), changes));
    };
    services.simulated_calibration = {};
    auto store = storage::open_sqlite_store(args.store, clock, {});
    EXPECT_TRUE(store.has_value());
    pipeline::StereoCalibration rig = test::true_calibration(hal::sim::make_rig(tiny_rig()));
    rig.cameras = {"serial L1", "serial R2"};
    EXPECT_TRUE((*store)->save_calibration(rig, "with the other right camera").has_value());
    rig.cameras = {"serial L1", "serial R1"};
    EXPECT_TRUE((*store)->save_calibration(rig, "in use").has_value());
  }
  void open(const char* right_number) {
    right = right_number;
    auto opened = Kiosk::open(args, services);
    ASSERT_TRUE(opened.has_value()) << opened.error().what.view();
    kiosk = std::move(*opened);
    kiosk->ui().resize(1280, 800);
  }
  // Another is in its place when it is plugged in again.
  void replug(const char* number) {
    world.pulled = true;
    ASSERT_TRUE(later([this] { return kiosk->appliance().cameras() != CameraWatch::Well; }))
        << "that it is gone is noticed";
    played->right_camera.number = number;
    world.pulled = false;
  }
  bool later(const std::function<bool()>& reached) {
    return until([this, &reached] {
      if (kiosk->ui().visit().step == ui::Step::Trouble) world.ahead_s += 1;
      return reached();
    });
  }
  void visitors_are_told() {
    ASSERT_TRUE(later([this] {
      return kiosk->appliance().state() == State::Idle &&
             kiosk->view().out_of_order == ui::Trouble::Calibration;
    }));
    ASSERT_TRUE(reach(ui::Step::Trouble));
    EXPECT_TRUE(says("need adjusting"));
    EXPECT_EQ(find("start"), nullptr);
    EXPECT_EQ(find("finish"), nullptr) << "nobody passes by";
  }

  test::PlayedWorld world;
  test::PlayedDevice* played = nullptr;
  std::string right = "R1";
};

TEST_F(KioskExchangedTest, AtTheStartItIsToldAndTheCalibrationOfThatCameraServes) {
  open("R2");
  visitors_are_told();
  first_start();
  sign_in("4711", StaffRole::Technician);
  tap("open calibrate");
  for (const char* words : {"the right camera", "serial", "R1", "R2", "calibrate again"})
    EXPECT_TRUE(says(words)) << words;
  const auto& technician = [this]() -> const ui::TechnicianCalibration& {
    return kiosk->view().service->technician->calibration;
  };
  ASSERT_TRUE(until([&] { return technician().history_count == 2; }));
  tap(technician().history[0].active ? "calibration 1" : "calibration 0");
  ASSERT_TRUE(until([this] { return kiosk->view().out_of_order == ui::Trouble::None; }))
      << technician().problem.detail;
  EXPECT_FALSE(says("R2"));
  sign_out();
  EXPECT_TRUE(reach(ui::Step::Attract));
}

TEST_F(KioskExchangedTest, PluggedInWhileItRunsItIsToldAndTheRightOneServesAgain) {
  open("R1");
  ASSERT_TRUE(reach(ui::Step::Attract));
  // A visitor poses while the camera is pulled: that is how it is noticed.
  tap("start");
  tap("agree");
  kiosk->ui().visit().type("Ada");
  kiosk->turn();
  tap("done");
  ASSERT_TRUE(reach(ui::Step::Position));
  replug("R2");
  visitors_are_told();
  EXPECT_EQ(kiosk->ui().visit().name(), "");
  EXPECT_FALSE(kiosk->appliance().session().is_open());
  replug("R1");
  EXPECT_TRUE(later([this] { return kiosk->ui().visit().step == ui::Step::Attract; })) << "by itself";
}

}  // namespace
}  // namespace relievo::firmware
