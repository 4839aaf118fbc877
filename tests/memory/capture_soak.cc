// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Captures on end: a person is found and judged in the live picture, a burst is shot as before a live device,
// and its best pair is refused, so that no model costs time. Between two of them a minute goes by on the
// appliance's clock. Fails where a capture is not counted, or memory, open files or threads grow.
//
// Then visits of people who turn their heads (turning_visits.h), from number FIRST on.
//
//   capture_soak CAPTURES [VISITS [FIRST]]
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "firmware/appliance/appliance.h"
#include "firmware/base/process_memory.h"
#include "firmware/capture/live_judge.h"
#include "hal/sim/device.h"
#include "tests/firmware/faults/faulty_rig.h"
#include "tests/firmware/test_records.h"
#include "tests/memory/turning_visits.h"
#include "tests/memory/usage.h"
#include "tests/support/rig_calibration.h"
#include "tests/support/small_device.h"

namespace relievo::test {
namespace {

using firmware::State;
using std::chrono::milliseconds;

constexpr int kWarm = 30;          // captures until everything has been used once
constexpr double kMayGrow = 1.01;  // of what is resident, from then to the end
constexpr double kScale = 0.3;     // of the rig's pictures

class LiveRig final : public FaultyRig {
 public:
  using FaultyRig::FaultyRig;
  bool is_live() const override { return true; }
};

// Takes no picture for good, as of somebody who moved.
class Refusing final : public firmware::StageRunner {
 public:
  std::atomic<int> captures{0};
  Result<void> run(State, firmware::Products& products, pipeline::StageContext&,
                   firmware::StageRecord&) override {
    if (products.frame && !products.frame->left.empty()) ++captures;
    return Error{Errc::TooFewMatches, "as the soak says"};
  }
  Result<void> add_pose(const pipeline::StereoFrame&, const pipeline::FaceModel&,
                        std::vector<pipeline::HeadPose>&, pipeline::StageContext&, Arena&) override {
    return Error{Errc::Unsupported, "no sides here"};
  }
  Result<pipeline::FusedHead> fuse(const pipeline::FaceModel&, std::span<pipeline::HeadPose>,
                                   pipeline::StageContext&) override {
    return Error{Errc::Unsupported, "no sides here"};
  }
};

class Soak {
 public:
  Soak(hal::Device& real, firmware::LiveJudge& judge)
      : rig_(real, faults_, real.media()), appliance_({rig_, stages_, memory_, pool_, records_, &judge}) {
    appliance_.on_change([this](const firmware::Transition& change) {
      if (change.from == State::Capture && change.to == State::Match) ++taken_;
    });
  }
  // False: it is stuck.
  bool capture() {
    const auto pairs_before = [this] { return appliance_.grabber().counts().pairs; };
    if (appliance_.state() != State::Position) {
      if (!reach(State::Idle)) return false;
      faults_.ahead_s += 60;
      appliance_.expect(firmware::named("Ada"));
      appliance_.ask(ui::Intent::Pose);
    }
    const bool judged = until([this] { return appliance_.live().newest().number > 0; });
    const std::uint64_t before = pairs_before();
    const int taken = taken_;
    appliance_.ask(ui::Intent::Begin);
    const bool done = judged && until([&] { return taken_ > taken && appliance_.state() != State::Match; });
    burst_pairs_short_ += pairs_before() - before < firmware::budget::kBurstPairs ? 1 : 0;
    return done;
  }
  int taken() const { return taken_; }
  int refused() const { return stages_.captures.load(); }
  int short_bursts() const { return burst_pairs_short_; }
  const firmware::GrabCounts& counts() { return appliance_.grabber().counts(); }

 private:
  template <typename Reached>
  bool until(const Reached& reached) {
    for (int turn = 0; turn < 60'000 && !reached(); ++turn) appliance_.step(milliseconds(1));
    return reached();
  }
  bool reach(State state) {
    return until([this, state] { return appliance_.state() == state; });
  }

  RigFaults faults_;
  LiveRig rig_;
  Refusing stages_;
  firmware::BootMemory memory_;
  ThreadPool pool_{2};
  std::string kept_;
  std::deque<Errc> errors_;
  firmware::TestRecords records_{kept_, errors_};
  int taken_ = 0, burst_pairs_short_ = 0;
  firmware::Appliance appliance_;
};

int soak(int captures) {
  if (!firmware::take_heap(firmware::budget::kHeapBytes)) return std::puts("no heap"), 1;
  const hal::SimDeviceOptions options = small_device(kScale);
  auto device = hal::make_sim_device(options);
  if (!device) return std::puts("the rig does not open"), 1;
  auto judge = firmware::LiveJudge::open(true_calibration(hal::sim::make_rig(options.simulation.rig)));
  if (!judge) return std::puts("nothing judges"), 1;
  Soak soak(**device, *judge);
  Usage warm;
  for (int number = 1; number <= captures; ++number) {
    if (!soak.capture()) return std::printf("stuck at capture %d\n", number), 1;
    if (number == kWarm) warm = Usage::now();
    if (number % 1'000 != 0 && number != kWarm && number != captures) continue;
    const Usage now = Usage::now();
    std::printf("capture %d: %.1f MiB resident, %.1f MiB in use, %td files, %td threads\n", number,
                now.resident_mib, now.in_use_mib, now.files, now.threads);
    std::fflush(stdout);
  }
  const Usage end = Usage::now();
  const auto& counts = soak.counts();
  std::uint64_t wrong = counts.apart + counts.slipped;
  for (const auto& camera : {counts.left, counts.right})
    wrong += camera.late + camera.lost + camera.duplicate + camera.damaged + camera.too_short +
             camera.missing + camera.vanished;
  // The capture thread goes on: one camera may have given a picture of which the other's is yet to come.
  const auto ahead =
      std::max(counts.left.frames, counts.right.frames) - std::min(counts.left.frames, counts.right.frames);
  const bool counted = soak.taken() == captures && soak.refused() == captures && soak.short_bursts() == 0 &&
                       wrong == 0 && ahead <= 1;
  std::printf(
      "%d captures asked, %d taken, %d handed to the stages, %lu pairs of %lu and %lu pictures, %lu faults\n",
      captures, soak.taken(), soak.refused(), std::uint64_t(counts.pairs), std::uint64_t(counts.left.frames),
      std::uint64_t(counts.right.frames), wrong);
  std::printf("after warm-up: resident memory x %.4f, files %+td, threads %+td\n",
              end.resident_mib / warm.resident_mib, end.files - warm.files, end.threads - warm.threads);
  return counted && end.resident_mib <= kMayGrow * warm.resident_mib && end.files == warm.files &&
                 end.threads == warm.threads
             ? 0
             : 1;
}

}  // namespace
}  // namespace relievo::test

int main(int argc, char** argv) {
  const auto number = [&](int i) { return argc > i ? std::atoi(argv[i]) : 0; };
  const int captures = number(1), visits = number(2);
  if ((captures < 60 && captures != 0) || captures + visits < 1)
    return std::puts("capture_soak CAPTURES [VISITS [FIRST]]   (0 captures, or 60 at least)"), 2;
  if (captures > 0 && relievo::test::soak(captures) != 0) return 1;
  return visits == 0 || relievo::test::turning_visits(visits, number(3)) ? 0 : 1;
}
