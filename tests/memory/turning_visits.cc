// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/memory/turning_visits.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "firmware/appliance/appliance.h"
#include "tests/firmware/test_records.h"
#include "tests/memory/turning_rig.h"

namespace relievo::test {
namespace {

using firmware::State;
using Kind = TurningPerson::Kind;

constexpr int kKiosks = 4;
constexpr std::uint32_t kFirstPerson = 21, kPeople = 2;
constexpr std::uint32_t kKinds = std::uint32_t(Kind::Count);
constexpr std::array<const char*, kKinds> kNames{
    "willing", "too fast", "back and forth", "wrong way first", "a second face", "half", "leaves"};
static_assert(kNames.back() != nullptr);
// Of a picture that shows a side: where the head truly stood.
constexpr int kLeastDeg = 15, kMostDeg = 55;

enum Outcome : std::uint8_t { Both, One, None, Stuck, Outcomes };

// Makes nothing of a face; notes which sides the pairs truly show.
class NotingStages final : public firmware::StageRunner {
 public:
  bool left = false, right = false;
  Result<void> run(State stage, firmware::Products& products, pipeline::StageContext& context,
                   firmware::StageRecord&) override {
    if (stage == State::Assemble) products.model.emplace(&context.output);
    return {};
  }
  Result<void> add_pose(const pipeline::StereoFrame& pair, const pipeline::FaceModel&,
                        std::vector<pipeline::HeadPose>& poses, pipeline::StageContext&,
                        Arena& kept) override {
    const int yaw = TurningRig::true_yaw_deg(pair).value_or(0);
    if (std::abs(yaw) >= kLeastDeg && std::abs(yaw) <= kMostDeg) (yaw < 0 ? left : right) = true;
    poses.emplace_back(&kept);
    return {};
  }
  Result<pipeline::FusedHead> fuse(const pipeline::FaceModel&, std::span<pipeline::HeadPose>,
                                   pipeline::StageContext& context) override {
    return pipeline::FusedHead{pipeline::FaceModel(&context.output), pipeline::Registration(&context.output)};
  }
};

class Kiosk {
 public:
  Kiosk(TurningPictures& pictures, firmware::LiveJudge judge)
      : rig_(pictures),
        judge_(std::move(judge)),
        appliance_({rig_, stages_, memory_, pool_, records_, &judge_}) {
    appliance_.ask_for_sides(true);
    appliance_.on_change([this](const firmware::Transition& change) {
      if (change.to == State::Review) sides_ = int(stages_.left) + int(stages_.right);
    });
  }

  Outcome visit(std::uint32_t person, Kind kind, std::uint32_t seed) {
    if (!until([&] { return appliance_.state() == State::Idle; })) return Stuck;
    rig_.comes(person, TurningPerson(kind, seed));
    stages_.left = stages_.right = false;
    sides_ = 0;
    appliance_.expect(firmware::named("Ada"));
    appliance_.ask(ui::Intent::Pose);
    const bool over = until([&] {
      const ui::LiveView live = appliance_.live().newest();
      const auto& turn = live.turn;
      rig_.say(turn ? std::optional(turn->advice) : std::nullopt);
      const State state = appliance_.state();
      if (state == State::Position && live.number > 0 && live.advice == pipeline::Advice::None)
        appliance_.ask(ui::Intent::Begin);
      if (state == State::Review && kind != Kind::Leaves) appliance_.ask(ui::Intent::Accept);
      if (state == State::Review) rig_.time.advance(std::chrono::seconds(1));
      return state == State::Idle;
    });
    return !over ? Stuck : sides_ == 2 ? Both : sides_ == 1 ? One : None;
  }

 private:
  // Not within ten minutes, on its own clock or the machine's: never.
  template <typename Reached>
  bool until(const Reached& reached) {
    constexpr std::chrono::minutes kNever{10};
    const auto begun = std::chrono::steady_clock::now();
    const hal::Instant began = rig_.time.now();
    while (!reached()) {
      if (std::chrono::steady_clock::now() - begun > kNever || rig_.time.now() - began > kNever) return false;
      appliance_.step(std::chrono::milliseconds(1));
    }
    return true;
  }

  TurningRig rig_;
  firmware::LiveJudge judge_;
  NotingStages stages_;
  firmware::BootMemory memory_;
  ThreadPool pool_{1};
  std::string kept_;
  std::deque<Errc> errors_;
  firmware::TestRecords records_{kept_, errors_};
  int sides_ = 0;
  firmware::Appliance appliance_;
};

}  // namespace

bool turning_visits(int visits, int first_number) {
  TurningPictures pictures;
  std::array<std::array<int, Outcomes>, kNames.size()> ends{};
  std::mutex told;
  int served = 0;
  std::atomic<int> next{first_number};
  const auto serve = [&] {
    auto judge = firmware::LiveJudge::open(pictures.calibration());
    if (!judge) return;  // then a visit is missing
    auto kiosk = std::make_unique<Kiosk>(pictures, std::move(*judge));
    for (int number = next++; number < first_number + visits; number = next++) {
      const auto n = std::uint32_t(number);
      const auto kind = Kind(n % kKinds);
      const Outcome end = kiosk->visit(kFirstPerson + 2 * (n / kKinds % kPeople), kind, n);
      const std::lock_guard lock(told);
      ++ends[std::size_t(kind)][end];
      if (end == Stuck || (end != Both && TurningPerson::is_willing(kind)))
        std::printf("visit %d (%s): %s\n", number, kNames[std::size_t(kind)],
                    end == Stuck ? "stuck"
                    : end == One ? "one side"
                                 : "no side");
      if (++served % 100 == 0) std::printf("%d visits\n", served);
      std::fflush(stdout);
      if (end == Stuck)
        kiosk = std::make_unique<Kiosk>(pictures, *firmware::LiveJudge::open(pictures.calibration()));
    }
  };
  {
    std::vector<std::jthread> kiosks;
    for (int k = 0; k < std::min(kKiosks, visits); ++k) kiosks.emplace_back(serve);
  }
  int all = 0, stuck = 0, willing = 0, both = 0;
  std::puts("| person | visits | both sides | one | none | stuck |\n| --- | --- | --- | --- | --- | --- |");
  for (std::size_t k = 0; k < kNames.size(); ++k) {
    const auto& e = ends[k];
    const int sum = e[Both] + e[One] + e[None] + e[Stuck];
    std::printf("| %s | %d | %d | %d | %d | %d |\n", kNames[k], sum, e[Both], e[One], e[None], e[Stuck]);
    all += sum, stuck += e[Stuck];
    if (TurningPerson::is_willing(Kind(k))) willing += sum, both += e[Both];
  }
  std::printf("%d visits, %d stuck; %d of %d willing ended with both sides\n", all, stuck, both, willing);
  return all == visits && stuck == 0 && both >= 0.95 * willing;
}

}  // namespace relievo::test
