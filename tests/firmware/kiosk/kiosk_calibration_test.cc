// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The real kiosk whose calibration is missing, or whose cameras have been knocked: what visitors are told,
// what the technician may do, and that a calibration made or chosen at the screen is all it needs to serve.
#include "tests/firmware/held_hand.h"
#include "tests/firmware/kiosk/staff_hands.h"
#include "tests/support/rig_calibration.h"
#include "tests/support/small_rig.h"

namespace relievo::firmware {
namespace {

constexpr double kScale = 0.5;
const hal::sim::RigOptions kHalfRig = test::small_rig(kScale);

class KioskCalibrationTest : public StaffHands {
 protected:
  KioskCalibrationTest() {
    services.open_device = [](std::string_view) { return hal::make_sim_device(test::small_device(kScale)); };
    services.simulated_calibration = {};
    services.hold_board = [](const CalibrateLiveArgs& held) -> Result<std::unique_ptr<LivePairs>> {
      return make_hand_pairs(held_board(kHalfRig, held.board), held.seed);
    };
  }
  void open() {
    auto opened = Kiosk::open(args, services);
    ASSERT_TRUE(opened.has_value()) << opened.error().what.view();
    kiosk = std::move(*opened);
    kiosk->ui().resize(1280, 800);
  }
  // As who switches it off properly, once it has written down what it knows.
  void open_again() {
    ASSERT_TRUE(until([this] {
      return (kiosk->appliance().state() == State::Idle || kiosk->appliance().state() == State::Staff) &&
             !kiosk->staff().side_tasks().busy(JobLane::Keeper);
    }));
    kiosk.reset();
    open();
  }
  const ui::TechnicianView& technician() const { return *kiosk->view().service->technician; }

  void visitors_are_told() {
    ASSERT_TRUE(reach(ui::Step::Trouble));
    EXPECT_TRUE(says("not set up yet")) << "its own words";
    EXPECT_EQ(find("finish"), nullptr) << "nobody passes by";
    EXPECT_EQ(find("start"), nullptr);
  }
  void the_technician_pages_say_what_comes_first() {
    for (const char* page : {"open stages", "open model", "open tables", "open compare"}) {
      tap(page);
      EXPECT_TRUE(says("must be calibrated")) << page;
      EXPECT_EQ(find("capture"), nullptr) << page;
      tap("back");
    }
    tap("open algorithms");
    EXPECT_TRUE(says("must be calibrated"));
    EXPECT_EQ(find("apply"), nullptr);
    EXPECT_NE(find("reset"), nullptr) << "what needs no calibration can be done";
    tap("back");
    tap("open stages");
    tap("to calibration");
    EXPECT_EQ(kiosk->ui().service().page, StaffPage::Calibrate);
  }
  void calibrate() {
    tap("calibration begin");
    ASSERT_TRUE(until([this] { return kiosk->appliance().state() == State::Calibrate; }));
    ASSERT_TRUE(until([this] {
      return technician().calibration.views >= 8 || !technician().calibration.running;
    })) << technician().calibration.problem.detail;
    if (technician().calibration.running) tap("calibration finish");
    ASSERT_TRUE(until(
        [this] { return technician().calibration.ended || !technician().calibration.problem.empty(); }));
    ASSERT_EQ(technician().calibration.problem.detail, "");
    ASSERT_NE(technician().calibration.verdict, pipeline::CalibrationVerdict::Refuse)
        << technician().calibration.problem.detail;
    EXPECT_EQ(kiosk->view().out_of_order, ui::Trouble::Uncalibrated) << "seen is not accepted";
    tap("calibration store");
    ASSERT_TRUE(until([this] { return technician().calibration.history_count == 1; }))
        << technician().calibration.problem.detail;
    EXPECT_TRUE(technician().calibrated);
  }
};

TEST_F(KioskCalibrationTest, WithoutACalibrationItStartsIsCalibratedAtItsScreenAndServes) {
  open();
  visitors_are_told();
  first_start();
  sign_in("4711", StaffRole::Technician);
  the_technician_pages_say_what_comes_first();
  calibrate();
  sign_out();
  ASSERT_TRUE(reach(ui::Step::Attract)) << "without a restart";
  const Result<void> played = play(
      "tap start\ntap agree\ntype Ada\ntap done\nwait position\nwait review 120\ntap accept\nwait thanks 60\n");
  ASSERT_TRUE(played.has_value()) << played.error().where() << " advice "
                                  << static_cast<int>(kiosk->view().live.advice)
                                  << (kiosk->appliance().problem() ? kiosk->appliance().problem()->what.view()
                                                                   : "");
  kiosk.reset();
  auto store = storage::open_sqlite_store(args.store, clock, {});
  ASSERT_TRUE(store.has_value());
  const auto enrolments = (*store)->enrolments(storage::SubjectId{1});
  ASSERT_TRUE(enrolments.has_value());
  ASSERT_EQ(enrolments->size(), 1U);
  EXPECT_EQ(enrolments->front().calibration_revision, (*store)->active_calibration()->revision)
      << "measured with what was made at the screen";
}

TEST_F(KioskCalibrationTest, AKnockedCameraIsNoticedToldAndServesAgainOnceCalibrated) {
  {
    auto store = storage::open_sqlite_store(args.store, clock, {});
    ASSERT_TRUE(store.has_value());
    const pipeline::StereoCalibration now = test::true_calibration(hal::sim::make_rig(kHalfRig));
    ASSERT_TRUE((*store)->save_calibration(now, "as the cameras stand").has_value());
    // Since this one was made, the right camera has been knocked by 3 px across the rows.
    ASSERT_TRUE((*store)
                    ->save_calibration(test::turned(now, 3 / now.right.focal_px.y, 0, 0), "before the knock")
                    .has_value());
  }
  open();
  for (int visitor = 0; visitor < budget::kMovedFaces; ++visitor) {
    const Result<void> played =
        play("wait attract 60\ntap start\ntap agree\ntype Ada\ntap done\nwait position\nwait trouble 120\n");
    ASSERT_TRUE(played.has_value()) << played.error().where() << " advice "
                                    << static_cast<int>(kiosk->view().live.advice);
    EXPECT_EQ(kiosk->view().trouble, ui::Trouble::Calibration);
    EXPECT_TRUE(says("need adjusting"));
    EXPECT_FALSE(says("Ada"));
    EXPECT_EQ(kiosk->ui().visit().name(), "");
    EXPECT_FALSE(kiosk->appliance().session().is_open());
    EXPECT_EQ(kiosk->ui().draw_list().faces[0].model, nullptr);
    if (visitor == 0) open_again();  // one face that said so is not forgotten, either
  }
  // One face may have nodded; a second one ends it: nobody else is photographed in vain.
  ASSERT_TRUE(until([this] { return kiosk->appliance().state() == State::Idle; }));
  EXPECT_EQ(kiosk->ui().visit().step, ui::Step::Trouble);
  EXPECT_TRUE(says("need adjusting"));
  EXPECT_EQ(find("finish"), nullptr);
  // Whoever switches it off and on has not calibrated it.
  open_again();
  ASSERT_TRUE(reach(ui::Step::Trouble));
  EXPECT_EQ(kiosk->view().out_of_order, ui::Trouble::Calibration);
  EXPECT_TRUE(says("need adjusting"));
  EXPECT_EQ(find("finish"), nullptr);
  first_start();
  sign_in("4711", StaffRole::Technician);
  tap("open calibrate");
  ASSERT_TRUE(until([this] { return technician().calibration.history_count == 2; }));
  kiosk->ui().visit().language = ui::Language::German;
  kiosk->turn();
  EXPECT_TRUE(says("Die Kameras müssen kalibriert werden"))
      << "what the last face said, over a restart and in the reader's language";
  EXPECT_TRUE(says("1.5")) << "with its figures";
  kiosk->ui().visit().language = ui::Language::English;
  kiosk->turn();
  tap(technician().calibration.history[0].active ? "calibration 1" : "calibration 0");
  ASSERT_TRUE(until([this] { return kiosk->view().out_of_order == ui::Trouble::None; }))
      << technician().calibration.problem.detail;
  sign_out();
  open_again();
  ASSERT_TRUE(reach(ui::Step::Attract)) << "a calibration that was chosen ends it for good";
  const Result<void> played = play(
      "wait attract 60\ntap start\ntap agree\ntype Ada\ntap done\nwait position\nwait review 120\ntap accept\nwait thanks 60\n");
  EXPECT_TRUE(played.has_value()) << played.error().where();
}

// A real device, whose cameras nobody simulates: it starts, and no touch and no wait begins a capture.
TEST_F(KioskCalibrationTest, NothingBeginsACaptureBefore) {
  hal::ManualClock time;
  changes.clock = &time;
  args.device = "folder";
  services.open_device = [this](std::string_view) -> Result<std::unique_ptr<hal::Device>> {
    RELIEVO_TRY_ASSIGN(auto device, hal::make_folder_device(folder.path() / "pairs"));
    return std::unique_ptr<hal::Device>(std::make_unique<ChangedDevice>(std::move(device), changes));
  };
  open();
  ASSERT_TRUE(reach(ui::Step::Trouble));
  for (int minute = 0; minute < 20; ++minute) {
    for (float y = 20; y < 800; y += 60) {
      for (float x = 20; x < 1280; x += 60) {
        kiosk->feed({ui::Input::Kind::Down, 7, x, y});
        kiosk->feed({ui::Input::Kind::Up, 7, x, y});
      }
      kiosk->turn();
      EXPECT_EQ(kiosk->ui().visit().step, ui::Step::Trouble);
      ASSERT_EQ(kiosk->appliance().state(), State::Idle);
    }
    time.advance(std::chrono::minutes(1));
    kiosk->turn();
    EXPECT_EQ(kiosk->ui().visit().step, ui::Step::Trouble);
  }
  // A hand that is everywhere also opens the first start, which closes by itself.
  for (int minute = 0; minute < 7; ++minute) {
    time.advance(std::chrono::minutes(1));
    kiosk->turn();
  }
  EXPECT_EQ(kiosk->ui().visit().language, ui::Language::English) << "whatever was touched is forgotten";
  EXPECT_FALSE(kiosk->appliance().session().is_open());
}

}  // namespace
}  // namespace relievo::firmware
