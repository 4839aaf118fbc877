// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// TechnicianTest: one TechnicianRig for all tests of a program: what they do by touch, and what they wait
// for.
#pragma once

#include <stdexcept>
#include <string>

#include "tests/firmware/technician/technician_rig.h"

namespace relievo::firmware {

using test_technician::TechnicianRig;
using ui::StaffPage;
using ui::TechnicianPhase;
using ui::TechnicianStage;

class TechnicianTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { rig_ = new TechnicianRig; }
  static void TearDownTestSuite() { delete rig_; }
  // What a test has put aside is none of the next one's.
  void TearDown() override {
    if (rig().now().put_aside == 0) return;
    rig().open(StaffPage::Compare);
    EXPECT_TRUE(rig().until([] {
      if (rig().shows("drop 0")) rig().tap("drop 0");
      return rig().now().put_aside == 0;
    }));
  }
  static TechnicianRig& rig() { return *rig_; }
  static bool finished() {
    return rig().now().phase == TechnicianPhase::Ready || rig().now().phase == TechnicianPhase::Failed;
  }
  // One is enough for all that only look at it.
  static void capture() {
    rig().open(StaffPage::Stages);
    if (rig().now().phase == TechnicianPhase::Ready && rig().now().result.algorithms.empty()) return;
    rig().tap("capture");
    ASSERT_TRUE(rig().until(finished));
    ASSERT_EQ(rig().now().phase, TechnicianPhase::Ready) << rig().now().problem.detail;
    ASSERT_EQ(rig().now().result.failure.detail, "");
  }
  static void calibrate() {
    rig().tap("calibration begin");
    ASSERT_TRUE(rig().until([] { return rig().appliance->state() == State::Calibrate; }));
    ASSERT_TRUE(rig().until([] { return rig().now().calibration.views > 0; }));
    EXPECT_FALSE(rig().now().calibration.pictures[0].pixels.empty());
    EXPECT_TRUE(rig().shows("advice"));
    ASSERT_TRUE(
        rig().until([] { return rig().now().calibration.views >= 7 || !rig().now().calibration.running; }));
    if (rig().now().calibration.running) rig().tap("calibration finish");
    ASSERT_TRUE(rig().until([] { return rig().now().calibration.ended; }))
        << rig().now().calibration.problem.detail;
  }
  static void again() {
    rig().tap("run");
    ASSERT_TRUE(rig().until(finished));
    ASSERT_EQ(rig().now().phase, TechnicianPhase::Ready) << rig().now().problem.detail;
  }
  // Throws where the machine has ended the session, as it does when a stage takes longer than it may.
  static Products& products() {
    if (!rig().appliance->session().is_open()) throw std::logic_error("the session was ended");
    return rig().appliance->session().products();
  }
  // The places of an identifier in the choice.
  static std::string kind(std::string_view key) {
    const auto& kinds = rig().now().choice.kinds;
    for (std::size_t i = 0; i < kinds.size(); ++i)
      if (kinds[i].key == key) return "kind " + std::to_string(i);
    return "no kind";
  }
  static std::string name(std::string_view algorithm) {
    const auto& names = rig().now().choice.names;
    for (std::size_t i = 0; i < names.size(); ++i)
      if (names[i].name == algorithm) return "name " + std::to_string(i);
    return "no name";
  }
  static std::string option(std::string_view key) {
    const auto& options = rig().now().choice.options;
    for (std::size_t i = 0; i < options.size(); ++i)
      if (options[i].key == key) return "option " + std::to_string(i);
    return "no option";
  }

 private:
  static inline TechnicianRig* rig_ = nullptr;
};

}  // namespace relievo::firmware
