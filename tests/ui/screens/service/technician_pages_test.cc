// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the technician's picture pages say of a result, without one having been made.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string_view>

#include "tests/support/made_screen.h"
#include "ui/technician/technician_view.h"

namespace relievo::ui {
namespace {

class TechnicianPagesTest : public testing::Test {
 protected:
  TechnicianPagesTest() {
    staff.role = StaffRole::Technician;
    staff.technician = &seen;
    view.screen = Screen::Staff;
    view.service = &staff;
  }
  void open(StaffPage page) {
    Service service;
    service.show(page);
    ui->show(view, {}, service);
  }
  bool shows(std::string_view id) const { return ui->tree().find(id) != nullptr; }
  // Within the row of that name.
  bool row_says(std::string_view id, std::string_view words) const {
    const auto& nodes = ui->tree().nodes();
    return std::ranges::any_of(nodes, [&](const Node& node) {
      if (node.text.find(words) == std::string_view::npos) return false;
      for (auto at = node.parent; at >= 0; at = nodes[std::size_t(at)].parent)
        if (nodes[std::size_t(at)].id == id) return true;
      return false;
    });
  }

  std::unique_ptr<Ui> ui = test::make_screen();
  TechnicianView seen;
  ServiceView staff;
  ViewState view;
};

// With a square given wrongly it ends at once, and asks for more views in the same breath.
TEST_F(TechnicianPagesTest, OfARefusedCalibrationNobodyHearsThatItCouldHardlyBeBetter) {
  seen.calibration.ended = true;
  seen.calibration.end = pipeline::LiveEnd::Plateau;
  for (const auto verdict : {pipeline::CalibrationVerdict::Pass, pipeline::CalibrationVerdict::Usable,
                             pipeline::CalibrationVerdict::Refuse}) {
    seen.calibration.verdict = verdict;
    open(StaffPage::Calibrate);
    EXPECT_TRUE(shows("verdict"));
    EXPECT_EQ(shows("ended"), verdict != pipeline::CalibrationVerdict::Refuse) << int(verdict);
  }
}

TEST_F(TechnicianPagesTest, APointWithoutItsPartnerIsNoPair) {
  seen.phase = TechnicianPhase::Ready;
  seen.result.there = true;
  seen.by_hand = true;
  std::array<TechnicianPoint, 3> points;
  for (TechnicianPoint& point : points) point.touched = point.by_hand = point.waits_for_right = true;
  seen.pairs = points;
  seen.stage = TechnicianStage::Rectified;
  open(StaffPage::Stages);
  EXPECT_FALSE(shows("pairs"));
  points[0].matched = points[2].matched = true;
  open(StaffPage::Stages);
  ASSERT_TRUE(shows("pairs"));
  EXPECT_TRUE(row_says("pairs", "2"));
}

}  // namespace
}  // namespace relievo::ui
