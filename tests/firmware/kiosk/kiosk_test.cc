// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A whole enrolment by synthetic fingers, from the page that invites to a row in the store, on the
// simulated rig; and who leaves in the middle.
#include "firmware/kiosk/kiosk.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory_resource>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "firmware/kiosk/code/qr_code.h"
#include "firmware/records/receipt.h"
#include "hal/clock.h"
#include "hal/picture_file.h"
#include "hal/sim/device.h"
#include "hal/sim/replay/replay_device.h"
#include "pipeline/calibrate/file/calibration_file.h"
#include "storage/sqlite/sqlite_store.h"
#include "tests/firmware/kiosk/kiosk_hands.h"
#include "tests/support/faulty_store.h"
#include "tests/support/small_rig.h"
#include "tests/support/temporary_folder.h"

namespace relievo::firmware {
namespace {

// A printer that keeps what it was given; without paper until it is told.
class PlayedPrinter final : public hal::Printer {
 public:
  PlayedPrinter(std::vector<std::byte>& printed, const std::atomic<bool>& has_paper)
      : printed_(printed), has_paper_(has_paper) {}
  bool is_there() override { return true; }
  Result<void> print(std::span<const std::byte> png) override {
    if (!has_paper_) return Error{Errc::IoFailed, "no paper"};
    printed_.assign(png.begin(), png.end());
    return {};
  }

 private:
  std::vector<std::byte>& printed_;
  const std::atomic<bool>& has_paper_;
};

class KioskTest : public KioskHands {
 protected:
  KioskTest() {
    lend_small_rig(services, args, folder.path(), clock, test::small_device(0.3));
    services.open_store = [this](const Path& at, bool) -> Result<std::unique_ptr<storage::Store>> {
      RELIEVO_TRY_ASSIGN(auto real, storage::open_sqlite_store(at, clock, {}));
      return std::unique_ptr<storage::Store>(
          std::make_unique<test::FaultyStore>(std::move(real), store_error));
    };
    offer_to_take_home();
    services.make_printer = [this] { return std::make_unique<PlayedPrinter>(printed, has_paper); };
    open(args, services);
  }

  // The operator's own text says so, and their setting.
  void offer_to_take_home() {
    const Path texts = args.store / "consent" / "2026-03";
    std::filesystem::create_directories(texts);
    std::filesystem::create_directories(stick());
    test::write_text(texts / "en.txt", "What happens\n\nA portrait\nYou can take it with you.\n");
    test::write_text(texts / "link.txt", "https://museum.example/heads/{model}?from=kiosk\n");
    auto store = storage::open_sqlite_store(args.store, clock, {});
    ASSERT_TRUE(store.has_value());
    ASSERT_TRUE((*store)->set_setting("device", "take_home 1\n").has_value());
  }
  Path stick() const { return folder.path() / "stick"; }
  hal::FolderMedia& socket() const { return dynamic_cast<hal::FolderMedia&>(kiosk->device().media()); }
  void cameras_are_off() {
    EXPECT_TRUE(until([this] { return !kiosk->view().cameras_on; })) << "no camera runs";
    kiosk->turn();
    EXPECT_TRUE(says("The cameras are off")) << "and it is said";
  }
  void to_position() {
    ASSERT_TRUE(reach(ui::Step::Attract));
    cameras_are_off();
    tap("start");
    cameras_are_off();
    tap("agree");
    for (const char* key : {"key A", "key d", "key a"}) tap(key);
    EXPECT_EQ(kiosk->ui().visit().name(), "Ada");
    EXPECT_EQ(kiosk->appliance().state(), State::Idle) << "no camera runs yet";
    tap("done");
    ASSERT_TRUE(reach(ui::Step::Position));
  }

  void leave_before_the_picture() {
    to_position();
    EXPECT_TRUE(until([this] { return kiosk->view().cameras_on; }));
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
  const ImageView& live_picture() const {
    return kiosk->ui().draw_list().pictures[static_cast<std::size_t>(ui::PictureSlot::Live)].pixels;
  }

  void enrol_by_touch() {
    socket().plug(stick());
    played("pause 0.6\n");  // it is looked for twice a second
    // Nobody touches the screen after "done": the face stands still, and the picture is taken by itself.
    const Result<void> played = play(
        "wait attract\ntap start\ntap agree\ntype Ada\ntap done\nwait position\nwait working 600\nwait review 600\n");
    ASSERT_TRUE(played.has_value()) << played.error().where() << " advice "
                                    << static_cast<int>(kiosk->view().live.advice)
                                    << (kiosk->appliance().problem()
                                            ? kiosk->appliance().problem()->what.view()
                                            : "");
    kiosk->turn();
    EXPECT_NE(kiosk->ui().draw_list().faces[0].model, nullptr);
    for (const ui::Picture& stage : kiosk->view().stages)
      EXPECT_FALSE(stage.pixels.empty()) << "a stage has no picture";
    // Turned with a finger.
    const ui::Rect face = kiosk->ui().tree().find("face")->rect;
    kiosk->feed({ui::Input::Kind::Down, 1, face.x + 200, face.y + 200});
    kiosk->feed({ui::Input::Kind::Move, 1, face.x + 300, face.y + 200});
    kiosk->feed({ui::Input::Kind::Up, 1, face.x + 300, face.y + 200});
    EXPECT_GT(kiosk->ui().visit().look.yaw_deg, 10);
    store_error = Errc::MediaFull;
    tap("accept");
    ASSERT_TRUE(until([this] {
      return kiosk->view().trouble == ui::Trouble::StorageFull && kiosk->view().screen == ui::Screen::Review;
    }));
    EXPECT_EQ(kiosk->view().receipt, "") << "no code for what was not stored";
    EXPECT_NE(find("trouble"), nullptr) << "its own words";
    store_error = std::nullopt;
    tap("accept");  // the way on
    ASSERT_TRUE(reach(ui::Step::Thanks));
    kiosk->turn();
    code = kiosk->view().receipt;
    EXPECT_LE(kiosk->ui().visit().touches, 6);
    cameras_are_off();
    the_code_is_taken_home();
    tap("finish");
    EXPECT_EQ(kiosk->ui().visit().step, ui::Step::Attract);
    kiosk->turn();
    EXPECT_EQ(kiosk->view().receipt, "");
    EXPECT_TRUE(kiosk->take_forgotten());
  }

  // Photographed from the screen, or on paper.
  void the_code_is_taken_home() {
    const auto& shown = kiosk->ui().draw_list().pictures[static_cast<std::size_t>(ui::PictureSlot::Receipt)];
    EXPECT_EQ(read_code(shown.pixels), code);
    ASSERT_TRUE(until([this] { return find("print") != nullptr; }));
    tap("print");
    EXPECT_TRUE(until([this] { return says("It could not be printed"); }));
    EXPECT_TRUE(printed.empty());
    has_paper = true;
    tap("print");
    EXPECT_TRUE(until([this] { return says("It has been printed"); }));
    const auto paper = hal::decode_picture(printed.data(), printed.size());
    ASSERT_TRUE(paper.has_value());
    EXPECT_EQ(read_code(paper->view()), code);
    the_link_erases_nothing();
    the_model_is_taken_home();
  }
  void the_link_erases_nothing() {
    const auto& shown = kiosk->ui().draw_list().pictures[static_cast<std::size_t>(ui::PictureSlot::Link)];
    const std::string link = read_code(shown.pixels).value_or("no code");
    const std::string_view before = "https://museum.example/heads/", after = "?from=kiosk";
    ASSERT_TRUE(link.starts_with(before) && link.ends_with(after)) << link;
    const std::string number = link.substr(before.size(), link.size() - before.size() - after.size());
    EXPECT_EQ(number.size(), 32U);
    EXPECT_EQ(link.find(digits_of(code)), std::string::npos);
    EXPECT_FALSE(is_receipt(number));
    links.insert(number);
  }
  void the_model_is_taken_home() {
    EXPECT_TRUE(says("If it is yours, pull it out and plug it in again"));
    EXPECT_EQ(find("take_home"), nullptr);
    socket().unplug();
    ASSERT_TRUE(until([this] { return says("plug in a USB stick"); }));
    EXPECT_EQ(find("take_home"), nullptr);
    socket().plug(stick());
    ASSERT_TRUE(until([this] { return find("take_home") != nullptr; }));
    tap("take_home");
    EXPECT_EQ(find("finish"), nullptr) << "nobody leaves by a touch too many";
    ASSERT_TRUE(until([this] { return says("You can pull it out now"); }));
    const Path copy = stick() / "relievo" / code;
    EXPECT_TRUE(std::filesystem::exists(copy / "model.glb"));
    EXPECT_NE(test::read_text(copy / "manifest.json").find(*links.begin()), std::string::npos)
        << "whoever offers it knows it by this number";
    EXPECT_NE(find("finish"), nullptr);
    played("pause 1.1\n");  // a touch that comes sooner was meant for "Stop"
  }

  void played(const std::string& lines) {
    const Result<void> done = play(lines.c_str());
    ASSERT_TRUE(done.has_value()) << done.error().where();
    kiosk->turn();
  }
  static std::string digits_of(std::string text) {
    std::erase(text, '-');
    return text;
  }
  std::string with_the_code() const {
    return "tap start\ntap agree\ntype Ada\ntap done\nwait known\ntap have_code\nwait name\ntype " +
           digits_of(code) + "\ntap done\nwait known\n";
  }
  // What the records have of Ada, the kiosk running.
  std::vector<storage::Enrolment> kept() const {
    auto store = storage::open_sqlite_store(args.store, clock, {.mode = storage::OpenMode::ReadOnly});
    EXPECT_TRUE(store.has_value());
    EXPECT_EQ((*store)->subjects({})->size(), 1U) << "who left is not there, and nobody is there twice";
    const auto subject = find_by_receipt(**store, code);
    EXPECT_TRUE(subject.has_value() && subject->name == "Ada") << code;
    return *(*store)->enrolments(subject->id);
  }

  // A name that is in the records: the visitor leaves, before and after the code that proves it is theirs.
  void stop() {
    const auto before = kept();
    for (const std::string& way :
         {std::string("tap start\ntap agree\ntype Ada\ntap done\nwait known\n"), with_the_code()}) {
      played(way + "tap leave\ntap answer_quiet\nwait attract\n");
      EXPECT_EQ(kiosk->view().known, ui::Known::NotAsked) << "what was asked is forgotten";
      EXPECT_EQ(kiosk->appliance().state(), State::Idle);
      EXPECT_FALSE(kiosk->appliance().session().is_open()) << "no camera ran";
    }
    ASSERT_EQ(kept().size(), before.size());
    EXPECT_EQ(kept().front().id, before.front().id) << "all is as it was";
  }

  void renew() {
    const auto before = kept();
    played(with_the_code() + "tap renew\nwait review 600\ntap accept\nwait thanks 600\n");
    EXPECT_EQ(kiosk->view().receipt, code) << "the same record";
    played("tap finish\nwait attract\n");
    const auto after = kept();
    ASSERT_EQ(after.size(), 1U) << "the old portrait is gone";
    EXPECT_NE(after.front().id, before.front().id);
    EXPECT_GT(after.front().consent.given_at, before.front().created_at) << "a consent of its own";
  }

  void add_another() {
    const auto before = kept();
    played(with_the_code() + "tap add\nwait review 600\ntap accept\nwait thanks 600\n");
    EXPECT_EQ(kiosk->view().receipt, code) << "the same record";
    played("tap finish\nwait attract\n");
    const auto after = kept();
    ASSERT_EQ(after.size(), 2U) << "the old portrait stays beside the new one";
    EXPECT_EQ(after.front().id, before.front().id);
    EXPECT_EQ(after.front().consent.given_at, before.front().consent.given_at) << "and its consent";
    EXPECT_GT(after.back().consent.given_at, before.front().created_at) << "a consent of its own";
  }

  // A visitor who stays on the page that shows the new portrait and then stops has added nothing.
  void add_and_stop() {
    played(with_the_code() + "tap add\nwait review 600\ntap leave\ntap answer_quiet\nwait attract\n");
    EXPECT_FALSE(kiosk->appliance().session().is_open());
    EXPECT_EQ(kept().size(), 2U);
  }

  void everything_is_readable() {
    kiosk.reset();
    auto store = storage::open_sqlite_store(args.store, clock, {});
    ASSERT_TRUE(store.has_value());
    const auto enrolments = (*store)->enrolments(find_by_receipt(**store, code)->id);
    ASSERT_EQ(enrolments->size(), 2U);
    for (const storage::Enrolment& one : *enrolments) {
      EXPECT_EQ(one.consent.wording, "2026-03");
      EXPECT_EQ(one.consent.language, "en");
      EXPECT_LT(one.consent.given_at, one.created_at);
      std::pmr::monotonic_buffer_resource memory;
      EXPECT_TRUE((*store)->load_model(one.id, &memory).has_value());
    }
    EXPECT_TRUE((*store)->check().has_value());
  }

  std::atomic<bool> has_paper{false};
  std::vector<std::byte> printed;
  std::atomic<std::optional<Errc>> store_error{};
  std::string code;
  std::set<std::string> links;
  test::TemporaryFolder folder;
  hal::MonotonicClock clock;
  Console console;
  Services services{.console = console, .clock = clock};
  KioskArgs args;
};

// One test for all, since building the simulated person takes longest.
TEST_F(KioskTest, WhoLeavesLeavesNothingAndTheNextIsEnrolledStopsRenewsAndAdds) {
  leave_before_the_picture();
  enrol_by_touch();
  stop();
  renew();
  add_another();
  add_and_stop();
  everything_is_readable();
}

// What opening the device leaves behind (a process that rests the trigger) has a copy of the memory there is.
TEST(KioskOpens, TheDeviceBeforeAnyKeyOrName) {
  const test::TemporaryFolder folder;
  const hal::MonotonicClock clock;
  Console console;
  Services services{.console = console, .clock = clock};
  bool store_opened = false;
  services.open_device = [](std::string_view) -> Result<std::unique_ptr<hal::Device>> {
    return Error{Errc::NotFound, "as the test says"};
  };
  services.open_store = [&](const std::filesystem::path& at, bool) {
    store_opened = true;
    return storage::open_sqlite_store(at, clock, {});
  };
  KioskArgs args;
  args.store = folder.path() / "store";
  EXPECT_EQ(Kiosk::open(args, services).error().code, Errc::NotFound);
  EXPECT_FALSE(store_opened);
}

}  // namespace
}  // namespace relievo::firmware
