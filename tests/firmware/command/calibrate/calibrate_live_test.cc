// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/calibrate/calibrate_command.h"
#include "firmware/demo/hand_pairs.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "hal/picture_file.h"
#include "hal/sim/device.h"
#include "pipeline/calibrate/file/calibration_file.h"
#include "tests/firmware/command/calibrate/kept_lines.h"
#include "tests/pipeline/calibrate/live/held_board_pictures.h"
#include "tests/support/proof.h"
#include "tests/support/temporary_folder.h"

namespace relievo::tests {
namespace {

namespace fs = std::filesystem;
using pipeline::LiveEnd;

BoardAt at(const firmware::HeldPose& h) {
  return {h.right_mm, h.down_mm, h.distance_mm, h.yaw_deg, h.pitch_deg, h.roll_deg};
}

struct Practice {
  pipeline::LiveState state;
  double true_error_mm = 0;
  double error_mm = 0;
};

// A hand that follows the words, another rig and other noise for every seed.
Practice practise(unsigned seed, const firmware::HandOptions& options = {}) {
  const pipeline::BoardPattern pattern{7, 5, 28};
  HeldBoardCorners board(kiosk_rig(seed), pattern, 0.03, seed);
  auto collector = *pipeline::ViewCollector::begin(pattern, 1920, 1200, {});
  firmware::AdvisedHand hand(options, seed);
  for (int i = 0; i < 1000 && !collector.state().done(); ++i) {
    const BoardAt held = at(hand.follow(collector.state().advice, collector.state().how_far));
    if (!*collector.consider(board.pair(held))) continue;
    EXPECT_TRUE(collector.take(board.seen(0, held).corners, board.seen(1, held).corners));
  }
  Practice done{collector.state(), 0, collector.state().error_mm};
  if (const auto result = collector.finish())
    done.true_error_mm = board.true_error_mm(result->calibration, 560);
  return done;
}

TEST(AdvisedHand, ReachesTheGoalInFewViewsAndTheErrorIsAsPredicted) {
  RELIEVO_MANY_TRIALS();
  constexpr unsigned kSeeds = 10;
  double squared = 0;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    const Practice done = practise(seed);
    EXPECT_EQ(done.state.end, LiveEnd::GoalReached) << seed;
    EXPECT_LE(done.state.views, 25) << seed;
    EXPECT_GE(done.state.views, 10) << seed;
    EXPECT_LE(done.error_mm, 0.1) << seed;
    EXPECT_EQ(done.state.disagreeing, 0) << seed;
    EXPECT_GT(done.true_error_mm, 0) << seed;
    EXPECT_LT(done.true_error_mm, 3 * done.error_mm) << seed;
    squared += done.true_error_mm * done.true_error_mm / (done.error_mm * done.error_mm) / kSeeds;
  }
  // One standard deviation promised, and about that large it is.
  EXPECT_LT(squared, 2.5);
  EXPECT_GT(squared, 0.2);
}

TEST(AdvisedHand, AnUnsteadyHandGetsThereToo) {
  firmware::HandOptions unsteady;
  unsteady.tremor_mm = 0.3;
  unsteady.dreams = 0.3;
  const Practice done = practise(4, unsteady);
  EXPECT_EQ(done.state.end, LiveEnd::GoalReached);
  EXPECT_LT(done.true_error_mm, 3 * done.error_mm);
}

TEST(AdvisedHand, IsTheSameForTheSameSeed) {
  firmware::AdvisedHand a({}, 5);
  firmware::AdvisedHand b({}, 5);
  firmware::AdvisedHand c({}, 6);
  bool differs = false;
  for (int i = 0; i < 20; ++i) {
    const auto p = a.follow(pipeline::LiveAdvice::Left, 5);
    const auto q = b.follow(pipeline::LiveAdvice::Left, 5);
    EXPECT_EQ(p.right_mm, q.right_mm);
    differs = differs || p.right_mm != c.follow(pipeline::LiveAdvice::Left, 5).right_mm;
  }
  EXPECT_TRUE(differs);
  EXPECT_LT(a.pose().right_mm, -100);
}

class CalibrateLive : public ::testing::Test {
 protected:
  firmware::CalibrateLiveArgs args() const {
    firmware::CalibrateLiveArgs args;
    args.board = {10, 7, 20};
    args.output = folder_.path() / "rig.yml";
    args.cameras = "here";
    return args;
  }
  // Goes round the poses, each photographed as often as told.
  void record(HeldBoardPictures& board, const std::vector<BoardAt>& poses) {
    fs::create_directories(pictures());
    int number = 0;
    for (const BoardAt& pose : poses) {
      const auto pair = board.pair(pose);
      const std::string name = std::to_string(1000 + number++) + ".png";
      ASSERT_TRUE(hal::write_picture(pictures() / ("left_" + name), pair.left.view()));
      ASSERT_TRUE(hal::write_picture(pictures() / ("right_" + name), pair.right.view()));
    }
  }
  Result<pipeline::CalibratorOutput> replay() {
    RELIEVO_TRY_ASSIGN(auto device, hal::make_folder_device(pictures()));
    RELIEVO_TRY_ASSIGN(const auto pairs,
                       firmware::make_device_pairs(std::move(device), "folder:" + pictures().string()));
    return firmware::run_calibrate_live(args(), *pairs, out_.tell());
  }
  fs::path pictures() const { return folder_.path() / "in"; }
  int said(const std::string& words) const {
    int count = 0;
    const std::string text = out_.str();
    for (auto place = text.find(words); place != std::string::npos; place = text.find(words, place + 1))
      ++count;
    return count;
  }

  test::TemporaryFolder folder_;
  KeptLines out_;
};

// Pictures, a hand, motion blur, and all: the whole way at a quarter of the size.
TEST_F(CalibrateLive, AHandBeforeTheSimulatedRigGetsACalibration) {
  HeldBoardPictures board(480, 300);
  const auto pairs = firmware::make_hand_pairs(
      [&](const firmware::HeldPose& opened, const firmware::HeldPose& closed, std::uint64_t) {
        auto pair = board.pair(at(opened), at(closed));
        return firmware::HeldPair{std::move(pair.left), std::move(pair.right)};
      },
      3);
  const auto done = firmware::run_calibrate_live(args(), *pairs, out_.tell());
  ASSERT_TRUE(done) << done.error().what.view();
  EXPECT_EQ(said("goal reached"), 1) << out_.str();
  EXPECT_EQ(said("verdict: pass"), 1);
  EXPECT_LE(said(": taken as view"), 25);
  EXPECT_GE(said(": moving"), 30);
  const auto written = pipeline::read_calibration(args().output);
  ASSERT_TRUE(written);
  const auto& truth = board.rig();
  EXPECT_NEAR(done->quality.baseline_mm, hal::sim::length(truth.right.centre()), 0.1);
  EXPECT_NEAR(written->left.focal_px.x, truth.left.fx_px, 0.002 * truth.left.fx_px);
}

TEST_F(CalibrateLive, PhotographsAreTakenForABoardThatIsHeldStill) {
  HeldBoardPictures board(480, 300);
  record(board, {{},
                 {0, 0, 560, 36},
                 {},
                 {0, 0, 560, -36},
                 {0, 0, 560, 0, 36},
                 {0, 0, 560, 0, -36},
                 {20, 10, 640, 30, 30},
                 {-20, -10, 640, -30, 30}});
  const auto done = replay();
  ASSERT_TRUE(done) << done.error().what.view();
  EXPECT_EQ(said(": taken as view"), 7) << out_.str();
  EXPECT_EQ(said(": already have"), 1) << "the one that comes twice";
  EXPECT_EQ(said("no more pairs: 7 of 16 pairs taken"), 1);
  EXPECT_TRUE(fs::exists(args().output));
}

TEST_F(CalibrateLive, ARecordingShowsItsOwnMotion) {
  HeldBoardPictures board(480, 300);
  record(board, {{},
                 {0, 0, 560, 36},
                 {10, 0, 560, -36},
                 {0, 0, 560, 0, 36},
                 {0, 0, 560, 0, -36},
                 {20, 10, 640, 30, 30}});
  test::write_text(pictures() / "capture.json", R"({"frames": []})");
  const auto done = replay();
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, Errc::PoorGeometry) << "it never held still";
  EXPECT_EQ(said(": moving"), 6) << out_.str();
  EXPECT_FALSE(fs::exists(args().output));
}

TEST_F(CalibrateLive, SaysWhatIsWrong) {
  HeldBoardPictures board(480, 300);
  record(board, {{}, {}});
  auto where = args();
  where.output = folder_.path() / "no" / "rig.yml";
  auto pairs =
      *firmware::make_device_pairs(*hal::make_folder_device(pictures()), "folder:" + pictures().string());
  EXPECT_EQ(firmware::run_calibrate_live(where, *pairs, out_.tell()).error().code, Errc::NotFound);
  EXPECT_TRUE(out_.str().empty()) << "asked before anything is looked at";
  pairs = *firmware::make_device_pairs(*hal::make_folder_device(pictures()), "folder:" + pictures().string());
  auto tiny = args();
  tiny.board = {2, 2, 20};
  EXPECT_EQ(firmware::run_calibrate_live(tiny, *pairs, out_.tell()).error().code, Errc::InvalidInput);
  EXPECT_EQ(replay().error().code, Errc::PoorGeometry);
  EXPECT_FALSE(fs::exists(args().output));
}

}  // namespace
}  // namespace relievo::tests
