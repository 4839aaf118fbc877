// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/gate/gate_visits.h"

#include <vector>

namespace relievo::bench {
namespace {

using hal::sim::Random;
using pipeline::Advice;

struct Phase {
  const Fault* fault = &kFaults[0];
  int looks = 1;
};

int between(Random& random, int least, int most) {
  return least + static_cast<int>(random.uniform(0, most - least + 0.999));
}
const Fault& named(Advice advice) {
  for (const Fault& fault : kFaults)
    if (fault.expected == advice) return fault;
  return kFaults[0];
}

std::vector<Phase> well_behaved(Random& random) {
  std::vector<Phase> script{{&named(Advice::NoFace), 1}, {&named(Advice::TooFar), between(random, 1, 2)}};
  if (random.uniform() < 0.35) script.push_back({&named(Advice::TooClose), between(random, 1, 2)});
  if (random.uniform() < 0.35) script.push_back({&named(Advice::OffCentre), between(random, 1, 2)});
  return script;
}

std::vector<Phase> misbehaved(Random& random) {
  std::vector<Phase> script{{&named(Advice::NoFace), 1}};
  for (int faults = between(random, 1, 4); faults > 0; --faults) {
    script.push_back(
        {&kFaults[static_cast<std::size_t>(between(random, 2, kFaultsOfVisits - 1))], between(random, 2, 5)});
    if (random.uniform() < 0.25) script.push_back({&kFaults[0], between(random, 1, 3)});
  }
  return script;
}

struct Visit {
  GateTrial& trial;
  std::uint32_t person;
  Random random;
  pipeline::GateHistory history;
  pipeline::GateTime now{};

  // One look at somebody who stands the same way as in the look before, but for who moves.
  pipeline::GateAnswer look(const Fault& fault, int variant, test::Developing& how) {
    now += kVisitFrame;
    how.noise_seed = random.next() >> 2;
    return trial.look(trial.shot(fault, person, variant), how, now, history);
  }
  VisitEnd run();
};

VisitEnd Visit::run() {
  VisitEnd end;
  end.well_behaved = random.uniform() < 0.6;
  const std::vector<Phase> script = end.well_behaved ? well_behaved(random) : misbehaved(random);
  for (const Phase& phase : script) {
    int variant = between(random, 0, kVariants - 1);
    test::Developing how = GateTrial::developing(phase.fault->expected, person, random);
    for (int i = 0; i < phase.looks; ++i) {
      if (phase.fault->expected == Advice::Moved) variant = 1 - variant;
      const pipeline::GateAnswer answer = look(*phase.fault, variant, how);
      if (phase.fault->expected == Advice::None || answer.reason != Advice::None) continue;
      if (answer.steady >= kNearly) end.nearly = true;
      if (answer.steady >= kHeld) return end.with_fault = phase.fault->name, end;
    }
  }
  end.stood_right = end.well_behaved || random.uniform() < 0.5;
  if (!end.stood_right) return end;
  const int variant = between(random, 0, kVariants - 1);
  test::Developing how = GateTrial::developing(Advice::None, person, random);
  for (const pipeline::GateTime from = now + kVisitFrame; now - from < kAllowed;) {
    const pipeline::GateAnswer answer = look(kFaults[0], variant, how);
    if (answer.reason != Advice::None || answer.steady < kHeld) continue;
    end.captured = true;
    end.after = now - from;
    return end;
  }
  return end;
}

}  // namespace

VisitEnd run_visit(GateTrial& trial, std::uint32_t person, std::uint64_t seed) {
  return Visit{trial, person, Random(Random(seed).next()), {}, {}}.run();
}

}  // namespace relievo::bench
