// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The staff's side by synthetic fingers, the whole appliance behind it: first start, both roles, their
// pages on the real objects, and what is left when they have gone.
#include "firmware/records/event_log.h"
#include "firmware/service/access.h"
#include "tests/firmware/kiosk/staff_hands.h"
#include "tests/support/faulty_store.h"
#include "ui/view/staff_views.h"

namespace relievo::firmware {
namespace {

class StaffRoundTest : public StaffHands {
 protected:
  void test_the_device() {
    tap("open self test");
    tap("begin");
    ASSERT_TRUE(until([this] { return !kiosk->view().service->work.running; }));
    const ui::SelfTestView& tested = *kiosk->view().service->self_test;
    const auto state = [&](ui::Check check) { return tested.states[static_cast<std::size_t>(check)]; };
    EXPECT_EQ(state(ui::Check::Store), ui::CheckState::Good);
    EXPECT_EQ(state(ui::Check::Cameras), ui::CheckState::Good);
    EXPECT_EQ(state(ui::Check::Calibration), ui::CheckState::Good)
        << "known to the store and measured with, though none is active";
    tap("back");
    tap("open trigger");
    tap("begin");
    ASSERT_TRUE(until([this] { return kiosk->view().service->trigger->ended; }));
    EXPECT_EQ(kiosk->view().service->trigger->pulses, 10);
    EXPECT_EQ(kiosk->view().service->trigger->pairs, 10);
    tap("back");
    tap("open log");
    bool signed_in = false;
    for (const ui::LogLine& line : kiosk->view().service->log->lines)
      signed_in = signed_in || line.event == ui::LogEvent::TechnicianSignedIn;
    EXPECT_TRUE(signed_in);
    tap("back");
  }
};

TEST_F(StaffRoundTest, WhereRealPeopleStandNobodyGetsPastTheFirstStart) {
  changes.live = true;
  start();
  kiosk->turn();
  ASSERT_TRUE(kiosk->ui().service().open);
  EXPECT_EQ(kiosk->ui().service().page, StaffPage::FirstStart);
  EXPECT_EQ(find("start"), nullptr) << "no way to a visit";
  tap("sign out");
  kiosk->turn();
  EXPECT_EQ(kiosk->ui().service().page, StaffPage::FirstStart) << "leaving leads back here";
  ASSERT_TRUE(kiosk->ui().service().open);
  choose_pins();
  tap("sign out");
  ASSERT_TRUE(until([this] { return !kiosk->ui().service().open; }));
  EXPECT_NE(find("start"), nullptr);
}

TEST_F(StaffRoundTest, AFingerThatOnlyPassesDoesNotSignIn) {
  start();
  tap("staff");
  EXPECT_FALSE(kiosk->ui().service().open);
}

TEST_F(StaffRoundTest, WhoOnlyCameUponTheLockReadsOnAsTheyChose) {
  start();
  first_start();
  kiosk->feed({ui::Input::Kind::Back});
  kiosk->turn();
  ASSERT_FALSE(kiosk->ui().service().open);
  ui::Visit& visit = kiosk->ui().visit();
  visit.language = ui::Language::French;
  visit.text_size = 2;
  visit.high_contrast = true;
  knock();
  kiosk->feed({ui::Input::Kind::Back});
  kiosk->turn();
  ASSERT_FALSE(kiosk->ui().service().open);
  EXPECT_EQ(visit.language, ui::Language::French) << "they came upon the lock by chance";
  EXPECT_EQ(visit.text_size, 2U);
  EXPECT_TRUE(visit.high_contrast);
  sign_in("4711", StaffRole::Technician);
  sign_out();
  EXPECT_EQ(visit.language, ui::Language::English);
  EXPECT_EQ(visit.text_size, 0U);
  EXPECT_FALSE(visit.high_contrast);
}

TEST_F(StaffRoundTest, FirstStartThenEachRoleHasItsPages) {
  start();
  first_start();
  sign_in("4711", StaffRole::Technician);
  EXPECT_NE(find("open health"), nullptr);
  EXPECT_EQ(find("open statistics"), nullptr) << "the technician sees no operator's page";
  tap("open health");
  ASSERT_TRUE(until([this] { return find("gauge 0") != nullptr; }))
      << "the gauges are read beside the screen";
  tap("back");
  EXPECT_EQ(kiosk->ui().service().page, StaffPage::Menu);
  test_the_device();
  sign_out();
  sign_in("80526", StaffRole::Operator);
  EXPECT_EQ(find("open health"), nullptr);
  tap("open statistics");
  EXPECT_NE(find("visits"), nullptr);
  // A new PIN of one's own, through the page.
  tap("back");
  tap("open pins");
  type_pin("2718");
  type_pin("2718");
  sign_out();
  kiosk.reset();
  auto store = storage::open_sqlite_store(args.store, clock, {});
  ASSERT_TRUE(store.has_value());
  Access access(**store, clock);
  EXPECT_EQ(access.attempt("2718")->role, StaffRole::Operator);
}

TEST_F(StaffRoundTest, NothingOfAPinStaysWithTheStaffWhenItIsChosen) {
  start();
  first_start();
  ASSERT_TRUE(until([this] { return !kiosk->staff().side_tasks().busy(JobLane::Keeper); }))
      << "it writes, too";
  const StaffController& staff = kiosk->staff();
  const std::string_view bytes(reinterpret_cast<const char*>(&staff), sizeof staff);
  EXPECT_EQ(bytes.find("0526"), std::string_view::npos) << "80526, but for its first byte";
}

// A stick that is not there, and one that nothing can be written to: told, and nothing half-written.
TEST_F(StaffRoundTest, AnExportThatCannotEndWellSaysSoAndTheNextOneDoes) {
  open_records({"Ada Lovelace"});
  const auto outcome = [this] {
    tap("export all");
    until([this] { return kiosk->view().service->work.outcome != ui::Outcome::None; });
    return kiosk->view().service->work.outcome;
  };
  media->unplug();
  EXPECT_EQ(outcome(), ui::Outcome::NoStick);
  media->plug(stick());
  std::ofstream(stick() / "relievo") << "a file where the folder should be";
  EXPECT_EQ(outcome(), ui::Outcome::Failed);
  EXPECT_EQ(kiosk->appliance().state(), State::Staff);
  std::filesystem::remove(stick() / "relievo");
  EXPECT_EQ(outcome(), ui::Outcome::Done);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(stick()), {}), 1);
}

// Search, look, export, erase: on the store and on a stick that is a folder.
TEST_F(StaffRoundTest, TheOperatorFindsExportsAndErasesARecord) {
  open_records({"Ada Lovelace", "Grace Hopper"});
  tap("search");
  for (const char* key : {"key a", "key d", "key a"}) tap(key);
  tap("done");
  ASSERT_TRUE(until([this] { return find("record " + std::to_string(2)) == nullptr; }))
      << "only who was searched for";
  ASSERT_NE(find("searched"), nullptr);
  EXPECT_EQ(find("searched")->text, "ada") << "and it says so";
  tap("record " + std::to_string(1));
  ASSERT_TRUE(until([this] { return kiosk->ui().draw_list().faces[0].model != nullptr; }))
      << "the portrait is there to be turned";

  tap("export");
  ASSERT_TRUE(until([this] { return kiosk->view().service->work.outcome != ui::Outcome::None; }));
  EXPECT_EQ(kiosk->view().service->work.outcome, ui::Outcome::Done);
  EXPECT_EQ(kiosk->appliance().state(), State::Staff);
  const Path taken = stick() / "relievo" / code_of(1);
  EXPECT_TRUE(std::filesystem::exists(taken / "model.ply"));
  EXPECT_NE(text_of_file(taken / "record.txt").find("name: Ada Lovelace"), std::string::npos);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(stick() / "relievo"), {}), 1)
      << "nobody else, nothing half-written";

  tap("export");
  ASSERT_TRUE(until([this] { return kiosk->view().service->work.outcome != ui::Outcome::Done; }));
  ASSERT_TRUE(until([this] { return kiosk->view().service->work.outcome != ui::Outcome::None; }));
  EXPECT_EQ(kiosk->view().service->work.outcome, ui::Outcome::NoStick) << "it was let go after the export";

  tap("erase");
  rest_on("yes");
  ASSERT_TRUE(until([this] { return kiosk->view().service->work.outcome == ui::Outcome::Done; }));
  lift();
  sign_out();
  for (const ui::Node& node : kiosk->ui().tree().nodes())
    EXPECT_EQ(node.text.find("Hopper"), std::string_view::npos);
  EXPECT_EQ(kiosk->view().service->records, nullptr) << "no name is left";
  EXPECT_EQ(kiosk->ui().draw_list().faces[0].model, kiosk->view().invitation_head);
  kiosk.reset();
  auto store = storage::open_sqlite_store(args.store, clock, {});
  ASSERT_TRUE(store.has_value());
  const auto left = (*store)->subjects({});
  ASSERT_TRUE(left.has_value());
  ASSERT_EQ(left->size(), 1U);
  EXPECT_EQ(left->front().name, "Grace Hopper");
}

TEST_F(StaffRoundTest, AWrongPinOpensNothingAndIsCountedOverARestart) {
  start();
  first_start();
  type_pin("1999");
  EXPECT_TRUE(kiosk->view().service->access.wrong);
  EXPECT_EQ(kiosk->view().service->role, StaffRole::None);
  EXPECT_EQ(kiosk->appliance().state(), State::Idle);
  EXPECT_EQ(kiosk->ui().service().typed(), "") << "what was typed is wiped";
  kiosk.reset();
  auto store = storage::open_sqlite_store(args.store, clock, {});
  ASSERT_TRUE(store.has_value());
  const std::string kept = *(*store)->setting(kAccessSetting);
  EXPECT_NE(kept.find(" 1 "), std::string::npos) << kept;
}

// A store whose settings cannot be written, as a read-only disk's.
class LockedStore final : public test::FaultyStore {
 public:
  LockedStore(std::unique_ptr<storage::Store> real, const std::atomic<std::optional<Errc>>& error)
      : FaultyStore(std::move(real), error), locked_(error) {}
  Result<void> set_setting(std::string_view key, std::string_view value) override {
    if (const auto error = locked_.load()) return Error{*error, "as the test says"};
    return FaultyStore::set_setting(key, value);
  }

 private:
  const std::atomic<std::optional<Errc>>& locked_;
};

class LockedStoreTest : public StaffRoundTest {
 protected:
  LockedStoreTest() {
    services.open_store = [this](const Path& at, bool) -> Result<std::unique_ptr<storage::Store>> {
      RELIEVO_TRY_ASSIGN(auto real, storage::open_sqlite_store(at, wall(), {}));
      return std::unique_ptr<storage::Store>(std::make_unique<LockedStore>(std::move(real), error));
    };
  }
  void TearDown() override { kiosk.reset(); }  // its store reads the error
  const ui::AccessView& access() const { return kiosk->view().service->access; }
  std::atomic<std::optional<Errc>> error;
};

TEST_F(LockedStoreTest, APinThatCannotBeCheckedIsNotCalledWrong) {
  start();
  first_start();
  error = Errc::IoFailed;
  type_pin("1999");
  EXPECT_EQ(access().failed, Errc::IoFailed);
  EXPECT_FALSE(access().wrong);
  EXPECT_TRUE(says("Reading or writing failed"));
  error = std::nullopt;
  type_pin("1999");
  EXPECT_FALSE(access().failed);
  EXPECT_TRUE(access().wrong);
}

TEST_F(LockedStoreTest, APinThatCannotBeKeptIsNotCalledTooEasy) {
  start();
  first_start();
  sign_in("80526", StaffRole::Operator);
  tap("open pins");
  type_pin("2718");
  error = Errc::MediaFull;
  type_pin("2718");
  EXPECT_EQ(access().failed, Errc::MediaFull);
  EXPECT_EQ(access().fault, ui::PinFault::None);
  EXPECT_TRUE(says("There is no room left"));
  error = std::nullopt;
  for (int twice = 0; twice < 2; ++twice) type_pin("2718");
  EXPECT_EQ(access().step, ui::PinStep::Done);
}

// A store that does not answer about settings, a PIN's among them, until it may.
class SlowStore final : public test::FaultyStore {
 public:
  SlowStore(std::unique_ptr<storage::Store> real, const std::atomic<bool>& held)
      : FaultyStore(std::move(real), none_), held_(held) {}
  Result<std::string> setting(std::string_view key) override {
    held_.wait(true);
    return FaultyStore::setting(key);
  }

 private:
  std::atomic<std::optional<Errc>> none_;
  const std::atomic<bool>& held_;
};

class SlowStoreTest : public StaffRoundTest {
 protected:
  SlowStoreTest() {
    services.open_store = [this](const Path& at, bool) -> Result<std::unique_ptr<storage::Store>> {
      RELIEVO_TRY_ASSIGN(auto real, storage::open_sqlite_store(at, wall(), {}));
      return std::unique_ptr<storage::Store>(std::make_unique<SlowStore>(std::move(real), held));
    };
  }
  void TearDown() override {
    let_go_on();
    kiosk.reset();
  }
  void type_pin_and_go(std::string_view pin) {
    held = true;
    for (const char digit : pin) tap("digit " + std::string(1, digit));
    tap("pin done");
    ASSERT_TRUE(kiosk->view().service->access.checking);
    kiosk->feed({ui::Input::Kind::Back});
    kiosk->turn();
  }
  void let_go_on() {
    held = false;
    held.notify_all();
  }
  void until_checked() {
    let_go_on();
    ASSERT_TRUE(until([this] { return !kiosk->view().service->access.checking; }));
    kiosk->turn();
  }
  std::atomic<bool> held{false};
};

TEST_F(SlowStoreTest, ARightPinWhosePageWasLeftLetsInNobodyWhoComesNext) {
  start();
  first_start();
  type_pin_and_go("4711");
  EXPECT_FALSE(kiosk->ui().service().open);
  until_checked();
  EXPECT_EQ(kiosk->view().service->role, StaffRole::None);
  EXPECT_EQ(kiosk->appliance().state(), State::Idle);
  knock();
  kiosk->turn();
  EXPECT_EQ(kiosk->ui().service().page, StaffPage::Pin) << "the next one is asked for a PIN";
  // And comes while the one before is still being checked.
  type_pin_and_go("4711");
  knock();
  until_checked();
  EXPECT_EQ(kiosk->view().service->role, StaffRole::None);
  EXPECT_EQ(kiosk->ui().service().page, StaffPage::Pin);
  sign_in("4711", StaffRole::Technician);
}

TEST_F(SlowStoreTest, ANewPinWhosePageWasLeftIsNotHalfChosenOnTheNextPage) {
  start();
  first_start();
  sign_in("80526", StaffRole::Operator);
  tap("open pins");
  type_pin_and_go("2718");
  tap("open pins");
  until_checked();
  EXPECT_EQ(kiosk->view().service->access.step, ui::PinStep::Own);
  for (int twice = 0; twice < 2; ++twice) type_pin("2718");
  EXPECT_EQ(kiosk->view().service->access.step, ui::PinStep::Done);
}

TEST_F(StaffRoundTest, TheLogSpeaksTheReadersLanguageAlsoOfWhatWasNotedBeforeARestart) {
  std::filesystem::create_directories(args.store);
  std::ofstream(args.store / kLogFile)
      << "2026-03-14 10:21:09  noted by an earlier version\n2026-03-14 10:22:09  fault: of one, too\n";
  start();
  first_start();
  kiosk.reset();
  start();
  sign_in("4711", StaffRole::Technician);
  tap("open self test");
  tap("begin");
  ASSERT_TRUE(until([this] { return !kiosk->view().service->work.running; }));
  const auto speak = [this](ui::Language language) {
    kiosk->ui().visit().language = language;
    kiosk->turn();
  };
  speak(ui::Language::German);
  EXPECT_TRUE(says("In Ordnung") && says("Kalibrierung") && !says("In order")) << "the self-test, too";
  tap("back");
  tap("open log");
  const auto read = [this](std::string_view words) { EXPECT_TRUE(says(words)) << words; };
  for (const char* words :
       {"Angemeldet: ", "Eine neue PIN wurde gewählt: ", "noted by an earlier version", "of one, too"})
    read(words);
  EXPECT_FALSE(says("Signed in"));
  const auto& nodes = kiosk->ui().tree().nodes();
  EXPECT_TRUE(std::any_of(nodes.begin(), nodes.end(), [](const ui::Node& node) {
    return node.name == "Störung";
  })) << "not by its colour alone";
  speak(ui::Language::English);
  for (const char* words : {"Signed in: ", "A new PIN was chosen: "}) read(words);
  speak(ui::Language::Arabic);
  read("تسجيل دخول: ");
  for (const ui::LogLine& line : kiosk->view().service->log->lines)
    EXPECT_TRUE(line.at.starts_with("20")) << line.text;
}

}  // namespace
}  // namespace relievo::firmware
