// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A whole enrolment by synthetic fingers, from the page that invites to a row in the store, on the
// simulated rig; and who leaves in the middle.
#include "firmware/kiosk/kiosk.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "firmware/kiosk/receipt.h"
#include "hal/monotonic_clock.h"
#include "hal/sim/board.h"
#include "pipeline/calibrate/file/calibration_file.h"
#include "storage/sqlite/sqlite_store.h"
#include "tests/firmware/kiosk/kiosk_hands.h"
#include "tests/support/full_store.h"
#include "tests/support/temporary_folder.h"

namespace relievo::firmware {
namespace {

constexpr double kScale = 0.5;  // of the rig's pictures: a light test

hal::sim::RigOptions small_rig() {
  hal::sim::RigOptions rig;
  rig.width_px = static_cast<int>(rig.width_px * kScale);
  rig.height_px = static_cast<int>(rig.height_px * kScale);
  return rig;
}

class KioskTest : public KioskHands {
 protected:
  KioskTest() {
    EXPECT_TRUE(ui::prepare_languages().has_value());
    args.store = folder.path() / "store";
    services.open_board = [](std::string_view) {
      hal::SimBoardOptions options;
      options.simulation.rig = small_rig();
      return hal::make_sim_board(options);
    };
    services.open_store = [this](const Path& at, bool) -> Result<std::unique_ptr<storage::Store>> {
      RELIEVO_TRY_ASSIGN(auto real, storage::open_sqlite_store(at, clock, {}));
      return std::unique_ptr<storage::Store>(std::make_unique<test::FullStore>(std::move(real), full));
    };
    services.simulated_calibration = [this]() -> Result<pipeline::StereoCalibration> {
      const Path file = folder.path() / "rig.yml";
      RELIEVO_TRY(hal::sim::write_rig(file, hal::sim::make_rig(small_rig())));
      return pipeline::read_calibration(file);
    };
    auto opened = Kiosk::open(args, services);
    EXPECT_TRUE(opened.has_value()) << opened.error().what.view();
    kiosk = std::move(*opened);
    kiosk->ui().resize(1280, 800);
  }

  void to_position() {
    ASSERT_TRUE(reach(ui::Step::Attract));
    tap("start");
    tap("agree");
    for (const char* key : {"key A", "key d", "key a"}) tap(key);
    EXPECT_EQ(kiosk->ui().visit().name(), "Ada");
    EXPECT_EQ(kiosk->appliance().state(), State::Idle) << "no camera runs yet";
    tap("done");
    ASSERT_TRUE(reach(ui::Step::Position));
  }

  void leave_before_the_picture() {
    to_position();
    while (kiosk->view().live.number == 0) {
      kiosk->turn();
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    EXPECT_FALSE(live_picture().empty());
    tap("leave");
    tap("answer_quiet");
    kiosk->turn();
    EXPECT_EQ(kiosk->ui().visit().step, ui::Step::Attract);
    EXPECT_EQ(kiosk->ui().visit().name(), "");
    EXPECT_EQ(kiosk->appliance().state(), State::Idle);
    EXPECT_FALSE(kiosk->appliance().session().is_open());
    EXPECT_TRUE(live_picture().empty());
    EXPECT_TRUE(kiosk->take_forgotten());
  }
  const ImageView& live_picture() const { return kiosk->ui().draw_list().pictures[static_cast<std::size_t>(ui::PictureSlot::Live)].pixels; }

  void enrol_by_touch() {
    // Nobody touches the screen after "done": the face stands still, and the picture is taken by itself.
    const Result<void> played = play("wait attract\ntap start\ntap agree\ntype Ada\ntap done\nwait position\nwait working 600\nwait review 600\n");
    ASSERT_TRUE(played.has_value()) << played.error().where() << " advice " << static_cast<int>(kiosk->view().live.advice)
                                    << (kiosk->appliance().problem() ? kiosk->appliance().problem()->what.view() : "");
    kiosk->turn();
    EXPECT_NE(kiosk->ui().draw_list().face, nullptr);
    for (const ui::StageView& stage : kiosk->view().stages) EXPECT_FALSE(stage.picture.empty()) << "a stage has no picture";
    // Turned with a finger.
    const ui::Rect face = kiosk->ui().tree().find("face")->rect;
    kiosk->feed({ui::Input::Kind::Down, 1, face.x + 200, face.y + 200});
    kiosk->feed({ui::Input::Kind::Move, 1, face.x + 300, face.y + 200});
    kiosk->feed({ui::Input::Kind::Up, 1, face.x + 300, face.y + 200});
    EXPECT_GT(kiosk->ui().visit().look.yaw_deg, 10);
    full = true;
    tap("accept");
    ASSERT_TRUE(until([this] { return kiosk->view().trouble == ui::Trouble::Storage && kiosk->view().screen == ui::Screen::Review; }));
    EXPECT_EQ(kiosk->view().receipt, "") << "no code for what was not stored";
    EXPECT_NE(find("trouble"), nullptr) << "its own words";
    full = false;
    tap("accept");  // the way on
    ASSERT_TRUE(reach(ui::Step::Thanks));
    kiosk->turn();
    code = kiosk->view().receipt;
    EXPECT_LE(kiosk->ui().visit().touches, 6);
    tap("finish");
    EXPECT_EQ(kiosk->ui().visit().step, ui::Step::Attract);
    kiosk->turn();
    EXPECT_EQ(kiosk->view().receipt, "");
    EXPECT_TRUE(kiosk->take_forgotten());
  }

  // A name that is in the records; the visitor leaves, then comes back with the code and renews.
  void stop_then_renew() {
    const Result<void> stopped = play("tap start\ntap agree\ntype Ada\ntap done\nwait known\ntap leave\ntap answer_quiet\nwait attract\n");
    ASSERT_TRUE(stopped.has_value()) << stopped.error().where();
    EXPECT_EQ(kiosk->view().known, ui::Known::NotAsked) << "what was asked is forgotten";
    const std::string again = "tap start\ntap agree\ntype Ada\ntap done\nwait known\ntap have_code\nwait name\ntype " + code +
                              "\ntap done\nwait known\ntap renew\nwait review 600\ntap accept\nwait thanks 600\n";
    const Result<void> renewed = play(again.c_str());
    ASSERT_TRUE(renewed.has_value()) << renewed.error().where();
    kiosk->turn();
    EXPECT_EQ(kiosk->view().receipt, code) << "the same record";
    tap("finish");
    kiosk.reset();
  }

  void one_record_with_the_newer_portrait() {
    auto store = storage::open_sqlite_store(args.store, clock, {});
    ASSERT_TRUE(store.has_value());
    EXPECT_EQ((*store)->subjects({})->size(), 1U) << "who left is not there, and nobody is there twice";
    ASSERT_TRUE(subject_of_receipt(code)) << code;
    const auto subject = (*store)->subject(*subject_of_receipt(code));
    ASSERT_TRUE(subject.has_value());
    EXPECT_EQ(subject->name, "Ada");
    const auto enrolments = (*store)->enrolments(subject->id);
    ASSERT_TRUE(enrolments.has_value());
    ASSERT_EQ(enrolments->size(), 1U) << "the old portrait is gone";
    EXPECT_GT(enrolments->front().created_at, subject->created_at) << "the newer one stays";
    EXPECT_EQ(enrolments->front().consent.wording, ui::kConsentWording);
    EXPECT_EQ(enrolments->front().consent.language, "en");
    EXPECT_LT(enrolments->front().consent.given_at, enrolments->front().created_at);
    EXPECT_GT(enrolments->front().consent.given_at, subject->created_at) << "the second consent";
    EXPECT_TRUE((*store)->check().has_value());
  }

  std::atomic<bool> full{false};
  std::string code;
  test::TemporaryFolder folder;
  hal::MonotonicClock clock;
  Console console;
  Services services{{}, {}, {}, {}, {}, {}, {}, console, clock};
  KioskArgs args;
};

// One test for all, since building the simulated person takes longest.
TEST_F(KioskTest, WhoLeavesLeavesNothingAndTheNextIsEnrolledAndRenews) {
  leave_before_the_picture();
  enrol_by_touch();
  stop_then_renew();
  one_record_with_the_newer_portrait();
}

}  // namespace
}  // namespace relievo::firmware
