// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Without a finger: arrows go where the eye sees it, letters arrive, and a name takes few keys.
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/made_screen.h"
#include "tests/ui/languages.h"
#include "ui/view/visit.h"

namespace relievo::ui {
namespace {

using Kind = Input::Kind;

class KeypadTest : public testing::TestWithParam<Language> {
 protected:
  void SetUp() override {
    ui = test::make_screen();
    view.screen = Screen::Idle;
    view.now = hal::Instant(std::chrono::hours(1));
    view.home = GetParam();
    frame();
    press(Kind::Activate);
    EXPECT_EQ(ui->visit().step, Step::Attract) << "nothing has the focus yet";
  }
  void frame() {
    ui->frame(view);
    while (const auto intent = ui->take_intent()) looked_up_ = looked_up_ || *intent == Intent::LookUp;
  }
  void press(Kind kind, std::string_view letter = {}) {
    Input input{kind};
    letter.copy(input.letter.data(), input.letter.size() - 1);
    ui->feed(input, view);
    frame();
    ++pressed;
  }
  void tap(std::string_view id) {
    const Node* node = ui->tree().find(id);
    ASSERT_NE(node, nullptr) << id;
    const float x = node->rect.x + node->rect.w / 2, y = node->rect.y + node->rect.h / 2;
    view.now += kTooLate;  // the page has been seen
    ui->feed({Kind::Down, 1, x, y}, view);
    ui->feed({Kind::Up, 1, x, y}, view);
    frame();
    ++tapped;
  }
  void to_name() {
    tap("start");
    while (ui->tree().find("read_on") != nullptr) tap("read_on");
    tap("agree");
    ASSERT_EQ(ui->visit().step, Step::Name);
    view.now += kTooLate;
    tapped = pressed = 0;
  }
  const Rect& at(std::string_view id) const { return ui->tree().find(id)->rect; }
  bool asks_the_records() { return std::exchange(looked_up_, false); }
  // On the keys of the screen: another set of them, where the letter is on none of these.
  void touch_in(const std::string& name) {
    for (const std::string& letter : letters(name)) {
      const std::string key = letter == " " ? "space" : "key " + letter;
      if (ui->tree().find(key) == nullptr && ui->tree().find("other_letters") != nullptr)
        tap("other_letters");
      tap(key);
    }
    tap("done");
  }
  void key_in(const std::string& name) {
    char before = 0;
    for (const std::string& letter : letters(name)) {
      char digit = 0;
      std::size_t times = 0;
      for (char d = '1'; d <= '9' && digit == 0; ++d)
        for (std::size_t t = 0; t < 9; ++t)
          if (keypad_letter(GetParam(), d, t, ui->visit().capitals) == letter) {
            digit = d, times = t + 1;
            break;
          }
      ASSERT_NE(digit, 0) << letter << " is on no key";
      if (digit == before) view.now += std::chrono::milliseconds(1200);
      for (std::size_t t = 0; t < times; ++t) press(Kind::Digit, std::string(1, digit));
      before = digit;
    }
    press(Kind::Activate);
  }
  static std::vector<std::string> letters(const std::string& text) {
    std::vector<std::string> all;
    for (const char c : text) {
      if ((static_cast<unsigned char>(c) & 0xC0U) != 0x80U) all.emplace_back();
      all.back() += c;
    }
    return all;
  }

  std::unique_ptr<Ui> ui;
  ViewState view;
  int pressed = 0, tapped = 0;

 private:
  bool looked_up_ = false;
};

std::vector<std::string> names_of(Language language) {
  switch (language) {
    case Language::German: return {"Jürgen Müller", "Anna Schäfer", "Maximilian Groß"};
    case Language::French: return {"Zoé Lefèvre", "François Dubois", "Marie-Hélène Girard"};
    case Language::Spanish: return {"Iñaki Muñoz", "María García", "Lucía Fernández"};
    case Language::Arabic: return {"ليلى حسن", "محمد علي", "فاطمة الزهراء"};
    case Language::Hebrew: return {"נועה לוי", "דוד כהן", "מרים פרץ"};
    case Language::Chinese: return {"Wang Wei", "Li Na", "Zhang Min"};
    case Language::Japanese: return {"Sato Yuki", "Suzuki Hiroshi", "Tanaka Aiko"};
    case Language::English:
    case Language::Count: break;
  }
  return {"Ada Lovelace", "Grace Hopper", "Alan Mathison Turing"};
}

TEST_P(KeypadTest, ANameTakesAtMostTwiceAsManyKeysAsTouches) {
  for (const std::string& name : names_of(GetParam())) {
    to_name();
    touch_in(name);
    EXPECT_EQ(ui->visit().name(), name);
    EXPECT_TRUE(asks_the_records());
    const int touches = tapped;
    ui->visit().act({ActionKind::LeaveNow, 0}, view);
    frame();
    to_name();
    key_in(name);
    EXPECT_EQ(ui->visit().name(), name);
    EXPECT_TRUE(asks_the_records()) << "the question has the focus: Enter hands it in";
    EXPECT_LE(pressed, 2 * touches) << name;
    ui->visit().act({ActionKind::LeaveNow, 0}, view);
    frame();
  }
}

// What is seen by the letters is said: capitals, and letters with accents.
TEST_P(KeypadTest, KeysThatChangeTheOthersSayHowTheyStand) {
  to_name();
  const Words tr(GetParam());
  const auto stands = [&](std::string_view id) { return std::string(ui->tree().find(id)->value); };
  if (ui->tree().find("shift") != nullptr) {
    EXPECT_EQ(stands("shift"), tr("yes")) << "a name begins with one";
    tap("shift");
    EXPECT_EQ(stands("shift"), tr("no"));
  }
  if (!info_of(GetParam()).latin) return;
  EXPECT_EQ(stands("other_letters"), tr("no"));
  tap("other_letters");
  EXPECT_EQ(stands("other_letters"), tr("yes"));
}

// As in their passport: also who writes in another script.
TEST_P(KeypadTest, ANameInLatinLettersCanBeTyped) {
  to_name();
  const std::string home = names_of(GetParam()).back();
  if (!info_of(GetParam()).latin) {
    EXPECT_EQ(ui->tree().find("key L"), nullptr);
    tap("other_letters");
  }
  touch_in("Ada-Li");
  EXPECT_EQ(ui->visit().name(), "Ada-Li");
  EXPECT_TRUE(asks_the_records());
  ui->visit().act({ActionKind::LeaveNow, 0}, view);
  frame();
  to_name();
  if (!info_of(GetParam()).latin) tap("other_letters");
  press(Kind::Digit, "2");
  EXPECT_EQ(ui->visit().name(), "A") << "the keypad's letters are those that are shown";
  while (!ui->visit().name().empty()) press(Kind::Erase);
  if (!info_of(GetParam()).latin) tap("other_letters");
  touch_in(home);
  EXPECT_EQ(ui->visit().name(), home) << "and back";
  ui->visit().act({ActionKind::LeaveNow, 0}, view);
  frame();
  to_name();
  EXPECT_FALSE(ui->visit().other_letters) << "the next one begins with their own";
}

TEST_P(KeypadTest, ArrowsGoAsTheEyeSeesItAndBackAgain) {
  to_name();
  press(Kind::Below);
  EXPECT_EQ(ui->focus(), "name") << "it begins at the question";
  press(Kind::Below);
  const std::string first(ui->focus());
  EXPECT_EQ(at(first).y, at("key 1").y) << first;
  press(Kind::Below);
  const std::string second(ui->focus());
  EXPECT_GT(at(second).y, at(first).y);
  press(Kind::Right);
  const std::string right(ui->focus());
  EXPECT_GT(at(right).x, at(second).x) << "the right is the right, also where words run to the left";
  EXPECT_EQ(at(right).y, at(second).y);
  press(Kind::Left);
  EXPECT_EQ(ui->focus(), second);
  press(Kind::Above);
  EXPECT_EQ(at(ui->focus()).y, at(first).y);
  for (int i = 0; i < 20; ++i) press(Kind::Right);
  EXPECT_EQ(at(ui->focus()).y, at(first).y) << "it stays in its row";
}

// Whatever has the focus, arrows alone lead to everything else.
TEST_P(KeypadTest, ArrowsReachEveryButton) {
  to_name();
  const Tree& tree = ui->tree();
  for (const Node& goal : tree.nodes()) {
    if (goal.action.kind == ActionKind::None) continue;
    bool reached = false;
    for (const Node& node : tree.nodes())
      for (const auto& [right, down] : {std::pair(1.0F, 0.0F), {-1.0F, 0.0F}, {0.0F, 1.0F}, {0.0F, -1.0F}})
        reached = reached || ((node.action.kind != ActionKind::None || node.id == "name") &&
                              tree.beside(node, right, down) == &goal);
    EXPECT_TRUE(reached) << goal.id;
  }
}

TEST_P(KeypadTest, TypedLettersArriveAndABlankIsALetterWhereOneIsTyped) {
  to_name();
  for (const char* letter : {"Z", "o", "é", " ", "李"}) press(Kind::Letter, letter);
  EXPECT_EQ(ui->visit().name(), "Zoé 李");
  press(Kind::Erase);
  press(Kind::Erase);
  EXPECT_EQ(ui->visit().name(), "Zoé");
  press(Kind::Activate);
  EXPECT_TRUE(asks_the_records());
  ui->visit().act({ActionKind::LeaveNow, 0}, view);
  frame();
  press(Kind::Below);
  EXPECT_EQ(ui->focus(), "start");
  press(Kind::Letter, "x");
  EXPECT_EQ(ui->visit().step, Step::Attract) << "nobody asks for letters here";
  press(Kind::Letter, " ");
  EXPECT_EQ(ui->visit().step, Step::Consent) << "a blank presses what has the focus";
}

// Elsewhere it asks to hear the page once more.
TEST_P(KeypadTest, TheZeroOfAKeypadIsADigitOfACode) {
  to_name();
  press(Kind::Repeat, "0");
  EXPECT_EQ(ui->visit().name(), "");
  ui->visit().step = Step::Known;
  ui->visit().act(ActionKind::HaveCode, view);
  frame();
  press(Kind::Repeat, "0");
  press(Kind::Digit, "4");
  press(Kind::Repeat);
  EXPECT_EQ(ui->visit().name(), "04");
}

// On the staff's menu a notice stands in the title's place for a while; the other headings have no id.
TEST(StaffKeypad, TheFocusBeginsAtTheFirstHeading) {
  const auto ui = test::make_screen();
  ServiceView staff;
  staff.role = StaffRole::Operator;
  staff.leaves_in_s = 9;
  ViewState view;
  view.service = &staff;
  Service service;
  service.show(StaffPage::Menu);
  ui->show(view, {}, service);
  const Node* heading = ui->tree().question();
  ASSERT_NE(heading, nullptr);
  ASSERT_EQ(heading->id, "");
  ui->feed({Kind::Next}, view);
  const Node* focus = ui->tree().find(ui->focus());
  ASSERT_GT(focus, heading);
  for (const Node* node = heading; node != focus; ++node) EXPECT_EQ(node->action.kind, ActionKind::None);
}

INSTANTIATE_TEST_SUITE_P(Languages, KeypadTest, kEveryLanguage, language_code);

}  // namespace
}  // namespace relievo::ui
