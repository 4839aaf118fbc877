// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How the gate does on simulated people its limits were not set with: for every kind of advice how often it is given when its
// fault is there (hit) and when it is not (false alarm), and whole visits.
//   gate_proof PEOPLE CASES VISITS [FIRST_SEED] [ALBUM]
// PEOPLE are drawn from FIRST_SEED (21) on; each is photographed in a few ways, once (kept in the folder ALBUM, when named);
// CASES a fault and person differ in exposure and noise, and in how strong the fault is where developing makes it. A visit: nobody,
// two faults, then standing right; captured when three pictures in a row have no reason.
#include <array>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>

#include "hal/sim/noise.h"
#include "pipeline/gate/capture_gate.h"
#include "pipeline/workspace.h"
#include "tests/support/head_album.h"

namespace relievo::bench {
namespace {

using pipeline::Advice;
using pipeline::GateAnswer;
using pipeline::GateTime;
using hal::sim::Random;
using test::Album;
using test::Developing;
using test::Extra;
using test::Shot;
using test::standing;

constexpr GateTime kFrame = std::chrono::milliseconds(66);
constexpr int kSteady = 3;

struct Fault {
  const char* name;
  Advice expected;
};
constexpr std::array kFaults{Fault{"none", Advice::None}, Fault{"nobody", Advice::NoFace}, Fault{"friend", Advice::MoreThanOneFace},
                             Fault{"too near", Advice::TooClose}, Fault{"too far", Advice::TooFar}, Fault{"off centre", Advice::OffCentre},
                             Fault{"turned", Advice::TurnedAside}, Fault{"bowed", Advice::LooksUpOrDown}, Fault{"tilted", Advice::Tilted},
                             Fault{"moving", Advice::Moved}, Fault{"dark", Advice::TooDark}, Fault{"bright", Advice::TooBright},
                             Fault{"one lamp", Advice::UnevenLight}, Fault{"blurred", Advice::Blurred}, Fault{"hand", Advice::FaceHidden}};

struct Proof {
  Album album;
  pipeline::Workspace work{2, std::size_t{8} << 20, std::size_t{64} << 20};
  std::optional<pipeline::CaptureGate> gate;

  explicit Proof(const char* folder) : album(folder) {
    pipeline::CaptureGateOptions options;
    options.relief.reduction = 1;
    auto made = pipeline::CaptureGate::open(options);
    if (!made) fail(made.error());
    gate.emplace(*std::move(made));
  }
  [[noreturn]] static void fail(const Error& error) {
    std::fprintf(stderr, "gate_proof: %s\n", std::string(error.what.view()).c_str());
    std::exit(1);
  }

  // Few places a person, so that few photographs serve many cases.
  const Shot& shot(Advice fault, std::uint32_t seed, bool other) {
    const double side = other ? -1 : 1;
    switch (fault) {
      case Advice::NoFace: return album.shoot(0, {0, 0, 0, 0, 0, 0});
      case Advice::MoreThanOneFace: return album.shoot(seed, standing(560, -40), Extra::Friend);
      case Advice::TooClose: return album.shoot(seed, standing(400));
      case Advice::TooFar: return album.shoot(seed, standing(760, 20, 10, 5, 5, -8));
      case Advice::OffCentre: return album.shoot(seed, standing(560, 85));
      case Advice::TurnedAside: return album.shoot(seed, standing(560, 0, 0, 25));
      case Advice::LooksUpOrDown: return album.shoot(seed, standing(560, 0, 0, 0, side * 20));
      case Advice::Tilted: return album.shoot(seed, standing(560, 0, 0, 0, 0, 20));
      case Advice::FaceHidden: return album.shoot(seed, standing(560), Extra::HandBefore);
      case Advice::None: case Advice::Moved: case Advice::TooDark: case Advice::TooBright: case Advice::UnevenLight: case Advice::Highlights:
      case Advice::Blurred: case Advice::EyesHidden: case Advice::EyesClosed: case Advice::GlassesGlare: case Advice::MouthOpen: case Advice::Background: break;
    }
    return other ? album.shoot(seed, standing(600, -12, 8, -4, 3, 3)) : album.shoot(seed, standing(560));
  }
  static Developing developing(Advice fault, Random& random) {
    Developing how;
    how.exposure = random.uniform(0.75, 1.4);
    how.noise_seed = random.next() >> 2;
    if (fault == Advice::TooDark) how.exposure = random.uniform(0.01, 0.07);
    if (fault == Advice::TooBright) how.exposure = random.uniform(5, 12);
    if (fault == Advice::UnevenLight) how.one_sided = random.uniform(0.0, 0.05);
    if (fault == Advice::Blurred) how.defocus_px = random.uniform(2, 4);
    return how;
  }
  GateAnswer look(const Shot& s, const Developing& how, GateTime now, pipeline::GateHistory& history) {
    const auto pair = album.develop(s, how);
    work.output.reset();
    auto made = pipeline::run_stage(work.context, [&](auto& c) { return gate->look({pair.left.view(), pair.right.view()}, album.calibration(), now, history, c); });
    if (!made) fail(made.error());
    return made->answer;
  }
};

// What is said of the second picture of a case; a moving person stands elsewhere in every picture.
Advice case_of(Proof& proof, Advice fault, std::uint32_t seed, Random& random) {
  pipeline::GateHistory history;
  const bool other = random.uniform() < 0.5;
  Developing how = Proof::developing(fault, random);
  GateAnswer answer;
  for (int i = 0; i < 2; ++i) {
    how.noise_seed += 1;
    answer = proof.look(proof.shot(fault, seed, fault == Advice::Moved ? i == 0 : other), how, (i + 1) * kFrame, history);
  }
  return answer.reason;
}

void print_table(Proof& proof, std::uint32_t first, int people, int cases) {
  std::array<std::array<int, 32>, kFaults.size()> given{};
  Random random(first);
  for (int person = 0; person < people; ++person)
    for (std::size_t f = 0; f < kFaults.size(); ++f)
      for (int i = 0; i < cases; ++i) ++given[f][static_cast<std::size_t>(case_of(proof, kFaults[f].expected, first + 2 * static_cast<std::uint32_t>(person), random))];
  std::printf("| case | cases | hit | taken as good | the advice where there is no such fault |\n| --- | --- | --- | --- | --- |\n");
  for (std::size_t f = 0; f < kFaults.size(); ++f) {
    const auto own = static_cast<std::size_t>(kFaults[f].expected);
    int elsewhere = 0;
    for (std::size_t g = 0; g < kFaults.size(); ++g) elsewhere += g == f ? 0 : given[g][own];
    std::printf("| %s | %d | %d | %d | %d of %d |\n", kFaults[f].name, people * cases, given[f][own], given[f][0], elsewhere, people * cases * static_cast<int>(kFaults.size() - 1));
  }
}

// Pictures until the capture, from standing right on; 0: taken before that; -1: never.
int visit(Proof& proof, std::uint32_t seed, Random& random) {
  pipeline::GateHistory history;
  GateTime now{};
  int good = 0;
  const auto step = [&](Advice fault) {
    const bool other = fault == Advice::None ? false : random.uniform() < 0.5;
    now += kFrame;
    const GateAnswer answer = proof.look(proof.shot(fault, seed, other), Proof::developing(fault, random), now, history);
    good = answer.reason == Advice::None ? good + 1 : 0;
    return good >= kSteady;
  };
  const auto any = [&] { return kFaults[2 + static_cast<std::size_t>(random.uniform(0, kFaults.size() - 2.001))].expected; };
  const Advice a = any(), b = any();
  for (const Advice fault : {Advice::NoFace, a, a, a, b, b, b})
    if (step(fault)) return 0;
  for (int i = 1; i <= 30; ++i)  // two seconds
    if (step(Advice::None)) return i;
  return -1;
}

int run(int argc, char** argv) {
  if (argc < 4) {
    std::fprintf(stderr, "usage: gate_proof PEOPLE CASES VISITS [FIRST_SEED] [ALBUM]\n");
    return 2;
  }
  const int people = std::max(1, std::atoi(argv[1])), cases = std::atoi(argv[2]), visits = std::atoi(argv[3]);
  const auto first = static_cast<std::uint32_t>(argc > 4 ? std::atoi(argv[4]) : 21);
  Proof proof(argc > 5 ? argv[5] : "");
  if (cases > 0) print_table(proof, first, people, cases);
  int early = 0, never = 0, longest = 0;
  for (int i = 0; i < visits; ++i) {
    Random random(1000 * static_cast<std::uint64_t>(first) + static_cast<std::uint64_t>(i));
    const int pictures = visit(proof, first + 2 * static_cast<std::uint32_t>(i % people), random);
    early += pictures == 0 ? 1 : 0;
    never += pictures < 0 ? 1 : 0;
    longest = std::max(longest, pictures);
  }
  if (visits > 0)
    std::printf("%d visits: %d captured while a fault was there, %d not within 2 s of standing right; the slowest after %d pictures (%.2f s)\n", visits, early, never, longest,
                std::chrono::duration<double>(longest * kFrame).count());
  return 0;
}

}  // namespace
}  // namespace relievo::bench

int main(int argc, char** argv) { return relievo::bench::run(argc, argv); }
