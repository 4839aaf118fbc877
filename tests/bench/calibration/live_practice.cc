// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Does a person who follows the advice of a live calibration get there, and sooner than without? N hands
// (default 100) before as many rigs, corners with noise: how many views and pairs (ten a second) they took
// until the goal was reached, how the true depth error at 560 mm compares with the predicted one, and the
// same of hands that hear nothing and hold the board anywhere, tilted anyhow, as fast and as still.
// Exit code 1 when an advised hand does not reach the goal, or the errors are not as predicted.
//   live_practice [N] [NOISE_PX]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <vector>

#include "firmware/demo/hand_pairs.h"
#include "tests/pipeline/calibrate/live/held_board.h"

namespace relievo::tests {
namespace {

const pipeline::BoardPattern kPattern{10, 7, 20};
constexpr int kMostPairs = 3000;

BoardAt at(const firmware::HeldPose& h) {
  return {h.right_mm, h.down_mm, h.distance_mm, h.yaw_deg, h.pitch_deg, h.roll_deg};
}

// Hears nothing: goes from one place where both cameras see the board to another, at the pace of a hand
// that is advised, and rests a moment in each.
class WanderingHand {
 public:
  WanderingHand(HeldBoardCorners& board, unsigned seed) : board_(board), random_(seed) {}

  BoardAt next() {
    if (rest_ == 0) choose();
    const firmware::HandOptions usual;
    bool there = true;
    for (const Axis axis : {&BoardAt::right_mm, &BoardAt::down_mm, &BoardAt::distance_mm, &BoardAt::yaw_deg,
                            &BoardAt::pitch_deg, &BoardAt::roll_deg}) {
      const double most = is_length(axis) ? usual.step_mm : usual.step_deg;
      const double off = aim_.*axis - held_.*axis;
      there = there && std::abs(off) < 1e-9;
      held_.*axis += std::clamp(off, -most, most);
    }
    if (there) --rest_;
    BoardAt trembling = held_;
    for (const Axis axis : {&BoardAt::right_mm, &BoardAt::down_mm, &BoardAt::distance_mm, &BoardAt::yaw_deg,
                            &BoardAt::pitch_deg, &BoardAt::roll_deg})
      trembling.*axis +=
          std::normal_distribution<double>(0, is_length(axis) ? usual.tremor_mm : usual.tremor_deg)(random_);
    return trembling;
  }

 private:
  using Axis = double BoardAt::*;
  static bool is_length(Axis axis) {
    return axis == &BoardAt::right_mm || axis == &BoardAt::down_mm || axis == &BoardAt::distance_mm;
  }
  void choose() {
    const auto within = [&](double most) {
      return std::uniform_real_distribution<double>(-most, most)(random_);
    };
    do {
      aim_ = {within(120), within(80), 600 + within(150), within(45), within(45), within(30)};
    } while (board_.seen(0, aim_).corners.empty() || board_.seen(1, aim_).corners.empty());
    rest_ = kRestPairs;
  }

  static constexpr int kRestPairs = 3;
  HeldBoardCorners& board_;
  std::mt19937 random_;
  BoardAt held_;
  BoardAt aim_;
  int rest_ = 0;
};

// `hand` gives the pose at the next pair from what was said after the one before.
template <typename Hand>
pipeline::ViewCollector practise(HeldBoardCorners& board, Hand hand) {
  auto collector = *pipeline::ViewCollector::begin(kPattern, 1920, 1200, {});
  for (int i = 0; i < kMostPairs && !collector.state().done(); ++i) {
    const BoardAt held = hand(collector.state());
    const auto wanted = collector.consider(board.pair(held));
    if (!wanted || !*wanted) continue;
    if (!collector.take(board.seen(0, held).corners, board.seen(1, held).corners))
      std::printf("a view was refused\n");
  }
  return collector;
}

class Record {
 public:
  void add(const pipeline::ViewCollector& collector, const HeldBoardCorners& board) {
    const pipeline::LiveState& s = collector.state();
    const auto result = collector.finish();
    const double ratio = result ? board.true_error_mm(result->calibration, 560) / s.error_mm : 1e9;
    squared_ratio_ += ratio * ratio;
    within_one_ += ratio <= 1 ? 1 : 0;
    within_two_ += ratio <= 2 ? 1 : 0;
    error_mm_ += s.error_mm;
    reached_ += s.end == pipeline::LiveEnd::GoalReached ? 1 : 0;
    views_.push_back(s.views);
    pairs_.push_back(s.pairs);
  }
  bool all_reached() const { return reached_ == hands(); }
  double rms_ratio() const { return std::sqrt(squared_ratio_ / hands()); }
  void tell(const char* who) {
    std::sort(views_.begin(), views_.end());
    std::sort(pairs_.begin(), pairs_.end());
    std::printf("%s: %d of %d reached the goal; views: median %d, most %d; pairs: median %d, most %d\n", who,
                reached_, hands(), middle(views_), views_.back(), middle(pairs_), pairs_.back());
    std::printf(
        "  predicted error %.4f mm; true over predicted: rms %.2f, within 1 sigma %.0f %%, 2 sigma %.0f %%\n",
        error_mm_ / hands(), rms_ratio(), 100.0 * within_one_ / hands(), 100.0 * within_two_ / hands());
  }

 private:
  int hands() const { return static_cast<int>(views_.size()); }
  static int middle(const std::vector<int>& sorted) { return sorted[sorted.size() / 2]; }
  std::vector<int> views_, pairs_;
  double squared_ratio_ = 0, error_mm_ = 0;
  int reached_ = 0, within_one_ = 0, within_two_ = 0;
};

void practise_both(Record& advised, Record& unadvised, unsigned seed, double noise_px) {
  HeldBoardCorners board(kiosk_rig(seed), kPattern, noise_px, seed);
  firmware::AdvisedHand hand({}, seed);
  advised.add(
      practise(board, [&](const pipeline::LiveState& s) { return at(hand.follow(s.advice, s.how_far)); }),
      board);
  WanderingHand wandering(board, seed);
  unadvised.add(practise(board, [&](const pipeline::LiveState&) { return wandering.next(); }), board);
}

}  // namespace
}  // namespace relievo::tests

int main(int argc, char** argv) {
  const int hands = std::max(1, argc > 1 ? std::atoi(argv[1]) : 100);
  const double noise_px = argc > 2 ? std::atof(argv[2]) : 0.03;
  relievo::tests::Record advised, unadvised;
  for (int seed = 1; seed <= hands; ++seed)
    relievo::tests::practise_both(advised, unadvised, static_cast<unsigned>(seed), noise_px);
  advised.tell("advised");
  unadvised.tell("not advised");
  const double rms = advised.rms_ratio();
  return advised.all_reached() && rms > 0.7 && rms < 1.3 ? 0 : 1;
}
