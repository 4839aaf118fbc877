// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How the gate does on simulated people its limits were not set with: for every kind of advice how often it
// is given when its fault is there (hit) and when it is not (false alarm), and whole visits (gate_visits.h).
//   gate_proof PEOPLE CASES VISITS [FIRST_SEED] [ALBUM] [CASE]
// PEOPLE are drawn from FIRST_SEED (21) on; each is photographed in two ways a fault, once (kept in the
// folder ALBUM, when named); CASES a fault and person differ in exposure and noise, and in how strong the
// fault is where developing makes it. Everything is drawn from the person's own seed: ten runs of one person
// each add up to one run of ten. CASE, a name of the table, leaves out all other rows.
#include <array>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

#include "tests/bench/gate/gate_visits.h"

namespace relievo::bench {
namespace {

using hal::sim::Random;
using pipeline::Advice;

constexpr pipeline::GateTime kFrame = std::chrono::milliseconds(66);

// What is said of the second picture of a case; a moving person stands elsewhere in every picture.
Advice case_of(GateTrial& trial, const Fault& fault, std::uint32_t person, int variant, Random& random) {
  pipeline::GateHistory history;
  test::Developing how = GateTrial::developing(fault.expected, person, random);
  pipeline::GateAnswer answer;
  for (int i = 0; i < 2; ++i) {
    how.noise_seed += 1;
    answer = trial.look(
        trial.shot(fault, person, fault.expected == Advice::Moved ? (i + variant) % kVariants : variant), how,
        (i + 1) * kFrame, history);
  }
  return answer.reason;
}

const char* name_of(Advice advice) {
  for (const Fault& fault : kFaults)
    if (fault.expected == advice) return fault.name;
  return "other";
}

void print_table(GateTrial& trial, std::uint32_t first, int people, int cases, const std::string& only) {
  std::array<std::array<int, 32>, kFaults.size()> given{};
  for (int k = 0; k < people; ++k) {
    const std::uint32_t person = first + 2 * static_cast<std::uint32_t>(k);
    Random random(Random(person).next());
    for (std::size_t f = 0; f < kFaults.size(); ++f)
      for (int i = 0; i < cases && (only.empty() || only == kFaults[f].name); ++i)
        ++given[f][static_cast<std::size_t>(case_of(trial, kFaults[f], person, i % kVariants, random))];
  }
  std::printf(
      "| case | cases | hit | taken as good | the advice where there is no such fault | else said |\n| --- | --- | --- | --- | --- | --- |\n");
  for (std::size_t f = 0; f < kFaults.size(); ++f) {
    if (!only.empty() && only != kFaults[f].name) continue;
    const auto own = static_cast<std::size_t>(kFaults[f].expected);
    int elsewhere = 0, others = 0;
    for (std::size_t g = 0; g < kFaults.size(); ++g)
      if (only.empty() && kFaults[g].expected != kFaults[f].expected)
        elsewhere += given[g][own], others += people * cases;
    std::printf("| %s | %d | %d | %d | %d of %d |", kFaults[f].name, people * cases, given[f][own],
                given[f][0], elsewhere, others);
    for (std::size_t a = 1; a < given[f].size(); ++a)
      if (given[f][a] > 0 && a != own) std::printf(" %s %d", name_of(static_cast<Advice>(a)), given[f][a]);
    std::printf(" |\n");
  }
  std::fflush(stdout);
}

void print_visits(GateTrial& trial, std::uint32_t first, int people, int visits) {
  int behaved = 0, in_time = 0, others_right = 0, others_in_time = 0, nearly = 0;
  pipeline::GateTime longest{};
  std::map<std::string, int> with_fault;
  for (int i = 0; i < visits; ++i) {
    const std::uint32_t person = first + 2 * static_cast<std::uint32_t>(i % people);
    const VisitEnd end = run_visit(
        trial, person, 1000 * static_cast<std::uint64_t>(person) + static_cast<std::uint64_t>(i / people));
    behaved += end.well_behaved;
    in_time += end.well_behaved && end.captured;
    others_right += !end.well_behaved && end.stood_right;
    others_in_time += !end.well_behaved && end.captured;
    nearly += end.nearly;
    if (end.with_fault != nullptr) ++with_fault[end.with_fault];
    if (end.captured) longest = std::max(longest, end.after);
  }
  const auto seconds = [](pipeline::GateTime t) { return std::chrono::duration<double>(t).count(); };
  int wrong = 0;
  for (const auto& [name, n] : with_fault) wrong += n;
  std::printf(
      "%d visits: %d well-behaved, %d of them captured within %.0f s of standing right; of %d others who stood right in the end %d; the slowest after %.1f s\n",
      visits, behaved, in_time, seconds(kAllowed), others_right, others_in_time, seconds(longest));
  std::printf("captured with a fault: %d; without a reason for %.1f s while a fault was there: %d\n", wrong,
              seconds(kNearly), nearly);
  for (const auto& [name, n] : with_fault) std::printf("  %s %d\n", name.c_str(), n);
}

int run(int argc, char** argv) {
  if (argc < 4) {
    std::fprintf(stderr, "usage: gate_proof PEOPLE CASES VISITS [FIRST_SEED] [ALBUM] [CASE]\n");
    return 2;
  }
  const int people = std::max(1, std::atoi(argv[1])), cases = std::atoi(argv[2]), visits = std::atoi(argv[3]);
  const auto first = static_cast<std::uint32_t>(argc > 4 ? std::atoi(argv[4]) : 21);
  GateTrial trial(argc > 5 ? argv[5] : "");
  if (cases > 0) print_table(trial, first, people, cases, argc > 6 ? argv[6] : "");
  if (visits > 0) print_visits(trial, first, people, visits);
  return 0;
}

}  // namespace
}  // namespace relievo::bench

int main(int argc, char** argv) { return relievo::bench::run(argc, argv); }
