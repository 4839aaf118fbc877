// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A panel that is mounted a quarter turn off, corrected through the page by fingers it reports wrongly; and
// every way in which that goes wrong leaves the screen as it was.
#include "firmware/service/touch_trial.h"
#include "tests/firmware/kiosk/staff_hands.h"

namespace relievo::firmware {
namespace {

using ui::TouchVerdict;

class StaffTouchTest : public StaffHands {
 protected:
  StaffTouchTest() { changes.clock = &time; }
  // A finger on the glass, in shares of the picture: what the turned panel makes of it.
  void press(float x, float y) {
    if (kiosk->ui().has_just_come(kiosk->view().now)) let_it_stand();
    const float w = static_cast<float>(kiosk->ui().width_px()),
                h = static_cast<float>(kiosk->ui().height_px());
    for (const auto kind : {ui::Input::Kind::Down, ui::Input::Kind::Up})
      kiosk->feed({kind, 7, (1 - y) * w, x * h});
    kiosk->turn();
  }
  void press(std::string_view id, float beside = 0) {
    const ui::Node* node = find(id);
    ASSERT_NE(node, nullptr) << id;
    press((node->rect.x + node->rect.w / 2) / static_cast<float>(kiosk->ui().width_px()) + beside,
          (node->rect.y + node->rect.h / 2) / static_cast<float>(kiosk->ui().height_px()) - beside);
  }
  const ui::TouchView& seen() const { return *kiosk->view().service->touch; }
  // With a mouse, which no panel turns.
  void open_page() {
    finger = ui::kMouse;
    start();
    first_start();
    sign_in("4711", StaffRole::Technician);
    tap("open touch");
  }
  hal::ManualClock time;
};

TEST_F(StaffTouchTest, ATurnedPanelIsCorrectedAndStaysSo) {
  open_page();
  tap("begin");
  for (const float beside : {0.004F, -0.004F, 0.003F, -0.003F}) press("cross", beside);
  ASSERT_EQ(seen().step, ui::TouchStep::Test);
  EXPECT_NEAR(std::abs(seen().fit->turned_deg), 90, 2);
  EXPECT_FALSE(seen().fit->mirrored);
  press("cross");
  EXPECT_EQ(seen().verdict, TouchVerdict::Kept);
  press("back");
  EXPECT_EQ(kiosk->ui().service().page, StaffPage::Menu) << "fingers do what they show";
  tap("open touch");
  EXPECT_NE(find("plain"), nullptr) << "a mouse is where it is";
  tap("back");
  sign_out();
  kiosk.reset();

  start();
  press("start");
  EXPECT_EQ(kiosk->ui().visit().step, ui::Step::Consent);
  kiosk.reset();
  auto store = storage::open_sqlite_store(args.store, time, {});
  const auto kept = ui::parse_touch_map(*(*store)->setting(kTouchSetting));
  ASSERT_TRUE(kept.has_value());
  EXPECT_NEAR(kept->m[1], 1, 0.03);
}

TEST_F(StaffTouchTest, WhateverGoesWrongTheScreenStaysAsItWas) {
  open_page();
  const auto unchanged = [this] {
    return !seen().corrected && kiosk->ui().service().page == StaffPage::Touch;
  };
  // Nobody goes on: somebody whose fingers do nothing any more waits.
  tap("begin");
  press("cross");
  time.advance(kTouchPatience + std::chrono::seconds(1));
  kiosk->turn();
  kiosk->turn();
  EXPECT_EQ(seen().verdict, TouchVerdict::NobodyTouched);
  EXPECT_TRUE(unchanged());
  // One cross is missed.
  tap("begin");
  for (const float beside : {0.0F, 0.0F, 0.2F, 0.0F}) press("cross", beside);
  EXPECT_EQ(seen().verdict, TouchVerdict::Misfit);
  EXPECT_TRUE(unchanged());
  // All four are met, and then the wrong place.
  tap("begin");
  for (int i = 0; i < 4; ++i) press("cross");
  press(0.95F, 0.05F);  // the button that signs out: fingers press nothing now
  EXPECT_EQ(seen().verdict, TouchVerdict::Missed);
  EXPECT_TRUE(unchanged());
  // Whoever leaves in the middle of it leaves nothing.
  tap("begin");
  press("cross");
  tap("back");
  EXPECT_EQ(kiosk->ui().service().page, StaffPage::Menu);
  EXPECT_FALSE(kiosk->view().service->touch != nullptr);
  tap("open health");
  EXPECT_EQ(kiosk->ui().service().page, StaffPage::Health);
}

}  // namespace
}  // namespace relievo::firmware
