// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The staff's pages alone, on threads that are busy with something else: what somebody asked for who signs
// out before its turn has come.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <optional>
#include <utility>
#include <vector>

#include "firmware/records/receipt.h"
#include "firmware/service/page_controller.h"
#include "firmware/service/record_filter.h"
#include "tests/firmware/played_appliance.h"
#include "tests/storage/sample.h"
#include "tests/support/faulty_store.h"
#include "tests/support/temporary_folder.h"

namespace relievo::firmware {
namespace {

class PageTest : public ApplianceTest {
 protected:
  PageTest() {
    EXPECT_TRUE(reach(State::Idle));
    appliance.ask(ui::Intent::OpenStaff);
    EXPECT_TRUE(reach(State::Staff));
  }
  ~PageTest() override { let_go_on(); }
  // Something else is on that thread, until let_go_on().
  void keep_busy(JobLane lane) {
    held.store(true);
    side_tasks.send(
        lane,
        [this](JobControl&) -> Result<void> {
          held.wait(true);
          return {};
        },
        [](const std::optional<Error>&) {}, SideTasks::Whose::Device);
  }
  void let_go_on() {
    held.store(false);
    held.notify_all();
  }
  void until_all_is_done() {
    let_go_on();
    const auto busy = [this] {
      return side_tasks.busy(JobLane::Capture) || side_tasks.busy(JobLane::Worker) ||
             side_tasks.busy(JobLane::Keeper);
    };
    while (busy()) appliance.step(milliseconds(1));
  }
  // As StaffController does it.
  void sign_out(PageController& page) {
    page.closed();
    side_tasks.cancel();
  }
  static void ask(PageController& page, ui::StaffAsk what) {
    ui::StaffRequest request;
    request.ask = what;
    page.ask(request);
  }
  static ui::ServiceView seen(PageController& page) {
    ui::ServiceView view;
    page.show(view);
    return view;
  }
  bool logged(ui::LogEvent event) const {
    return std::ranges::any_of(log.entries(),
                               [event](const ui::LogLine& line) { return line.event == event; });
  }

  std::atomic<bool> held{false};
  test::TemporaryFolder folder;
  std::unique_ptr<storage::Store> store = storage::test::opened(folder.path() / "store");
  SideTasks side_tasks{appliance};
  EventLog log{device.clock(), {}};
  Statistics statistics;
  VisitCosts costs;
  DeviceSettings settings{*store, side_tasks, log, device.clock()};
  RetentionWatch retention{*store, side_tasks, log, device.clock()};
  TouchTrial touch{*store, side_tasks, log, device.clock()};
  ConsentTextStore consent{*store, folder.path(), device.media(), side_tasks, log};
  std::uint32_t revision = 0;
  PageServices services{appliance, device,    *store, side_tasks, log,           statistics, costs,
                        settings,  retention, touch,  consent,    folder.path(), revision};
};

TEST_F(PageTest, WhoseErasureWasConfirmedIsErasedThoughTheOperatorSignsOutMeanwhile) {
  const pipeline::FaceModel model = storage::test::sample_model();
  ASSERT_TRUE(store->add_enrolment(storage::NewSubject{"Ada"}, storage::test::sample_enrolment(model)));
  const auto whom = store->subjects({});
  ASSERT_TRUE(whom && whom->size() == 1);
  const auto made = records_controller(services);
  PageController& page = *made;
  page.opened();
  until_all_is_done();
  keep_busy(JobLane::Keeper);
  ask(page, ui::EraseRecord{std::int64_t(whom->front().id)});
  sign_out(page);
  until_all_is_done();
  EXPECT_TRUE(store->subjects({})->empty());
  EXPECT_TRUE(logged(ui::LogEvent::RecordErased));
}

TEST_F(PageTest, ASelfTestThatWasCancelledBySigningOutCanBeBegunAgain) {
  const auto made = device_controller(services, ui::StaffPage::SelfTest);
  PageController& page = *made;
  page.opened();
  keep_busy(JobLane::Keeper);
  ask(page, ui::BeginSelfTest{});
  EXPECT_TRUE(seen(page).work.running);
  sign_out(page);
  page.opened();
  EXPECT_FALSE(seen(page).work.running);
  ask(page, ui::BeginSelfTest{});
  until_all_is_done();
  const ui::ServiceView view = seen(page);
  EXPECT_FALSE(view.work.running);
  for (const ui::CheckState state : view.self_test->states)
    EXPECT_TRUE(state == ui::CheckState::Good || state == ui::CheckState::Bad);
}

TEST_F(PageTest, ATriggerTestThatWasCancelledBySigningOutCanBeBegunAgain) {
  const auto made = device_controller(services, ui::StaffPage::Trigger);
  PageController& page = *made;
  page.opened();
  keep_busy(JobLane::Capture);
  ask(page, ui::BeginTriggerTest{});
  EXPECT_TRUE(seen(page).work.running);
  sign_out(page);
  page.opened();
  EXPECT_FALSE(seen(page).work.running);
  ask(page, ui::BeginTriggerTest{});
  until_all_is_done();
  EXPECT_TRUE(seen(page).trigger->ended);
}

TEST_F(PageTest, ADiskThatDoesNotAnswerIsToldAsSeldomAsItsRoomIsKept) {
  services.folder = folder.path() / "gone";
  const auto made = health_controller(services);
  PageController& page = *made;
  page.opened();
  until_all_is_done();
  for (int look = 0; look < 5; ++look) {
    page.turn();
    until_all_is_done();
    world.ahead_s += 3;
    (void)seen(page);
    until_all_is_done();
  }
  EXPECT_EQ(log.faults().size(), 1U) << "the log has room for 200 lines";
  world.ahead_s += std::chrono::seconds(DayRing::kEvery).count();
  page.turn();
  until_all_is_done();
  EXPECT_EQ(log.faults().size(), 2U);
}

TEST_F(PageTest, TheDeviceIsLookedAtAgainAfterALookThatSigningOutCancelled) {
  const auto made = device_controller(services, ui::StaffPage::Menu);
  PageController& page = *made;
  page.opened();
  keep_busy(JobLane::Keeper);
  (void)seen(page);  // looks
  sign_out(page);
  until_all_is_done();
  page.opened();
  (void)seen(page);
  until_all_is_done();
  EXPECT_TRUE(seen(page).status->looked);
}

TEST_F(PageTest, TheFirstPageTellsOnceThatTheDiskDoesNotAnswer) {
  services.folder = folder.path() / "gone";
  const auto made = device_controller(services, ui::StaffPage::Menu);
  PageController& page = *made;
  page.opened();
  for (int look = 0; look < 5; ++look) {
    (void)seen(page);
    until_all_is_done();
    world.ahead_s += 3;
  }
  EXPECT_EQ(log.faults().size(), 1U) << "the log has room for 200 lines";
  services.folder = folder.path();
  (void)seen(page);
  until_all_is_done();
  EXPECT_TRUE(seen(page).status->looked) << "and goes on looking";
}

class TellsNothing final : public test::FaultyStore {
 public:
  using FaultyStore::FaultyStore;
  Result<std::vector<storage::Subject>> subjects(const storage::SubjectFilter&) override {
    return Error{Errc::IoFailed, "as the test says"};
  }
};

TEST_F(PageTest, ACodeThatTheStoreCannotAnswerForIsNotNobodys) {
  const std::atomic<std::optional<Errc>> none{};
  TellsNothing silent(storage::test::opened(folder.path() / "silent"), none);
  const std::atomic<bool> cancelled{false};
  pipeline::Progress progress;
  JobControl control{cancelled, progress};
  storage::Subject whose;
  whose.receipt = 482190375512;
  const auto found = chosen_records(silent, {receipt_of(whose), {}}, control);
  ASSERT_FALSE(found.has_value());
  EXPECT_EQ(found.error().code, Errc::IoFailed);
}

class RefusesTheFirst final : public test::FaultyStore {
 public:
  using FaultyStore::FaultyStore;
  Result<void> set_setting(std::string_view key, std::string_view value) override {
    if (!std::exchange(refused_, true)) return Error{Errc::MediaFull, "as the test says"};
    return FaultyStore::set_setting(key, value);
  }

 private:
  bool refused_ = false;
};

TEST_F(PageTest, ATouchMapThatCannotBeWrittenTouchesNoNewerOneAndNoTrial) {
  const std::atomic<std::optional<Errc>> none{};
  RefusesTheFirst refuses(storage::test::opened(folder.path() / "touch"), none);
  TouchTrial trial(refuses, side_tasks, log, device.clock());
  // A panel that tells only so much of the way.
  const auto keep = [&](float share) {
    trial.begin();
    for (const ui::TouchPoint at :
         {ui::TouchPoint{0.1F, 0.1F}, {0.9F, 0.1F}, {0.9F, 0.9F}, {0.1F, 0.9F}, {0.5F, 0.5F}})
      trial.touched({share * at.x, share * at.y}, at);
    EXPECT_EQ(trial.view().verdict, ui::TouchVerdict::Kept);
  };
  keep_busy(JobLane::Keeper);
  keep(0.9F);  // is not written
  keep(0.8F);
  trial.begin();
  until_all_is_done();
  EXPECT_TRUE(trial.takes_fingers());
  trial.abandon();
  EXPECT_NEAR(trial.placed({ui::Input::Kind::Down, 7, 40, 40}, 100, 100).x, 50, 0.1);
}

}  // namespace
}  // namespace relievo::firmware
