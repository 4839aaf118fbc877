// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The technician's test capture between the other pages that use the cameras: it stays until it is taken
// anew, or until the technician leaves.
#include <algorithm>

#include "tests/firmware/kiosk/staff_hands.h"

namespace relievo::firmware {
namespace {

class StaffCaptureTest : public StaffHands, public testing::WithParamInterface<bool> {
 protected:
  StaffCaptureTest() { changes.live = GetParam(); }
  void enter() {
    start();
    if (changes.live) {
      kiosk->turn();
      choose_pins();
    } else {
      first_start();
    }
    sign_in("4711", StaffRole::Technician);
  }
  const ui::TechnicianView& technician() const { return *kiosk->view().service->technician; }
  // Are both views of the capture still those that were taken: grey all over?
  bool stands() const {
    const auto& frame = kiosk->appliance().session().products().frame;
    if (!frame) return false;
    for (const ImageView* view : {&frame->left, &frame->right}) {
      const std::size_t bytes =
          static_cast<std::size_t>(view->height_px) * static_cast<std::size_t>(view->stride_bytes);
      if (!std::all_of(view->bytes, view->bytes + bytes, [](std::byte b) { return b == std::byte{90}; }))
        return false;
    }
    return true;
  }
};

TEST_P(StaffCaptureTest, TriggerTestAndSelfTestTakeTheirPicturesBesideIt) {
  enter();
  tap("open stages");
  tap("capture");
  ASSERT_TRUE(until([this] {
    return technician().phase == ui::TechnicianPhase::Ready ||
           technician().phase == ui::TechnicianPhase::Failed;
  }));
  ASSERT_TRUE(stands()) << technician().problem.detail;
  tap("back");
  tap("open trigger");
  tap("begin");
  ASSERT_TRUE(until([this] { return kiosk->view().service->trigger->ended; }));
  EXPECT_EQ(kiosk->view().service->trigger->pairs, 10);
  EXPECT_TRUE(stands()) << "the trigger test";
  tap("back");
  tap("open self test");
  tap("begin");
  ASSERT_TRUE(until([this] { return !kiosk->view().service->work.running; }));
  EXPECT_TRUE(stands()) << "the self-test";
  tap("back");
  tap("open cameras");
  ASSERT_TRUE(until([this] { return technician().cameras.pairs > 2; }));
  EXPECT_TRUE(stands()) << "the live pair";
  tap("back");
  sign_out();
  EXPECT_FALSE(kiosk->appliance().session().is_open());
}

INSTANTIATE_TEST_SUITE_P(Devices, StaffCaptureTest, testing::Bool(),
                         [](const auto& of) { return of.param ? "Live" : "Recorded"; });

}  // namespace
}  // namespace relievo::firmware
