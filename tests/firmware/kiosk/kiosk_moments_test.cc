// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The real kiosk in bad and in special moments: a wrong clock, a start after a crash, a camera that is
// pulled, the operator's own consent text, somebody who is in the records already. The cameras are
// played: grey pictures, faults and a clock as the test says.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <fstream>
#include <thread>

#include "firmware/base/wall_time.h"
#include "firmware/kiosk/kiosk.h"
#include "firmware/records/receipt.h"
#include "hal/clock.h"
#include "hal/sim/device.h"
#include "pipeline/calibrate/file/calibration_file.h"
#include "storage/sqlite/sqlite_store.h"
#include "tests/firmware/kiosk/kiosk_hands.h"
#include "tests/support/faulty_store.h"
#include "tests/support/played_device.h"
#include "tests/support/temporary_folder.h"

namespace relievo::firmware {
namespace {

constexpr int kWidthPx = 1920, kHeightPx = 1200;  // as the calibration of the simulated rig

class KioskMomentsTest : public KioskHands {
 protected:
  KioskMomentsTest() {
    EXPECT_TRUE(ui::prepare_languages().has_value());
    args.store = folder.path() / "store";
    std::filesystem::create_directories(args.store);
    services.open_device = [this](std::string_view) -> Result<std::unique_ptr<hal::Device>> {
      return std::unique_ptr<hal::Device>(std::make_unique<test::PlayedDevice>(world, kWidthPx, kHeightPx));
    };
    services.open_store = [this](const Path& at, bool) { return storage::open_sqlite_store(at, clock, {}); };
    services.simulated_calibration = [this]() -> Result<pipeline::StereoCalibration> {
      RELIEVO_TRY(hal::sim::write_rig(folder.path() / "rig.yml", hal::sim::make_rig({})));
      return pipeline::read_calibration(folder.path() / "rig.yml");
    };
  }
  void open() {
    auto opened = Kiosk::open(args, services);
    ASSERT_TRUE(opened.has_value()) << opened.error().where() << opened.error().what.view();
    kiosk = std::move(*opened);
    kiosk->ui().resize(1280, 800);
  }
  void type_name(std::string_view name) {
    ASSERT_TRUE(reach(ui::Step::Attract));
    tap("start");
    tap("agree");
    kiosk->ui().visit().type(name);
    kiosk->turn();
    tap("done");
  }
  void erase_all() {
    ASSERT_EQ(kiosk->ui().visit().step, ui::Step::Name);
    while (!kiosk->ui().visit().name().empty()) tap("erase");
  }
  // Returns their code.
  std::string put_into_the_store(const char* name) {
    auto store = storage::open_sqlite_store(args.store, clock, {});
    EXPECT_TRUE(store.has_value());
    return receipt_of(*(*store)->subject(*(*store)->add_subject({name})));
  }

  // As somebody types it who does not look for the dash.
  static std::string spaced(std::string code) {
    std::replace(code.begin(), code.end(), '-', ' ');
    return code;
  }

  std::string log_file() const { return test::read_text(args.store / kLogFile); }
  bool is_logged(ui::LogEvent event) const {
    const auto entries = kiosk->staff().log().entries();
    return std::ranges::count(entries, std::optional(event), &ui::LogLine::event) > 0;
  }

  test::PlayedWorld world;
  test::TemporaryFolder folder;
  hal::MonotonicClock clock;
  Console console;
  Services services{.console = console, .clock = clock};
  KioskArgs args;
};

TEST_F(KioskMomentsTest, AWrongClockBarsTheWayUntilItIsSet) {
  put_into_the_store("Ada");
  world.wall_shift_s = -40 * 86'400;  // before the newest record
  testing::internal::CaptureStderr();
  open();
  ASSERT_TRUE(reach(ui::Step::Trouble));
  const std::string told = testing::internal::GetCapturedStderr();
  for (const auto& time : {stick_name_of(kiosk->view().wall_now), stick_name_of(clock.wall_now())})
    EXPECT_NE(told.find(time.substr(0, 10)), std::string::npos) << told;
  const auto logged = [this] {
    return std::ranges::count_if(kiosk->staff().log().faults(), [](const ui::LogLine& line) {
      return line.text.find("the clock is before 2026") != std::string::npos;
    });
  };
  EXPECT_EQ(logged(), 1) << "once, not every turn";
  EXPECT_TRUE(says("clock")) << "its own words";
  EXPECT_EQ(find("finish"), nullptr) << "nobody may consent now";
  world.wall_shift_s = 0;
  EXPECT_TRUE(reach(ui::Step::Attract)) << "it goes on by itself";
  world.wall_shift_s = -40 * 86'400;
  kiosk->turn();
  EXPECT_EQ(logged(), 2);
}

TEST_F(KioskMomentsTest, AnotherAppliancesDateSaysNothingOfThisClock) {
  {
    auto store = storage::open_sqlite_store(args.store, clock, {});
    ASSERT_TRUE(store.has_value());
    const auto ahead =
        std::chrono::floor<std::chrono::milliseconds>(clock.wall_now()) + std::chrono::years(1);
    ASSERT_TRUE((*store)->add_person({"Ada", 123'456'789'012, ahead, {}}).has_value());
  }
  open();
  EXPECT_TRUE(reach(ui::Step::Attract));
  EXPECT_EQ(kiosk->view().out_of_order, ui::Trouble::None);
}

TEST_F(KioskMomentsTest, AfterACrashItIsSaidOnce) {
  open();
  EXPECT_TRUE(std::filesystem::exists(args.store / "relievo.running"));
  kiosk.reset();
  EXPECT_FALSE(std::filesystem::exists(args.store / "relievo.running")) << "it ended as it should";
  open();
  EXPECT_FALSE(is_logged(ui::LogEvent::EndedEarly));
  kiosk.reset();
  std::ofstream(args.store / "relievo.running").put('\n');  // the power went
  open();
  EXPECT_TRUE(is_logged(ui::LogEvent::EndedEarly));
  ASSERT_TRUE(reach(ui::Step::Trouble));
  EXPECT_TRUE(says("restarted"));
  tap("finish");
  ASSERT_TRUE(reach(ui::Step::Attract));
  for (int turn = 0; turn < 5; ++turn) kiosk->turn();
  EXPECT_EQ(kiosk->ui().visit().step, ui::Step::Attract) << "once";
}

// Whoever administers the machine reads it in the journal and in the file, though nobody can open a page.
TEST_F(KioskMomentsTest, AKioskThatCannotWorkWritesOnceWhy) {
  const auto lines_in = [](const std::string& text) {
    std::size_t lines = 0;
    for (std::size_t at = 0; (at = text.find("as the test says", at)) != std::string::npos; ++at) ++lines;
    return lines;
  };
  world.pulled = true;
  open();
  testing::internal::CaptureStderr();
  int tests = 0;
  State before = State::SelfTest;
  EXPECT_TRUE(until([&] {
    const State state = kiosk->appliance().state();
    tests += before == State::SelfTest && state == State::Fault ? 1 : 0;
    if (state == State::Fault && lines_in(log_file()) > 0) world.ahead_s += 10;  // as long as a fault waits
    before = state;
    return tests == 3;
  })) << log_file();
  EXPECT_EQ(lines_in(testing::internal::GetCapturedStderr()), 1U);
  kiosk.reset();
  EXPECT_EQ(lines_in(log_file()), 1U) << log_file();
}

TEST_F(KioskMomentsTest, WhatHasHappenedIsWrittenWhenItCloses) {
  const auto mode = [this](const char* name) {
    return std::filesystem::status(args.store / name).permissions();
  };
  open();
  EXPECT_EQ(mode("relievo.running"), std::filesystem::perms(0600));
  kiosk.reset();
  EXPECT_EQ(log_file(), "") << "one that never showed anything has nothing to say";
  open();
  kiosk->turn();
  kiosk.reset();
  EXPECT_NE(log_file().find("Started"), std::string::npos);
  EXPECT_EQ(mode(kLogFile), std::filesystem::perms(0600)) << "the folder may be open to others";
}

TEST_F(KioskMomentsTest, APulledCameraIsSaidAndNothingOfThePersonStays) {
  open();
  type_name("Grace Hopper");
  ASSERT_TRUE(reach(ui::Step::Position));
  (void)kiosk->take_forgotten();
  world.pulled = true;
  ASSERT_TRUE(reach(ui::Step::Trouble));
  EXPECT_EQ(kiosk->view().trouble, ui::Trouble::Camera);
  EXPECT_TRUE(says("camera"));
  EXPECT_FALSE(says("Grace"));
  EXPECT_EQ(kiosk->ui().visit().name(), "");
  EXPECT_FALSE(kiosk->appliance().session().is_open());
  EXPECT_TRUE(
      kiosk->ui().draw_list().pictures[static_cast<std::size_t>(ui::PictureSlot::Live)].pixels.empty());
}

TEST_F(KioskMomentsTest, ThreeRefusedPicturesHaveTheirWordsAndAWayOn) {
  open();
  type_name("Grace Hopper");
  for (int picture = 0; picture < 3; ++picture) {
    ASSERT_TRUE(until([this] {
      return kiosk->ui().visit().step == ui::Step::Position && find("shoot") != nullptr &&
             kiosk->view().screen == ui::Screen::Position;
    }));
    tap("shoot");  // of nobody: grey pictures
    ASSERT_TRUE(until([this] { return kiosk->view().screen != ui::Screen::Position; }));
  }
  ASSERT_TRUE(reach(ui::Step::Trouble));
  EXPECT_EQ(kiosk->view().trouble, ui::Trouble::Refused);
  EXPECT_TRUE(says("did not work"));
  EXPECT_FALSE(says("Grace"));
  EXPECT_FALSE(kiosk->appliance().session().is_open());
  tap("finish");
  EXPECT_TRUE(reach(ui::Step::Attract));
  EXPECT_EQ(kiosk->ui().visit().name(), "");
}

TEST_F(KioskMomentsTest, TheOperatorsOwnTextIsShownInItsLanguagesAlone) {
  const auto write = [this](const char* version, const char* file, const char* words) {
    std::filesystem::create_directories(args.store / "consent" / version);
    std::ofstream(args.store / "consent" / version / file) << words;
  };
  write("2026-03", "en.txt", "An older title\n\nA point\n");
  write("2026-09", "de.txt",
        "Unser Text\r\n\r\nErster Punkt\r\nmit Worten,\r\nüber zwei Zeilen.\r\n\r\nZweiter Punkt\r\n");
  open();
  ASSERT_TRUE(reach(ui::Step::Attract));
  EXPECT_EQ(kiosk->ui().visit().language, ui::Language::German)
      << "English has no text that can be agreed to";
  EXPECT_EQ(find("en"), nullptr);
  tap("start");
  EXPECT_TRUE(says("Unser Text"));
  EXPECT_TRUE(says("mit Worten, über zwei Zeilen."));
  EXPECT_TRUE(says("Zweiter Punkt"));
  EXPECT_FALSE(says("Mustertext"));
  ASSERT_NE(kiosk->view().consent, nullptr);
  EXPECT_EQ(kiosk->view().consent->version, "2026-09") << "stored with the record";
  kiosk.reset();
  for (const char* bad : {"", "A title alone\n", "T\n\n\xC3\x28\n", "T\n\nbell \a\n"}) {
    write("2026-09", "fr.txt", bad);
    const auto refused = Kiosk::open(args, services);
    ASSERT_FALSE(refused.has_value()) << bad;
    EXPECT_NE(std::string(refused.error().where()).find("fr.txt"), std::string::npos);
  }
}

TEST_F(KioskMomentsTest, WhoIsInTheRecordsIsToldAndProvesItByTheCode) {
  const std::string code = put_into_the_store("Ada"), other = put_into_the_store("Bob");
  open();
  type_name("Ada");
  ASSERT_TRUE(reach(ui::Step::Known));
  EXPECT_EQ(kiosk->appliance().state(), State::Idle) << "no camera runs yet";
  EXPECT_EQ(find("renew"), nullptr) << "a name proves nothing";
  EXPECT_FALSE(says(code)) << "the code is not given away";
  tap("have_code");
  for (const std::string& tried :
       {other, std::string("12345678901234"),
        std::string("00000000000195")}) {  // the last: the number of the record, as codes once were
    erase_all();
    kiosk->ui().visit().type(tried);
    kiosk->turn();
    tap("done");
    for (int turn = 0; turn < 2000 && kiosk->view().known != ui::Known::NoSuchCode; ++turn) {
      kiosk->turn();
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    EXPECT_EQ(kiosk->ui().visit().step, ui::Step::Name);
    EXPECT_NE(find("wrong_code"), nullptr) << tried;
    EXPECT_TRUE(says("Type your code")) << "the question stands beside the answer";
  }
  erase_all();
  kiosk->ui().visit().type(spaced(code));
  kiosk->turn();
  tap("done");
  ASSERT_TRUE(reach(ui::Step::Known));
  tap("renew");
  ASSERT_TRUE(reach(ui::Step::Position));
  EXPECT_EQ(kiosk->appliance().session().subject(), "Ada");
  EXPECT_LE(kiosk->ui().visit().touches, 9);
}

TEST_F(KioskMomentsTest, AfterTenWrongCodesAnHourTheRightOneIsNoneEither) {
  const std::string code = put_into_the_store("Ada");
  const auto quote = [this](const std::string& tried) {
    type_name("Ada");
    ASSERT_TRUE(reach(ui::Step::Known));
    tap("have_code");
    kiosk->ui().visit().type(tried);
    kiosk->turn();
    tap("done");
    ASSERT_TRUE(until([this] {
      return kiosk->view().known == ui::Known::NoSuchCode || kiosk->view().known == ui::Known::Code;
    }));
  };
  for (int start = 0; start < 2; ++start) {  // a start of the program gives no further try
    open();
    for (int visit = 0; visit < 5; ++visit) {
      quote("00000000099911");
      EXPECT_EQ(kiosk->view().known, ui::Known::NoSuchCode);
      tap("leave");
      tap("answer_quiet");
    }
    kiosk.reset();
  }
  open();
  quote(code);
  EXPECT_EQ(kiosk->view().known, ui::Known::NoSuchCode) << "not even that it is one";
  kiosk.reset();
  world.wall_shift_s = 3700;
  open();
  quote(code);
  EXPECT_EQ(kiosk->view().known, ui::Known::Code);
}

// A store that does not say how many codes were wrong, until it may.
class SlowCodes final : public test::FaultyStore {
 public:
  SlowCodes(std::unique_ptr<storage::Store> real, const std::atomic<bool>& held)
      : FaultyStore(std::move(real), none_), held_(held) {}
  Result<std::string> setting(std::string_view key) override {
    if (key == kCodesSetting) held_.wait(true);
    return FaultyStore::setting(key);
  }

 private:
  std::atomic<std::optional<Errc>> none_;
  const std::atomic<bool>& held_;
};

TEST_F(KioskMomentsTest, ANameIsAskedForThoughTheRecordsStillLookForTheCodeBeforeIt) {
  put_into_the_store("Ada");
  std::atomic<bool> held{true};
  services.open_store = [&](const Path& at, bool) -> Result<std::unique_ptr<storage::Store>> {
    RELIEVO_TRY_ASSIGN(auto real, storage::open_sqlite_store(at, clock, {}));
    return std::unique_ptr<storage::Store>(std::make_unique<SlowCodes>(std::move(real), held));
  };
  open();
  type_name("Ada");
  ASSERT_TRUE(reach(ui::Step::Known));
  tap("have_code");
  kiosk->ui().visit().type("00000000099911");
  kiosk->turn();
  tap("done");
  EXPECT_EQ(kiosk->view().known, ui::Known::Asking);
  kiosk->feed({ui::Input::Kind::Back});
  kiosk->turn();
  kiosk->ui().visit().type("Bob");
  kiosk->turn();
  std::thread disk([&held] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    held = false;
    held.notify_all();
  });
  tap("done");
  disk.join();
  EXPECT_TRUE(reach(ui::Step::Position));
  EXPECT_EQ(kiosk->appliance().session().subject(), "Bob");
  kiosk.reset();  // its store reads `held`
}

TEST_F(KioskMomentsTest, WhereTheOperatorWantsItNobodyIsTold) {
  put_into_the_store("Ada");
  args.tells_known = false;
  open();
  type_name("Ada");
  EXPECT_TRUE(reach(ui::Step::Position));
}

}  // namespace
}  // namespace relievo::firmware
