// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A head's pairs on a stick that cannot take them all: nothing of them stands, neither there nor in the place
// where the stick was, and the page says what happened.
#include <algorithm>
#include <filesystem>

#include "hal/recording/capture_file.h"
#include "hal/sim/replay/replay_device.h"
#include "tests/firmware/technician/technician_fixture.h"

namespace relievo::firmware {
namespace {

namespace fs = std::filesystem;
using ui::Outcome;

class HeadRecordingTest : public TechnicianTest {
 protected:
  static void SetUpTestSuite() {
    TechnicianTest::SetUpTestSuite();
    rig().open(StaffPage::Stages);
    rig().tap("capture");
    ASSERT_TRUE(rig().until(finished));
    for (std::size_t side = 1; side <= 2; ++side) {
      rig().tap("add side");
      ASSERT_TRUE(rig().until([&] { return finished() && rig().now().sides == side; }))
          << rig().now().problem.detail;
    }
  }
  static hal::FolderMedia& socket() { return dynamic_cast<hal::FolderMedia&>(rig().device->media()); }
  static bool ended() { return rig().now().recording.outcome != Outcome::None; }
  static bool says(std::string_view words) {
    return std::ranges::any_of(rig().screen->tree().nodes(), [&](const ui::Node& node) {
      return node.text.find(words) != std::string_view::npos;
    });
  }
  // What is left half written, too; of a folder that is there.
  static std::ptrdiff_t files_in(const fs::path& folder) {
    return std::ranges::count_if(fs::recursive_directory_iterator(folder),
                                 [](const fs::directory_entry& entry) { return entry.is_regular_file(); });
  }
  static void ends_well() {
    rig().plug_in();
    rig().tap("record");
    ASSERT_TRUE(rig().until(ended));
    ASSERT_EQ(rig().now().recording.outcome, Outcome::Done);
    recording = rig().stick() / rig().now().recording.where;
    EXPECT_EQ(files_in(rig().stick()), 7) << "six pictures and capture.json, and nothing of before";
    EXPECT_TRUE(hal::recorded_pictures(recording));
  }
  static inline fs::path recording;  // the last that went well
};

TEST_F(HeadRecordingTest, AStickThatIsFullAfterTheFirstPairHasNone) {
  ends_well();
  std::size_t bytes = 0;
  for (const auto& file : fs::directory_iterator(recording)) bytes += std::size_t(file.file_size());
  fs::remove_all(recording);
  const test::TinyDisk full(bytes / 2);
  if (!full.mounted()) GTEST_SKIP() << full.why_not();
  socket().plug(full.path());
  rig().tap("record");
  ASSERT_TRUE(rig().until(ended));
  EXPECT_EQ(rig().now().recording.outcome, Outcome::StickFull);
  EXPECT_TRUE(says("no room left"));
  EXPECT_EQ(test::listing(full.path()), "");
  ends_well();
  fs::remove_all(recording);
}

// The system has let go of it: its place is an empty folder of the device.
TEST_F(HeadRecordingTest, AStickThatIsPulledAfterTheFirstPairHasNoneAndNorHasItsPlace) {
  const fs::path hand = rig().folder.path() / "hand";
  fs::create_directories(rig().stick() / "captures");
  rig().plug_in();
  rig().tap("record");
  ASSERT_TRUE(rig().until([] { return files_in(rig().stick()) > 2; }));
  socket().unplug();
  fs::rename(rig().stick(), hand);
  fs::create_directory(rig().stick());
  ASSERT_TRUE(rig().until(ended));
  EXPECT_EQ(rig().now().recording.outcome, Outcome::StickGone);
  EXPECT_TRUE(says("pulled out too early"));
  EXPECT_EQ(test::listing(rig().stick()), "");
  const std::ptrdiff_t kept = files_in(hand);
  EXPECT_GT(kept, 2);
  EXPECT_LT(kept, 7) << "pulled too late to try anything";
  for (const auto& entry : fs::directory_iterator(hand / "captures"))
    EXPECT_TRUE(entry.path().filename().string().starts_with('.')) << "could be taken for a recording";
  fs::remove(rig().stick());
  fs::rename(hand, rig().stick());
  ends_well();
  fs::remove_all(recording);
}

}  // namespace
}  // namespace relievo::firmware
