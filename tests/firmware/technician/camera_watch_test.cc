// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The shape of whoever stood before the watched cameras is nowhere in memory when nobody watches any more.
#include "firmware/technician/technician_jobs.h"

#include <string.h>

#include <algorithm>
#include <array>
#include <vector>

#include "tests/firmware/technician/technician_fixture.h"
#include "tests/support/memory_search.h"

namespace relievo::firmware {
namespace {

// From the middle of the relief: as it is shown, three bytes a pixel, and as it was drawn, one.
std::array<test::Canary, 2> piece_of(const ImageView& relief) {
  const int width = std::min(relief.width_px / 2, 60);
  const std::uint8_t* const from =
      relief.row(relief.height_px / 2) + std::ptrdiff_t{3} * ((relief.width_px - width) / 2);
  const std::span shown(reinterpret_cast<const std::byte*>(from), std::size_t(3 * width));
  std::vector<std::byte> drawn;
  for (std::size_t i = 0; i < shown.size(); i += 3) drawn.push_back(shown[i]);
  std::array<test::Canary, 2> piece{test::Canary("the relief as it is shown", shown),
                                    test::Canary("the relief as it was drawn", drawn)};
  explicit_bzero(drawn.data(), drawn.size());
  return piece;
}

TEST_F(TechnicianTest, TheReliefIsWipedWhenNobodyWatchesTheCamerasAnyMore) {
  const auto watch_relief = [] {
    rig().open(StaffPage::Cameras);
    ASSERT_TRUE(rig().until([] { return rig().shows("show relief"); })) << rig().now().problem.detail;
    if (!rig().now().cameras.relief_shown) rig().tap("show relief");
    ASSERT_TRUE(rig().until([] { return !rig().now().cameras.relief.pixels.empty(); }))
        << rig().now().cameras.problem.detail;
  };
  const auto is_at_rest = [] { return !rig().side_tasks->busy(JobLane::Capture); };
  test::MemorySearch search;
  ASSERT_NO_FATAL_FAILURE(watch_relief());
  auto piece = piece_of(rig().now().cameras.relief.pixels);
  EXPECT_FALSE(search.find(std::span(piece).first(1)).empty()) << "the search finds nobody";
  rig().open(StaffPage::Stages);
  ASSERT_TRUE(rig().until(is_at_rest));
  EXPECT_TRUE(rig().now().cameras.relief.pixels.empty());
  for (const std::string& line : search.find(piece)) ADD_FAILURE() << line;

  // Who leaves in the middle of it.
  ASSERT_NO_FATAL_FAILURE(watch_relief());
  piece = piece_of(rig().now().cameras.relief.pixels);
  rig().appliance->ask(ui::Intent::LeaveStaff);
  rig().side_tasks->cancel();
  rig().turn();
  ASSERT_TRUE(rig().until(is_at_rest));
  for (const std::string& line : search.find(piece)) ADD_FAILURE() << line;
  rig().appliance->ask(ui::Intent::OpenStaff);
  rig().turn();
  ASSERT_EQ(rig().appliance->state(), State::Staff);
  rig().open(StaffPage::Stages);
}

}  // namespace
}  // namespace relievo::firmware
