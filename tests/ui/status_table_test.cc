// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What needs a hand: each rule fires for what it is about and for nothing else, and leads to a page that who
// reads it may open.

#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "tests/support/made_screen.h"
#include "ui/screens/staff_screens.h"

namespace relievo::ui {
namespace {

struct World {
  World() {
    view.service = &staff;
    for (auto& text : texts.in) text = ConsentText{};
    view.consent = &texts;
    view.settings.set(Setting::LeastRoomMib, 512);
    status.looked = true;
    status.free_mib = 10'000;
    status.pairs = 1000;
    status.missed = 10;
    status.hottest_c = 60;
    status.calibration_days = 365;
  }
  std::span<const Finding> found() { return find_status(view, status, room); }
  ConsentTexts texts;
  ServiceView staff;
  ViewState view;
  StatusView status;
  std::array<Finding, kMostFindings> room;
};

struct Case {
  std::string_view rule;
  Mood mood;
  std::function<void(World&)> happens;
};

const std::vector<Case>& cases() {
  static const std::vector<Case> kCases{
      {"clock", Mood::Bad, [](World& w) { w.view.out_of_order = Trouble::Clock; }},
      {"uncalibrated", Mood::Bad, [](World& w) { w.view.out_of_order = Trouble::Uncalibrated; }},
      {"moved", Mood::Bad, [](World& w) { w.view.out_of_order = Trouble::Calibration; }},
      {"moved", Mood::Warn,
       [](World& w) {
         w.view.calibration_note = {Errc::NotCalibrated, "0.4 px"};
       }},
      {"camera", Mood::Bad, [](World& w) { w.status.camera_away = true; }},
      {"store", Mood::Bad, [](World& w) { w.status.store_damaged = true; }},
      {"no room", Mood::Bad, [](World& w) { w.status.free_mib = 511; }},
      {"little room", Mood::Warn, [](World& w) { w.status.free_mib = 512; }},
      {"hot", Mood::Warn, [](World& w) { w.status.hottest_c = 75; }},
      {"hot", Mood::Bad, [](World& w) { w.status.hottest_c = 90; }},
      {"hot", Mood::Bad, [](World& w) { w.view.out_of_order = Trouble::Other; }},
      {"recovery", Mood::Warn, [](World& w) { w.staff.access.words_due = true; }},
      {"recovery", Mood::Bad, [](World& w) { w.staff.access.words_due = w.staff.access.demanded = true; }},
      {"sample", Mood::Warn, [](World& w) { w.view.consent = nullptr; }},
      {"sample", Mood::Bad, [](World& w) { w.view.consent = nullptr, w.staff.access.demanded = true; }},
      {"languages", Mood::Warn, [](World& w) { w.texts.in[3].reset(); }},
      {"jumped", Mood::Warn, [](World& w) { w.status.clock_jumped = true; }},
      {"trigger", Mood::Warn, [](World& w) { w.status.missed = 11; }},
      {"old", Mood::Warn, [](World& w) { w.status.calibration_days = 366; }},
      {"restarted", Mood::Warn, [](World& w) { w.view.out_of_order = Trouble::Restarted; }},
      {"faults", Mood::Warn, [](World& w) { w.status.device_faults = 1; }},
  };
  return kCases;
}

TEST(StatusTable, WhereAllIsInOrderNothingIsSaid) { EXPECT_TRUE(World().found().empty()); }

TEST(StatusTable, EachRuleFiresForItsOwnFactAndLeadsToWhereItIsMended) {
  std::set<std::string_view> fired;
  for (const Case& one : cases()) {
    SCOPED_TRACE(one.rule);
    World world;
    one.happens(world);
    ASSERT_EQ(world.found().size(), 1U) << "this rule and no other";
    const Finding found = world.found()[0];
    EXPECT_EQ(found.rule->id, one.rule);
    EXPECT_EQ(found.mood, one.mood);
    fired.insert(one.rule);
    EXPECT_TRUE(found.rule->for_technician != StaffPage::Menu || found.rule->for_operator != StaffPage::Menu)
        << "nobody could mend it";
    for (const StaffRole role : {StaffRole::Technician, StaffRole::Operator}) {
      const StaffPage page = found.rule->page_of(role);
      bool opens = page == StaffPage::Menu;  // the other role's work
      for (const StaffPageInfo& info : staff_pages())
        opens = opens || (info.page == page && may_open(role, info));
      EXPECT_TRUE(opens);
    }
  }
  for (const StatusRule& rule : status_rules())
    EXPECT_EQ(fired.count(rule.id), 1U) << rule.id << " was never made to fire";
}

// Its rows would push the tiles away from a finger.
TEST(StatusTable, WhatIsKnownBeforeTheDeviceIsLookedAtStandsThereAtOnce) {
  World world;
  world.status = {};
  EXPECT_TRUE(world.found().empty()) << "nothing is known of the disk";
  world.status.camera_away = true;
  world.staff.role = StaffRole::Technician;
  world.staff.status = &world.status;
  world.view.screen = Screen::Staff;
  const auto screen = test::make_screen();
  screen->resize(1280, 800);
  screen->service().show(StaffPage::Menu);
  const auto top_of = [&](std::string_view id) {
    screen->frame(world.view);
    const Node* node = screen->tree().find(id);
    return node == nullptr ? -1 : node->rect.y;
  };
  EXPECT_GE(top_of("status camera"), 0);
  const float tile = top_of("open cameras");
  ASSERT_GE(tile, 0);
  world.status.looked = true;
  world.status.free_mib = 10'000;
  EXPECT_EQ(top_of("open cameras"), tile);
  EXPECT_GE(top_of("status camera"), 0);
}

TEST(StatusTable, TheWorstComesFirst) {
  World world;
  world.status.device_faults = 2;
  world.view.out_of_order = Trouble::Clock;
  world.status.camera_away = true;
  world.staff.access.words_due = true;
  const std::span<const Finding> found = world.found();
  ASSERT_EQ(found.size(), 4U);
  EXPECT_EQ(found[0].rule->id, "clock");
  EXPECT_EQ(found[1].rule->id, "camera");
  EXPECT_EQ(found[1].mood, Mood::Bad);
  EXPECT_EQ(found[2].mood, Mood::Warn);
  EXPECT_EQ(found[3].mood, Mood::Warn);
}

}  // namespace
}  // namespace relievo::ui
