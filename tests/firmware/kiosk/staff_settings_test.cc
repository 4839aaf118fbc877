// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The staff's settings through their page: in force at once, kept over a restart, checked, each by who may.
#include <algorithm>
#include <atomic>
#include <optional>

#include "firmware/base/budget.h"
#include "firmware/service/device_settings.h"
#include "firmware/technician/test_capture.h"
#include "tests/firmware/kiosk/staff_hands.h"
#include "tests/support/faulty_store.h"
#include "ui/view/staff_views.h"

namespace relievo::firmware {
namespace {

using ui::Setting;

class StaffSettingsTest : public StaffHands {
 protected:
  StaffSettingsTest() { changes.clock = &time; }
  void choose(const std::string& button, Setting setting, std::int32_t value) {
    tap(button);
    ASSERT_TRUE(until([&] { return kiosk->staff().settings().of(setting) == value; })) << button;
    EXPECT_EQ(kiosk->view().service->work.outcome, ui::Outcome::Done);
  }
  void store_setting(const char* key, const std::string& value) {
    auto store = storage::open_sqlite_store(args.store, time, {});
    ASSERT_TRUE(store.has_value());
    ASSERT_TRUE((*store)->set_setting(key, value).has_value());
  }
  // How often, all starts together.
  std::ptrdiff_t logged(std::string_view words) const {
    return std::ranges::count_if(kiosk->staff().log().entries(), [&](const ui::LogLine& entry) {
      return entry.text.find(words) != std::string::npos;
    });
  }
  std::size_t records() {
    auto store = storage::open_sqlite_store(args.store, time, {});
    return store ? (*store)->subjects({})->size() : 0;
  }
  hal::ManualClock time;
};

TEST_F(StaffSettingsTest, WhatIsChosenHoldsAtOnceAndOverARestart) {
  start();
  first_start();
  sign_in("4711", StaffRole::Technician);
  tap("open settings");
  EXPECT_EQ(find("keep_days more"), nullptr) << "the operator's";
  choose("language more", Setting::Language, static_cast<int>(ui::Language::German));
  EXPECT_EQ(kiosk->ui().visit().language, ui::Language::German) << "nobody's visit has begun";
  choose("text_percent more", Setting::TextPercent, 125);
  choose("patience_s less", Setting::PatienceS, 30);
  choose("staff_patience_s less", Setting::StaffPatienceS, 60);
  choose("automatic_shot less", Setting::Automatic, 0);
  EXPECT_EQ(find("automatic_shot less")->action.kind, ui::ActionKind::None) << "there is nothing before off";
  // Signed out after the time that was chosen, not the usual one.
  time.advance(std::chrono::seconds(61));
  ASSERT_TRUE(until([this] { return !kiosk->ui().service().open; }));
  kiosk.reset();

  start();
  EXPECT_EQ(kiosk->ui().visit().language, ui::Language::German);
  EXPECT_EQ(kiosk->ui().visit().text_percent(), 125);
  ui::LiveView good;
  good.advice = pipeline::Advice::None;
  good.steady_s = 9;
  EXPECT_FALSE(kiosk->ui().visit().countdown(good).has_value()) << "no picture is taken by itself";
  // A visitor who is gone is asked after 30 s.
  tap("start");
  time.advance(std::chrono::seconds(31));
  kiosk->turn();
  EXPECT_EQ(kiosk->ui().visit().overlay, ui::Overlay::StillThere);
}

TEST_F(StaffSettingsTest, AVisitBeginsInTheLanguageTheDeviceWasSetUpIn) {
  start();
  knock();
  tap("fr");
  tap("go on");
  tap("sign out");  // nobody has shown that the device is theirs
  kiosk->turn();
  EXPECT_EQ(kiosk->staff().settings().of(Setting::Language), static_cast<int>(ui::Language::English));
  knock();
  tap("de");
  choose_pins();
  ASSERT_TRUE(until([this] {
    return kiosk->staff().settings().of(Setting::Language) == static_cast<int>(ui::Language::German);
  }));
  tap("sign out");
  time.advance(std::chrono::minutes(5));
  kiosk->turn();
  EXPECT_EQ(kiosk->ui().visit().language, ui::Language::German);
  kiosk.reset();
  start();
  EXPECT_EQ(kiosk->ui().visit().language, ui::Language::German);
}

TEST_F(StaffSettingsTest, HowTheStaffReadTheirPagesIsNotHowAVisitBegins) {
  start();
  first_start();
  sign_in("4711", StaffRole::Technician);
  tap("bigger");
  tap("contrast");
  tap("language");
  tap("ar");
  EXPECT_EQ(kiosk->ui().visit().language, ui::Language::Arabic);
  sign_out();
  EXPECT_EQ(kiosk->ui().visit().language, ui::Language::English) << "at once: a visitor may stand there";
  EXPECT_EQ(kiosk->ui().visit().text_percent(), 100);
  EXPECT_FALSE(kiosk->ui().visit().high_contrast);
}

TEST_F(StaffSettingsTest, EachStandsOnThePageOfWhoMayChooseIt) {
  start();
  first_start();
  for (const auto& [pin, role] : {std::pair("4711", StaffRole::Technician), {"80526", StaffRole::Operator}}) {
    sign_in(pin, role);
    tap("open settings");
    for (std::size_t i = 0; i < ui::kSettings; ++i) {
      const ui::SettingInfo& info = ui::info_of(static_cast<Setting>(i));
      EXPECT_EQ(find(std::string(info.key) + " more") != nullptr,
                role == StaffRole::Technician ? info.for_technician : info.for_operator)
          << info.key;
    }
    sign_out();
  }
}

TEST_F(StaffSettingsTest, AValueThatIsNoneLeavesTheUsualOneAndIsTold) {
  store_setting(kDeviceSetting, "patience_s 1\nattempts 2\nnonsense\n");
  start();
  EXPECT_EQ(kiosk->staff().settings().of(Setting::PatienceS), 45);
  EXPECT_EQ(kiosk->staff().settings().of(Setting::Attempts), 2);
  first_start();
  sign_in("4711", StaffRole::Technician);
  tap("open log");
  int told = 0;
  for (const ui::LogLine& line : kiosk->view().service->log->lines)
    told += line.text.find("what is usual holds") != std::string_view::npos ? 1 : 0;
  EXPECT_EQ(told, 2);
}

// Or the page that mends it is never reached.
TEST_F(StaffSettingsTest, AChoiceOfAlgorithmsThatIsNoneLeavesTheUsualOneAndIsTold) {
  store_setting(kAlgorithmsSetting, "matcher = unheard-of\nmesher = delaunay\nssd.window_px = 10\n");
  start();
  EXPECT_EQ(logged("“matcher = unheard-of” is not one: what is usual holds"), 1);
  EXPECT_EQ(logged("“ssd.window_px = 10” is not one: what is usual holds"), 1);
  first_start();
  sign_in("4711", StaffRole::Technician);
  tap("open algorithms");
  const auto chosen = [this](std::string_view key) {
    for (const ui::TechnicianKind& kind : kiosk->view().service->technician->choice.kinds)
      if (kind.key == key) return kind.value;
    return std::string_view();
  };
  EXPECT_EQ(chosen("matcher"), "refined");
  EXPECT_EQ(chosen("mesher"), "delaunay") << "the rest is kept";
  kiosk.reset();

  store_setting(kAlgorithmsSetting, "selector = harris\nmesher = unheard-of\n");
  start();
  EXPECT_EQ(logged("“algorithms” is not one: what is usual holds"), 1)
      << "what is left does not fit together";
}

TEST_F(StaffSettingsTest, WhoseMouseOnlyMovesIsThereForTheMachineToo) {
  start();
  first_start();
  sign_in("4711", StaffRole::Technician);
  for (hal::Instant end = time.now() + 2 * budget::kStaffLimit; time.now() < end;) {
    time.advance(std::chrono::seconds(100));
    kiosk->feed({ui::Input::Kind::Move, ui::kMouse, 1, 1});
    kiosk->turn();
    ASSERT_EQ(kiosk->appliance().state(), State::Staff);
  }
}

// Takes its time over the next setting, and does not take it.
class NextSettingFails final : public test::FaultyStore {
 public:
  using FaultyStore::FaultyStore;
  Result<void> set_setting(std::string_view key, std::string_view value) override {
    if (key != kDeviceSetting || !fails.exchange(false)) return FaultyStore::set_setting(key, value);
    go_on.wait(false);
    return Error{Errc::MediaFull, "as the test says"};
  }
  std::atomic<bool> fails{false}, go_on{false};
};

TEST_F(StaffSettingsTest, WhatCannotBeWrittenTakesNothingWithItThatCan) {
  static const std::atomic<std::optional<Errc>> none{};  // outlives the kiosk
  NextSettingFails* store = nullptr;
  services.open_store = [&](const Path& at, bool) -> Result<std::unique_ptr<storage::Store>> {
    RELIEVO_TRY_ASSIGN(auto real, storage::open_sqlite_store(at, time, {}));
    auto made = std::make_unique<NextSettingFails>(std::move(real), none);
    store = made.get();
    return std::unique_ptr<storage::Store>(std::move(made));
  };
  start();
  first_start();
  sign_in("4711", StaffRole::Technician);
  tap("open settings");
  const int before = kiosk->staff().settings().of(Setting::TextPercent);
  store->fails = true;
  tap("text_percent more");
  tap("patience_s less");  // waits for the one before
  store->go_on = true;
  store->go_on.notify_all();
  ASSERT_TRUE(until([this] { return kiosk->staff().settings().of(Setting::PatienceS) == 30; }));
  EXPECT_EQ(kiosk->staff().settings().of(Setting::TextPercent), before) << "not written: it does not hold";
  choose("staff_patience_s less", Setting::StaffPatienceS, 60);
  EXPECT_EQ(kiosk->staff().settings().of(Setting::PatienceS), 30) << "written: it holds";
  kiosk.reset();

  start();
  EXPECT_EQ(kiosk->staff().settings().of(Setting::TextPercent), before);
  EXPECT_EQ(kiosk->staff().settings().of(Setting::PatienceS), 30);
  EXPECT_EQ(kiosk->staff().settings().of(Setting::StaffPatienceS), 60);
  kiosk.reset();  // before what its store borrows
}

// Erased by age: not while somebody is inside, not after the clock has jumped.
TEST_F(StaffSettingsTest, RecordsAreErasedWhenTheirTimeIsOver) {
  enrol("Ada Lovelace");  // her consent bears the date 1970
  start();
  first_start();
  sign_in("80526", StaffRole::Operator);
  tap("open settings");
  EXPECT_EQ(find("attempts more"), nullptr) << "the technician's";
  choose("keep_days more", Setting::KeepDays, 1825);
  time.advance(std::chrono::hours(24) * 90);
  ASSERT_TRUE(until([this] { return !kiosk->ui().service().open; }));
  ASSERT_TRUE(until([this] { return logged("far ahead") == 1; }));
  kiosk.reset();
  EXPECT_EQ(records(), 1U) << "ninety days at once are no clock to erase by";

  start();
  // Only while nobody is at the screen: who signs in first is not kept waiting.
  ASSERT_TRUE(until([this] { return logged("far ahead") == 2; })) << "looked at again after every start";
  sign_in("80526", StaffRole::Operator);
  tap("open settings");
  EXPECT_TRUE(until([this] { return kiosk->view().service->settings->clock_jumped; }));
  choose("keep_days more", Setting::KeepDays, 1095);
  EXPECT_EQ(logged("erased for their age"), 0);
  sign_out();
  ASSERT_TRUE(until([this] { return logged("erased for their age") == 1; }));
  kiosk.reset();
  EXPECT_EQ(records(), 0U);
}

}  // namespace
}  // namespace relievo::firmware
