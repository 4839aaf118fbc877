// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What nobody can undo is held for three seconds: a passing finger, one that slides off or is lifted, and a
// key that is called back erase nobody.
#include <algorithm>
#include <atomic>
#include <optional>

#include "tests/firmware/kiosk/staff_hands.h"
#include "tests/support/faulty_store.h"
#include "ui/view/staff_views.h"

namespace relievo::firmware {
namespace {

using namespace std::chrono_literals;

class StaffEraseTest : public StaffHands {
 protected:
  StaffEraseTest() { changes.clock = &time; }
  void ask_to_erase() {
    open_records({"Ada Lovelace"});
    tap("record " + std::to_string(1));
    ASSERT_TRUE(until([this] { return find("erase") != nullptr; }));
    tap("erase");
    ASSERT_NE(find("yes"), nullptr);
    EXPECT_TRUE(says("Ada Lovelace") && says(code_of(1))) << "who it is";
    EXPECT_NE(find("face"), nullptr);
  }
  void pass(std::chrono::milliseconds so_long) {
    time.advance(so_long);
    kiosk->turn();
  }
  // How much of the bar is filled, and from which side.
  float filled(bool* from_the_right = nullptr) const {
    const ui::Node* yes = find("yes");
    if (yes == nullptr) return -1;
    for (const ui::Command& c : kiosk->ui().draw_list().commands) {
      const bool bar = c.rect == yes->rect && c.fill == yes->filling && c.clip.h < yes->rect.h / 2;
      if (!bar) continue;
      if (from_the_right != nullptr) *from_the_right = c.clip.x > yes->rect.x + 1;
      return c.clip.w / yes->rect.w;
    }
    return 0;
  }
  bool still_kept() {
    for (int i = 0; i < 50; ++i) {
      kiosk->turn();
      std::this_thread::sleep_for(1ms);
    }
    auto store = storage::open_sqlite_store(args.store, wall(), {.mode = storage::OpenMode::ReadOnly});
    EXPECT_TRUE(store.has_value());
    return (*store)->subjects({})->size() == 1;
  }
  bool erased() {
    return until([this] {
      return kiosk->view().service->records != nullptr && kiosk->view().service->records->erased;
    });
  }
  hal::ManualClock time;
};

TEST_F(StaffEraseTest, AFingerThatTapsLiftsTooSoonOrSlidesOffErasesNobody) {
  ask_to_erase();
  tap("yes");
  pass(4s);
  EXPECT_NE(find("yes"), nullptr);
  EXPECT_TRUE(still_kept()) << "tapped";

  rest_on("yes");
  EXPECT_EQ(filled(), 0);
  pass(1500ms);
  EXPECT_NEAR(filled(), 0.5F, 0.01F);
  pass(1499ms);
  EXPECT_GT(filled(), 0.99F);
  lift();
  pass(4s);
  EXPECT_EQ(filled(), 0) << "it begins anew";
  EXPECT_TRUE(still_kept()) << "lifted too soon";

  rest_on("yes");
  pass(1s);
  kiosk->feed({ui::Input::Kind::Move, finger, rests_x, rests_y - 300});
  pass(4s);
  EXPECT_TRUE(still_kept()) << "slid off";
  kiosk->feed({ui::Input::Kind::Move, finger, rests_x, rests_y});
  pass(4s);
  EXPECT_TRUE(still_kept()) << "and came back";
}

TEST_F(StaffEraseTest, AFingerThatRestsThreeSecondsErases) {
  ask_to_erase();
  hold("yes", time);
  ASSERT_TRUE(erased());
  lift();
  kiosk->turn();
  EXPECT_NE(find("search"), nullptr) << "back in the list";
  EXPECT_FALSE(still_kept());
}

// As where another program reads the store: the person is gone, traces stay in its log.
class TracesStay final : public test::FaultyStore {
 public:
  using FaultyStore::FaultyStore;
  Result<void> erase_subject(storage::SubjectId id) override {
    RELIEVO_TRY(FaultyStore::erase_subject(id));
    return Error{Errc::Timeout, "erased, but as the test says"};
  }
};

TEST_F(StaffEraseTest, WhileAnotherProgramReadsTheyAreErasedAllTheSame) {
  static const std::atomic<std::optional<Errc>> none{};  // outlives the kiosk
  services.open_store = [&](const Path& at, bool) -> Result<std::unique_ptr<storage::Store>> {
    RELIEVO_TRY_ASSIGN(auto real, storage::open_sqlite_store(at, wall(), {}));
    return std::unique_ptr<storage::Store>(std::make_unique<TracesStay>(std::move(real), none));
  };
  ask_to_erase();
  hold("yes", time);
  ASSERT_TRUE(erased());
  lift();
  EXPECT_TRUE(std::ranges::any_of(kiosk->staff().log().entries(), [](const ui::LogLine& line) {
    return line.text.find("Record #1 was erased") != std::string::npos;
  }));
  EXPECT_FALSE(still_kept());
  kiosk.reset();  // before what its store borrows
}

TEST_F(StaffEraseTest, AKeyTakesAsLongAndAnyOtherCallsItBack) {
  ask_to_erase();
  for (const auto back : {ui::Input::Kind::Next, ui::Input::Kind::Previous, ui::Input::Kind::Activate}) {
    focus_on("yes");
    kiosk->feed({ui::Input::Kind::Activate});
    kiosk->turn();
    pass(2s);
    EXPECT_GT(filled(), 0.6F);
    kiosk->feed({back});
    pass(4s);
    EXPECT_NE(find("yes"), nullptr);
    EXPECT_TRUE(still_kept());
  }
  focus_on("yes");
  kiosk->feed({ui::Input::Kind::Activate});
  kiosk->turn();
  kiosk->feed({ui::Input::Kind::Back});
  pass(4s);
  EXPECT_EQ(find("yes"), nullptr) << "Back leads back, as ever";
  EXPECT_TRUE(still_kept());
  tap("erase");
  focus_on("yes");
  kiosk->feed({ui::Input::Kind::Activate});
  kiosk->turn();
  pass(ui::kHold + 1ms);
  ASSERT_TRUE(erased());
  EXPECT_FALSE(still_kept());
}

TEST_F(StaffEraseTest, FromRightToLeftTheBarFillsFromTheRight) {
  ask_to_erase();
  kiosk->ui().visit().language = ui::Language::Arabic;
  kiosk->turn();
  rest_on("yes");
  pass(1s);
  bool from_the_right = false;
  EXPECT_NEAR(filled(&from_the_right), 1.0F / 3, 0.01F);
  EXPECT_TRUE(from_the_right);
}

}  // namespace
}  // namespace relievo::firmware
