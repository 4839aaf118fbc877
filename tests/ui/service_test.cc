// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The way through the staff's side, without a screen: actions and the appliance's word go in, requests come
// out.
#include "ui/view/service.h"

#include <gtest/gtest.h>

#include <chrono>
#include <optional>

#include "ui/view/view_state.h"

namespace relievo::ui {
namespace {

class ServiceTest : public testing::Test {
 protected:
  ServiceTest() {
    view.screen = Screen::Idle;
    view.now = hal::Instant(std::chrono::seconds(1000));
    view.service = &staff;
  }
  void act(ActionKind kind, int value = 0) { service.act({kind, value}, view); }
  void sign_in(StaffRole role) {
    act(ActionKind::StaffEnter);
    staff.role = role;
    service.follow(view);
  }
  std::optional<StaffRequest> last_request() {
    std::optional<StaffRequest> last;
    while (auto request = service.take_request()) last = request;
    return last;
  }
  ServiceView staff;
  ViewState view;
  Service service;
};

TEST_F(ServiceTest, OnlyTheApplianceLetsAnybodyIn) {
  act(ActionKind::StaffEnter);
  EXPECT_EQ(service.page, StaffPage::Pin);
  act(ActionKind::StaffOpen, static_cast<int>(StaffPage::Records));
  service.follow(view);
  EXPECT_FALSE(service.open) << "without a role there is no page";
  sign_in(StaffRole::Operator);
  EXPECT_EQ(service.page, StaffPage::Menu);
  staff.role = StaffRole::None;
  service.follow(view);
  EXPECT_FALSE(service.open);
}

TEST_F(ServiceTest, APinIsDigitsAndIsWipedWithItsRequest) {
  act(ActionKind::StaffEnter);
  for (const char* key : {"4", "x", "7", "1", " ", "1"}) service.type(key);
  EXPECT_EQ(service.typed(), "4711");
  service.act(Action(CheckPin{}), view);
  EXPECT_EQ(service.typed(), "");
  EXPECT_EQ(last_request()->text(), "4711");
  for (int i = 0; i < 20; ++i) service.type("9");
  EXPECT_EQ(service.typed().size(), kMostPinDigits);
  view.now += kPinPatience + std::chrono::seconds(1);
  service.follow(view);
  EXPECT_FALSE(service.open) << "nobody goes on";
  EXPECT_EQ(service.typed(), "");
}

TEST_F(ServiceTest, APinThatCannotBeAskedForIsWiped) {
  act(ActionKind::StaffEnter);
  for (int i = 0; i < 20; ++i) service.act(Action(CheckPin{}), view);
  for (const char* key : {"4", "7", "1", "1"}) service.type(key);
  service.act(Action(CheckPin{}), view);
  EXPECT_EQ(service.typed(), "");
  EXPECT_EQ(last_request()->text(), "") << "there was no room for it";
}

TEST_F(ServiceTest, BackLeadsOutOneStepAtATime) {
  sign_in(StaffRole::Operator);
  act(ActionKind::StaffOpen, static_cast<int>(StaffPage::Records));
  act(ActionKind::StaffMode, 1);
  service.type("A");
  act(ActionKind::Back);
  EXPECT_EQ(service.mode, 0);
  staff.inner = true;
  act(ActionKind::Back);
  EXPECT_EQ(service.page, StaffPage::Records) << "what it showed within itself is closed first";
  EXPECT_NE(last_request()->as<PageOpened>(), nullptr);
  EXPECT_EQ(service.typed(), "");
  staff.inner = false;
  act(ActionKind::Back);
  EXPECT_EQ(service.page, StaffPage::Menu);
  act(ActionKind::Back);
  EXPECT_FALSE(service.open);
  EXPECT_NE(last_request()->as<PageLeft>(), nullptr);
}

TEST_F(ServiceTest, ANewDeviceAsksForItsPinsFirst) {
  staff.access.set_up = false;
  act(ActionKind::StaffEnter);
  EXPECT_EQ(service.page, StaffPage::FirstStart);
  staff.access.set_up = true;
  service.follow(view);
  EXPECT_EQ(service.page, StaffPage::Pin);
}

}  // namespace
}  // namespace relievo::ui
