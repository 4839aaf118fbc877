// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The staff's first page in the real kiosk: a fault reddens it, its row opens the page where it is mended,
// and when it is mended the row is gone. What the last visits cost stands on the page of health.
#include <algorithm>
#include <atomic>

#include "firmware/base/budget.h"
#include "firmware/command/commands.h"
#include "firmware/records/event_log.h"
#include "firmware/service/statistics.h"
#include "tests/firmware/kiosk/staff_hands.h"
#include "tests/support/played_device.h"
#include "ui/draw/theme.h"
#include "ui/view/staff_views.h"

namespace relievo::firmware {
namespace {

class StaffStatusTest : public StaffHands {
 protected:
  void play_device() {
    services.open_device = [this](std::string_view) -> Result<std::unique_ptr<hal::Device>> {
      auto device = std::make_unique<test::PlayedDevice>(world, tiny_rig().width_px, tiny_rig().height_px);
      return std::unique_ptr<hal::Device>(std::make_unique<ChangedDevice>(std::move(device), changes));
    };
  }
  void enter(StaffRole role) {
    start();
    first_start();
    sign_in(role == StaffRole::Operator ? "80526" : "4711", role);
    ASSERT_TRUE(until([this] { return looked(); })) << "the device is looked at beside the screen";
    kiosk->turn();
  }
  void pull_a_camera_from_a_visit() {
    start();
    first_start();
    tap("sign out");
    ASSERT_TRUE(until([this] { return !kiosk->ui().service().open; }));
    tap("start");
    tap("agree");
    kiosk->ui().visit().type("Grace");
    kiosk->turn();
    tap("done");
    ASSERT_TRUE(reach(ui::Step::Position));
    ASSERT_TRUE(until([this] { return kiosk->view().live.number > 0; }));
    world.pulled = true;
    ASSERT_TRUE(reach(ui::Step::Trouble));
  }
  bool looked() const {
    return kiosk->view().service->status != nullptr && kiosk->view().service->status->looked;
  }
  bool red(std::string_view id) const {
    const ui::Node* row = find(id);
    if (row == nullptr) return false;
    const ui::Node& sign = kiosk->ui().tree().nodes()[static_cast<std::size_t>(row->first_child)];
    return sign.colour == ui::kLight.bad && sign.role == ui::Role::Icon;
  }

  test::PlayedWorld world;
};

TEST_F(StaffStatusTest, ARowForWhatIsMissingLeadsToItsPageAndGoesWhenItIsMended) {
  enter(StaffRole::Operator);
  EXPECT_EQ(find("status good"), nullptr);
  ASSERT_NE(find("status sample"), nullptr);
  tap("status recovery");
  EXPECT_EQ(kiosk->ui().service().page, StaffPage::Recovery);
  tap("back");
  tap("status sample");
  EXPECT_EQ(kiosk->ui().service().page, StaffPage::Consent);
  const Path texts = stick() / "consent" / "2026-09";
  std::filesystem::create_directories(texts);
  for (const char* code : {"en", "de", "fr", "es", "ar", "he", "zh-Hans"})
    std::ofstream(texts / (std::string(code) + ".txt")) << "Title\n\nPoint\nWords.\n";
  tap("take consent");
  ASSERT_TRUE(until([this] { return kiosk->view().consent != nullptr; }));
  tap("back");
  ASSERT_TRUE(until([this] { return find("status languages") != nullptr; })) << "one is missing yet";
  EXPECT_EQ(find("status sample"), nullptr);
}

TEST_F(StaffStatusTest, AWrongClockReddensItUntilItIsSetOnThePageItLeadsTo) {
  play_device();
  services.set_clock = [this](std::chrono::system_clock::time_point to) -> Result<void> {
    world.wall_shift_s +=
        std::chrono::duration_cast<std::chrono::seconds>(to - kiosk->view().wall_now).count();
    return {};
  };
  enrol("Ada Lovelace");  // a consent cannot bear a date before hers
  enter(StaffRole::Technician);
  EXPECT_EQ(find("status clock"), nullptr);
  world.wall_shift_s -= 3 * 24 * 3600;
  kiosk->turn();
  ASSERT_TRUE(red("status clock"));
  tap("status clock");
  ASSERT_EQ(kiosk->ui().service().page, StaffPage::Clock);
  const auto shown = [this] { return std::string(kiosk->view().service->access.clock); };
  const std::string before = shown();
  for (const char* button : {"year more", "year more"}) tap(button);  // years, not a thousand touches
  kiosk->turn();
  EXPECT_NE(shown().substr(0, 4), before.substr(0, 4));
  for (const char* button : {"year less", "year less", "month more", "month less"}) tap(button);
  for (int day = 0; day < 3; ++day) tap("day more");
  tap("clock right");
  kiosk->turn();
  EXPECT_NE(find("clock set"), nullptr);
  tap("back");
  EXPECT_EQ(find("status clock"), nullptr);
}

TEST_F(StaffStatusTest, WhoSaysThatTheClockIsRightIsBelievedMoreThanARecordOfWhenItWasAhead) {
  play_device();
  enrol("Ada Lovelace");
  enter(StaffRole::Technician);
  world.wall_shift_s -= 3 * 24 * 3600;  // what the clock said when she was enrolled was wrong, this is right
  kiosk->turn();
  ASSERT_TRUE(red("status clock"));
  tap("status clock");
  tap("clock right");
  kiosk->turn();
  tap("back");
  EXPECT_EQ(find("status clock"), nullptr);
  world.wall_shift_s -= 40 * 24 * 3600;  // of this nobody has said so
  for (int turn = 0; turn < 3; ++turn) kiosk->turn();
  EXPECT_TRUE(red("status clock"));
}

TEST_F(StaffStatusTest, APulledCameraReddensItForBothRolesAndOnlyTheTechnicianIsLedToIt) {
  play_device();
  pull_a_camera_from_a_visit();
  sign_in("4711", StaffRole::Technician);
  ASSERT_TRUE(until([this] { return looked() && find("status camera") != nullptr; }));
  EXPECT_TRUE(red("status camera"));
  EXPECT_NE(find("status faults"), nullptr) << "it was noted, too";
  tap("status camera");
  EXPECT_EQ(kiosk->ui().service().page, StaffPage::Cameras);
  tap("back");
  tap("sign out");
  ASSERT_TRUE(until([this] { return !kiosk->ui().service().open; }));
  sign_in("80526", StaffRole::Operator);
  ASSERT_TRUE(until([this] { return looked() && find("status camera") != nullptr; }));
  EXPECT_TRUE(red("status camera"));
  EXPECT_EQ(find("status camera")->action.kind, ui::ActionKind::None) << "it is the technician's work";
  EXPECT_TRUE(says("Technician"));
}

TEST_F(StaffStatusTest, AKeeperThatHangsIsAskedForTheHeatOnce) {
  hal::ManualClock time;
  changes.clock = &time;
  std::atomic<int> looks{0};
  std::atomic<bool> hangs{true};
  changes.too_hot = [&] {
    ++looks;
    hangs.wait(true);
    return false;
  };
  start();
  for (int look = 0; look < 5; ++look) {
    time.advance(budget::kHealthLook);
    kiosk->turn();
  }
  hangs = false;
  hangs.notify_all();
  first_start();  // the keeper has done what waited before it
  EXPECT_EQ(looks, 1);
  kiosk.reset();  // before what its device borrows
}

TEST_F(StaffStatusTest, AnExportThatFailsDoesNotTellOfAVisitsFaultOnceMore) {
  play_device();
  enrol("Ada Lovelace");
  pull_a_camera_from_a_visit();
  sign_in("80526", StaffRole::Operator);
  tap("open records");
  ASSERT_TRUE(until([this] { return find("export all") != nullptr; }));
  const auto told = [this] {
    return std::ranges::count_if(kiosk->staff().log().entries(), [](const ui::LogLine& line) {
      return line.fault && line.code != Errc::MediaMissing;
    });
  };
  const auto before = told();
  EXPECT_GT(before, 0);
  tap("export all");
  ASSERT_TRUE(until([this] { return kiosk->view().service->work.outcome != ui::Outcome::None; }));
  EXPECT_EQ(kiosk->view().service->work.outcome, ui::Outcome::NoStick);
  EXPECT_EQ(told(), before);
}

// A visit on the simulated rig, with all its stages; the session is wiped when it ends, and so is what the
// appliance keeps of the next one as soon as that begins.
TEST_F(StaffStatusTest, HealthShowsWhatTheLastVisitsCostAlsoAfterARestart) {
  lend_small_rig(services, args, folder.path(), clock, test::small_device(0.5));
  start();
  const Result<void> played =
      play("tap start\ntap agree\ntype Ada\ntap done\nwait position\nwait working 600\nwait review 600\n");
  ASSERT_TRUE(played.has_value()) << played.error().where();
  tap("leave");
  tap("answer_quiet");
  ASSERT_TRUE(reach(ui::Step::Attract));
  for (const bool restarted : {false, true}) {
    if (restarted) {
      ASSERT_TRUE(until([this] { return kiosk->appliance().state() == State::Idle; }));
      kiosk.reset();
      start();
    } else {
      first_start();
    }
    sign_in("4711", StaffRole::Technician);
    tap("open health");
    ASSERT_TRUE(until([this] { return kiosk->view().service->health != nullptr; }));
    kiosk->turn();
    const ui::HealthView& health = *kiosk->view().service->health;
    EXPECT_EQ(health.costs.visits, 1);
    for (const ui::CostlyStage stage : {ui::CostlyStage::Match, ui::CostlyStage::Reconstruct,
                                        ui::CostlyStage::Mesh, ui::CostlyStage::Texture}) {
      EXPECT_GT(health.costs.stages[static_cast<std::size_t>(stage)].seconds, 0);
      EXPECT_GT(health.costs.stages[static_cast<std::size_t>(stage)].mib, 1);
    }
    EXPECT_GT(health.costs.resident_mib, health.costs.stages[0].mib);
    ASSERT_FALSE(health.gauges.empty());
    EXPECT_EQ(health.gauges[0].gauge, ui::Gauge::Stages);
    EXPECT_GT(health.gauges[0].used, 1) << "of the arenas";
    EXPECT_LT(health.gauges[0].used, health.gauges[0].of) << "and what was planned stands beside it";
    EXPECT_TRUE(says("Matching"));
    EXPECT_NE(find("cost 0"), nullptr);
    sign_out();
  }
  kiosk.reset();
  testing::internal::CaptureStdout();
  const Result<void> told = run(MemoryArgs{args.store}, services);
  const std::string said = testing::internal::GetCapturedStdout();
  ASSERT_TRUE(told.has_value()) << told.error().where();
  EXPECT_NE(said.find("the last 1 visits"), std::string::npos) << said;
  float mib = 0, seconds = 0;
  const std::size_t match = said.find("Match ");
  ASSERT_NE(match, std::string::npos) << said;
  EXPECT_EQ(std::sscanf(said.c_str() + match, "Match %f MiB %f s", &mib, &seconds), 2) << said;
  EXPECT_GT(mib, 1);
  EXPECT_GT(seconds, 0);
}

TEST_F(StaffStatusTest, AVisitIsCountedAlsoWhereTheLogCannotBeWritten) {
  std::filesystem::create_directories(args.store / kLogFile);  // a folder in the place of its file
  play_device();
  start();
  const Result<void> played = play("tap start\ntap agree\ntype Grace\ntap done\nwait position\ntap back\n");
  ASSERT_TRUE(played.has_value()) << played.error().where();
  const auto at_rest = [this] {
    return kiosk->appliance().state() == State::Idle && !kiosk->staff().side_tasks().busy(JobLane::Keeper);
  };
  ASSERT_TRUE(until(at_rest));
  kiosk->turn();  // what is not written yet is sent now
  ASSERT_TRUE(until(at_rest));
  kiosk.reset();
  auto store = storage::open_sqlite_store(args.store, wall(), {});
  ASSERT_TRUE(store.has_value());
  const auto kept = (*store)->setting(kStatisticsSetting);
  ASSERT_TRUE(kept.has_value());
  Statistics statistics;
  ASSERT_TRUE(statistics.read(*kept)) << "'" << *kept << "'";
  EXPECT_EQ(statistics.view(std::chrono::floor<std::chrono::days>(wall().wall_now())).visits, 1U);
}

}  // namespace
}  // namespace relievo::firmware
