// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The real kiosk whose camera is pulled in the middle of a capture, on a desk and as a device has it (bursts
// of a live device): the visitor's words and way on, what stays of the capture, and that the next visitor is
// served.
#include "tests/firmware/kiosk/staff_hands.h"
#include "tests/support/played_device.h"

namespace relievo::firmware {
namespace {

class KioskPulledTest : public StaffHands, public testing::WithParamInterface<bool> {
 protected:
  KioskPulledTest() {
    changes.live = GetParam();
    services.open_device = [this](std::string_view) -> Result<std::unique_ptr<hal::Device>> {
      auto device = std::make_unique<test::PlayedDevice>(world, tiny_rig().width_px, tiny_rig().height_px);
      played = device.get();
      return std::unique_ptr<hal::Device>(std::make_unique<ChangedDevice>(std::move(device), changes));
    };
  }
  void begin() {
    start();
    if (!changes.live) return;
    kiosk->turn();
    ASSERT_EQ(kiosk->ui().service().page, StaffPage::FirstStart);
    choose_pins();
    tap("sign out");
    ASSERT_TRUE(until([this] { return !kiosk->ui().service().open; }));
  }
  void stand(std::string_view name) {
    tap("start");
    tap("agree");
    kiosk->ui().visit().type(name);
    kiosk->turn();
    tap("done");
    ASSERT_TRUE(reach(ui::Step::Position));
    ASSERT_TRUE(until([this] { return kiosk->view().live.number > 0 && find("shoot") != nullptr; }));
    EXPECT_EQ(kiosk->appliance().session().subject(), name);
  }
  // The trigger has gone, the left picture is here, the right one is not.
  void shoot_half() {
    played->right_camera.held = true;
    tap("shoot");
    ASSERT_TRUE(until([this] { return kiosk->view().screen == ui::Screen::Capture; }));
    for (int turn = 0; turn < 20; ++turn) kiosk->turn();
    ASSERT_EQ(kiosk->view().screen, ui::Screen::Capture);
    (void)kiosk->take_forgotten();
  }
  void it_is_told_and_nothing_stays() {
    ASSERT_TRUE(reach(ui::Step::Trouble));
    EXPECT_EQ(kiosk->view().trouble, ui::Trouble::Camera);
    EXPECT_TRUE(says("A camera does not answer"));
    EXPECT_TRUE(says("tries again by itself")) << "the way on";
    EXPECT_FALSE(says("Grace"));
    EXPECT_EQ(kiosk->ui().visit().name(), "");
    EXPECT_EQ(kiosk->appliance().session().subject(), "");
    EXPECT_FALSE(kiosk->appliance().session().is_open());
    EXPECT_TRUE(kiosk->take_forgotten()) << "the renderer forgets, too";
    for (const auto& picture : kiosk->ui().draw_list().pictures) EXPECT_TRUE(picture.pixels.empty());
    EXPECT_EQ(kiosk->ui().draw_list().faces[0].model, nullptr);
  }
  // Time goes on as fast as a fault waits.
  bool later(const std::function<bool()>& reached) {
    return until([this, &reached] {
      if (kiosk->appliance().state() == State::Fault) world.ahead_s += 10;
      return reached();
    });
  }
  void the_next_one_is_served() {
    const auto away = [this] { return kiosk->appliance().state() == State::SelfTest; };
    ASSERT_TRUE(later(away));
    EXPECT_EQ(kiosk->ui().visit().step, ui::Step::Trouble) << "as long as it is away";
    world.pulled = false;
    played->right_camera.held = false;
    ASSERT_TRUE(later([this] { return kiosk->ui().visit().step == ui::Step::Attract; }));
    stand("Ada Byron");
  }

  test::PlayedWorld world;
  test::PlayedDevice* played = nullptr;
};

TEST_P(KioskPulledTest, BetweenTheShotAndTheHandOver) {
  begin();
  stand("Grace Hopper");
  shoot_half();
  world.pulled = true;
  it_is_told_and_nothing_stays();
  the_next_one_is_served();
}

TEST_P(KioskPulledTest, WhileThePicturesAreWorkedOn) {
  begin();
  stand("Grace Hopper");
  shoot_half();
  played->right_camera.held = false;
  ASSERT_TRUE(until([this] { return kiosk->view().screen != ui::Screen::Capture; }));
  world.pulled = true;  // nobody is on these pictures: the person would be asked to stand there again
  it_is_told_and_nothing_stays();
  the_next_one_is_served();
}

INSTANTIATE_TEST_SUITE_P(Devices, KioskPulledTest, testing::Bool(),
                         [](const auto& of) { return of.param ? "Live" : "Recorded"; });

}  // namespace
}  // namespace relievo::firmware
