// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Touches that mean nothing: a second one in the same place, one for a page that has just gone, and a palm
// that rests.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <memory_resource>
#include <vector>

#include "pipeline/model/face_model.h"
#include "tests/support/made_screen.h"

namespace relievo::ui {
namespace {

using namespace std::chrono_literals;
using Kind = Input::Kind;

class LateTouchTest : public testing::Test {
 protected:
  LateTouchTest() {
    view.screen = Screen::Idle;
    view.now = hal::Instant(1h);
    frame();
    pass(2s);
  }
  void frame() {
    ui->frame(view);
    while (const auto intent = ui->take_intent())
      if (*intent != Intent::StillHere) asked.push_back(*intent);
  }
  void pass(std::chrono::milliseconds time) {
    view.now += time;
    frame();
  }
  // The machine goes on by itself.
  void goes_to(Screen screen) {
    view.screen = screen;
    frame();
  }
  void touch(float x, float y, std::int64_t finger = 1) {
    ui->feed({Kind::Down, finger, x, y}, view);
    ui->feed({Kind::Up, finger, x, y}, view);
    frame();
  }
  void touch(std::string_view id, std::int64_t finger = 1) {
    const Node* node = ui->tree().find(id);
    ASSERT_NE(node, nullptr) << id;
    touch(node->rect.x + node->rect.w / 2, node->rect.y + node->rect.h / 2, finger);
  }
  // Once, and again before anybody can have seen what the first touch did.
  void touch_twice(std::string_view id) {
    const Node* node = ui->tree().find(id);
    ASSERT_NE(node, nullptr) << id;
    const float x = node->rect.x + node->rect.w / 2, y = node->rect.y + node->rect.h / 2;
    touch(x, y);
    pass(200ms);
    touch(x, y);
  }
  void to_name() {
    touch("start");
    pass(2s);
    ui->visit().reads_to_the_end();
    frame();
    pass(2s);
    touch("agree");
    pass(2s);
    ASSERT_EQ(step(), Step::Name);
  }
  void to_position() {
    to_name();
    ui->visit().type("A");
    view.known = Known::Nobody;
    goes_to(Screen::Position);
    ASSERT_EQ(step(), Step::Position);
  }
  Step step() const { return ui->visit().step; }
  bool was_asked(Intent intent) const { return std::ranges::find(asked, intent) != asked.end(); }

  std::unique_ptr<Ui> ui = test::make_screen();
  ViewState view;
  std::vector<Intent> asked;
};

TEST_F(LateTouchTest, ADoubleTouchLeadsOnePageOn) {
  to_name();
  ui->visit().type("A");
  frame();
  const Rect done = ui->tree().find("done")->rect;
  const float x = done.x + done.w / 2, y = done.y + done.h / 2;
  touch(x, y);
  EXPECT_TRUE(was_asked(Intent::LookUp));
  view.known = Known::Nobody;
  frame();
  goes_to(Screen::Position);
  ASSERT_EQ(step(), Step::Position);
  const Node* under = ui->tree().at(x, y);
  ASSERT_NE(under, nullptr);
  ASSERT_EQ(under->id, "shoot") << "else this tests nothing";
  pass(200ms);
  touch(x, y);
  EXPECT_FALSE(was_asked(Intent::Begin));
  pass(2s);
  touch(x, y);
  EXPECT_TRUE(was_asked(Intent::Begin)) << "who has seen the page is heard";
}

TEST_F(LateTouchTest, ATouchForThePictureIsNoneForTheHead) {
  to_position();
  pass(2s);
  const Rect shoot = ui->tree().find("shoot")->rect;
  const float x = shoot.x + shoot.w / 2, y = shoot.y + shoot.h / 2;
  goes_to(Screen::Capture);
  goes_to(Screen::Turn);
  ASSERT_EQ(ui->tree().at(x, y)->id, "enough");
  pass(900ms);
  touch(x, y);
  EXPECT_FALSE(was_asked(Intent::Enough));
  pass(200ms);
  touch(x, y);
  EXPECT_TRUE(was_asked(Intent::Enough));
}

TEST_F(LateTouchTest, WhoReadsOnDoesNotAgreeByTheSameTouch) {
  ui->visit().text_size = kTextPercents.size() - 1;
  touch("start");
  pass(2s);
  const Rect on = ui->tree().find("read_on")->rect;
  const float x = on.x + on.w / 2, y = on.y + on.h / 2;
  for (int i = 0; i < 50 && ui->tree().find("read_on") != nullptr; ++i) {
    pass(2s);
    touch(x, y);
  }
  ASSERT_EQ(ui->tree().at(x, y)->id, "agree");
  pass(200ms);
  touch(x, y);
  EXPECT_EQ(step(), Step::Consent);
  pass(500ms);
  touch(x, y);
  EXPECT_EQ(step(), Step::Name);
}

TEST_F(LateTouchTest, BackFromTheCodeIsBackToTheName) {
  to_name();
  ui->visit().step = Step::Known;
  ui->visit().act({ActionKind::HaveCode, 0}, view);
  frame();
  pass(2s);
  ASSERT_TRUE(ui->visit().quotes_code());
  touch_twice("back");
  EXPECT_FALSE(ui->visit().quotes_code());
  EXPECT_EQ(step(), Step::Name);
}

TEST_F(LateTouchTest, AnEnterForThePageBeforeHandsNothingIn) {
  to_position();
  pass(2s);
  touch("back");
  goes_to(Screen::Idle);
  ASSERT_EQ(step(), Step::Name);
  asked.clear();
  ui->feed({Kind::Activate}, view);
  frame();
  EXPECT_FALSE(was_asked(Intent::LookUp));
  pass(1s);
  ui->feed({Kind::Activate}, view);
  frame();
  EXPECT_TRUE(was_asked(Intent::LookUp));
}

TEST_F(LateTouchTest, WhoIsAskedWhetherTheyAreThereGoesOnSoon) {
  to_name();
  pass(std::chrono::seconds(view.settings.of(Setting::PatienceS)) + 1s);
  ASSERT_EQ(ui->visit().overlay, Overlay::StillThere);
  pass(2s);
  touch(1, 1);
  ASSERT_EQ(ui->visit().overlay, Overlay::None);
  pass(kStruckTwice);
  touch("key A");
  EXPECT_EQ(ui->visit().name(), "A");
}

// Some move a little all the time, and are never lost.
TEST_F(LateTouchTest, APalmThatRestsBarsNoButton) {
  for (const std::int64_t palm : {11, 12}) {  // one place, then two
    ui->feed({Kind::Down, palm, 1, 799}, view);
    for (int i = 0; i < 30; ++i) {
      pass(1s);
      for (std::int64_t moved = 11; moved <= palm; ++moved)
        ui->feed({Kind::Move, moved, float(1 + i % 3), 799}, view);
    }
    const std::size_t before = ui->visit().text_size;
    touch("bigger", 1);
    EXPECT_EQ(ui->visit().text_size, before + 1);
  }
}

TEST_F(LateTouchTest, APalmThatRestsKeepsNobodyFromReadingOn) {
  ui->visit().text_size = kTextPercents.size() - 1;
  touch("start");
  pass(2s);
  ui->feed({Kind::Down, 11, 1, 799}, view);
  const Rect text = ui->tree().find(kToRead)->rect;
  const Node& first = ui->tree().nodes()[std::size_t(ui->tree().find(kToRead)->first_child)];
  const float before = first.rect.y, x = text.x + text.w / 2, y = text.y + text.h / 2;
  ui->feed({Kind::Down, 1, x, y}, view);
  for (int i = 1; i <= 4; ++i) ui->feed({Kind::Move, 1, x, y - float(20 * i)}, view);
  frame();
  EXPECT_LT(ui->tree().nodes()[std::size_t(ui->tree().find(kToRead)->first_child)].rect.y, before - 40);
}

TEST_F(LateTouchTest, APalmOnTheModelBarsNoButtonEither) {
  const pipeline::FaceModel model(std::pmr::get_default_resource());
  view.model = &model;
  goes_to(Screen::Review);
  pass(2s);
  ASSERT_EQ(step(), Step::Review);
  const Rect face = ui->tree().find("face")->rect;
  for (const std::int64_t palm : {11, 12}) {
    ui->feed({Kind::Down, palm, face.x + 30 * float(palm - 10), face.y + face.h / 2}, view);
    const std::size_t before = ui->visit().text_size;
    touch("bigger", 1);
    EXPECT_EQ(ui->visit().text_size, before + 1);
    EXPECT_FLOAT_EQ(ui->visit().look.zoom, 1);
  }
}

}  // namespace
}  // namespace relievo::ui
