// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The staff's pages alone, on threads that are busy with something else: what somebody asked for who signs
// out before its turn has come.
#include "firmware/service/page/test_controllers.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "firmware/service/page/records_controller.h"
#include "tests/firmware/played_appliance.h"
#include "tests/storage/sample.h"
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
  ConsentTextStore consent{folder.path(), device.media(), side_tasks, log};
  std::uint32_t revision = 0;
  PageServices services{appliance, device,    *store, side_tasks, log,           statistics, costs,
                        settings,  retention, touch,  consent,    folder.path(), revision};
};

TEST_F(PageTest, WhoseErasureWasConfirmedIsErasedThoughTheOperatorSignsOutMeanwhile) {
  const pipeline::FaceModel model = storage::test::sample_model();
  ASSERT_TRUE(store->add_enrolment(storage::NewSubject{"Ada"}, storage::test::sample_enrolment(model)));
  const auto whom = store->subjects({});
  ASSERT_TRUE(whom && whom->size() == 1);
  RecordsController page(services);
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
  SelfTestController page(services);
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
  TriggerController page(services);
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

TEST_F(PageTest, TheDeviceIsLookedAtAgainAfterALookThatSigningOutCancelled) {
  StatusController page(services);
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

}  // namespace
}  // namespace relievo::firmware
