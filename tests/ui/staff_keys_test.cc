// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The staff's pages by a keyboard: Enter ends what was typed, the focus begins at what a page is about.
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <variant>

#include "tests/support/made_screen.h"
#include "ui/technician/technician_view.h"
#include "ui/view/staff_views.h"

namespace relievo::ui {
namespace {

class StaffKeysTest : public testing::Test {
 protected:
  StaffKeysTest() { view.service = &staff; }
  // A page, its first mode or another.
  void open(StaffPage page, int mode = 0) {
    Service service;
    service.show(page, mode);
    ui->show(view, {}, service);
  }
  void draw() { ui->show(view, Visit(ui->visit()), Service(ui->service())); }
  void press(Input::Kind kind, std::string_view letter = {}) {
    Input input{kind};
    letter.copy(input.letter.data(), input.letter.size() - 1);
    ui->feed(input, view);
    draw();
  }
  void type(std::string_view letters) {
    for (const char& letter : letters) press(Input::Kind::Letter, {&letter, 1});
  }
  template <typename Ask>
  bool asks(std::string_view typed) {
    const auto request = ui->take_staff_request();
    return request && request->as<Ask>() != nullptr && request->text() == typed;
  }

  std::unique_ptr<Ui> ui = test::make_screen();
  ServiceView staff;
  ViewState view;
};

TEST_F(StaffKeysTest, EnterHandsInAPinThatIsLongEnough) {
  open(StaffPage::Pin);
  type("471");
  press(Input::Kind::Activate);
  EXPECT_FALSE(ui->take_staff_request());
  type("1");
  press(Input::Kind::Activate);
  EXPECT_TRUE(asks<CheckPin>("4711"));
  open(StaffPage::FirstStart, 2);
  type("80526");
  press(Input::Kind::Activate);
  EXPECT_TRUE(asks<OfferPin>("80526"));
}

// A blank in it is a letter.
TEST_F(StaffKeysTest, EnterSearchesAndHandsInTheWordOfTheSheet) {
  staff.role = StaffRole::Operator;
  const RecordsView records{};
  staff.records = &records;
  open(StaffPage::Records, 1);
  type("Ada Lovelace");
  press(Input::Kind::Activate);
  EXPECT_TRUE(asks<FindRecords>("Ada Lovelace"));
  EXPECT_EQ(ui->service().mode, 0) << "the list is shown";
  RecoveryView sheet;
  sheet.asked = 3;
  staff.recovery = &sheet;
  open(StaffPage::Recovery, 1);
  press(Input::Kind::Activate);
  EXPECT_FALSE(ui->take_staff_request()) << "nothing is typed yet";
  type("abandon");
  press(Input::Kind::Activate);
  EXPECT_TRUE(asks<OfferWord>("abandon"));
}

TEST_F(StaffKeysTest, EnterTakesANumberForAnOption) {
  staff.role = StaffRole::Technician;
  const TechnicianOption option{};
  TechnicianView seen;
  const TechnicianKind kind{};
  seen.choice.kinds = {&kind, 1};
  seen.choice.edited = &option;
  staff.technician = &seen;
  open(StaffPage::Algorithms);
  press(Input::Kind::Activate);
  const auto request = ui->take_staff_request();
  ASSERT_TRUE(request);
  const auto* technician = request->as<TechnicianRequest>();
  ASSERT_NE(technician, nullptr);
  const auto* act = std::get_if<TechnicianAct>(technician);
  ASSERT_NE(act, nullptr);
  EXPECT_EQ(*act, TechnicianAct::UseTyped);
}

TEST_F(StaffKeysTest, TheFocusBeginsBehindTheBarAndGoesBackIntoIt) {
  staff.role = StaffRole::Operator;
  const RecordsView records{};
  staff.records = &records;
  open(StaffPage::Records);
  press(Input::Kind::Next);
  EXPECT_EQ(ui->focus(), "search") << "not what makes letters larger";
  open(StaffPage::Records);
  press(Input::Kind::Previous);
  EXPECT_EQ(ui->focus(), "sign out");
}

// Rows of figures have no room for the largest letters: nobody touches for nothing.
TEST_F(StaffKeysTest, EachTouchOnLargerLettersChangesThePage) {
  staff.role = StaffRole::Operator;
  open(StaffPage::Menu);
  std::string value(ui->tree().find("bigger")->value);
  DrawList before = ui->draw_list();
  for (int touch = 0; touch < 6; ++touch) {
    const Rect at = ui->tree().find("bigger")->rect;
    for (const auto kind : {Input::Kind::Down, Input::Kind::Up})
      ui->feed({kind, 1, at.x + at.w / 2, at.y + at.h / 2}, view);
    draw();
    EXPECT_FALSE(ui->draw_list() == before) << value;
    EXPECT_NE(ui->tree().find("bigger")->value, value);
    before = ui->draw_list();
    value = ui->tree().find("bigger")->value;
  }
}

}  // namespace
}  // namespace relievo::ui
