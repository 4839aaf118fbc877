// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Visits on end on the small simulated rig, without a screen, so that the GL driver's memory is not in it:
// several people, who accept, turn the head, try again, decline, leave, or meet a camera that is pulled out,
// and staff in between. What each asks of the system once every kind has been there twice. Prints a line a
// visit; fails where memory grows or the heap's largest free block shrinks.
//
//   service_visits VISITS
//
// toolchain/service_proof runs it under strace, which counts the calls: the lines are its marks.
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>

#include "firmware/base/budget.h"
#include "firmware/base/process_memory.h"
#include "tests/memory/usage.h"
#include "tests/memory/visitor.h"
#include "tests/support/temporary_folder.h"

namespace relievo::test {
namespace {

constexpr int kKinds = int(Manner::Count);
constexpr int kTurning = 20;  // of so many visitors one turns the head, which takes as long as ten others
constexpr int kRound = 35;    // visits from one round of the staff to the next
constexpr int kWarm = 80;     // until everything has been used several times, or half of them
constexpr double kMayGrow = 1.01, kMayGrowYet = 1.03;  // of what is resident, from then to the end
constexpr double kMayShrink = 0.95;                    // of the largest free block

int serve(int visits) {
  if (!firmware::take_heap(firmware::budget::kHeapBytes)) return std::puts("no heap"), 1;
  const TemporaryFolder folder;
  const std::size_t people = visits < kTurning / 2 ? 2 : People::kMany;  // in a short run nobody turns
  auto visitor = Visitor::at(folder.path() / "store", people);
  if (!firmware::bound_memory(firmware::budget::kDriverBytes)) return std::puts("no bound"), 1;
  if (!visitor) return std::puts("the kiosk does not open"), 1;
  if (!(*visitor)->first_start()) return std::puts("the first start does not end"), 1;
  std::array<int, kKinds> came{}, stored{};
  const int warmed = std::min(kWarm, visits / 2);
  int wrong = 0;
  double free_then = 0;
  Usage warm, before = Usage::now();
  for (int number = 1; number <= visits; ++number) {
    const int kind = number % kTurning == kTurning / 2 ? int(Manner::Turns) : number % (kKinds - 1);
    const auto manner = Manner(kind);
    const VisitEnd end =
        (*visitor)->visit(manner == Manner::Turns ? 0 : std::size_t(number) % people, manner);
    ++came[std::size_t(kind)], stored[std::size_t(kind)] += end.stored;
    const bool keeps = manner != Manner::Declines && manner != Manner::Leaves && manner != Manner::Unlucky;
    if (end.stuck || end.stored != keeps || end.apologised != (manner == Manner::Unlucky)) ++wrong;
    if (number % kRound == 0 && !(*visitor)->staff_round())
      return std::puts("the staff's round does not end"), 1;
    if (number == warmed) free_then = Usage::largest_free_mib();
    const Usage now = Usage::now();
    std::printf("visit %d: %s%s%s, %ld minor and %ld major faults, %.1f MiB resident, %.1f MiB in use\n",
                number, name_of(manner), end.stored ? ", stored" : "", end.apologised ? ", apologised" : "",
                now.minor - before.minor, now.major - before.major, now.resident_mib, now.in_use_mib);
    std::fflush(stdout);
    before = now;
    if (number == warmed) {
      warm = now;
      std::puts("warm");  // strace's marks: this one, and the end
      std::fflush(stdout);
    }
  }
  const double growth = before.resident_mib / warm.resident_mib;
  std::printf("after warm-up: %ld minor and %ld major faults in %d visits, resident memory x %.4f\n",
              before.minor - warm.minor, before.major - warm.major, visits - warmed, growth);
  std::fflush(stdout);
  const double free_now = Usage::largest_free_mib();
  std::printf("largest free block %.1f MiB, then %.1f MiB\n", free_then, free_now);
  for (int kind = 0; kind < kKinds; ++kind)
    std::printf("%6d %s, %d stored\n", came[std::size_t(kind)], name_of(Manner(kind)),
                stored[std::size_t(kind)]);
  std::printf("%d ended as they should not\n", wrong);
  return wrong == 0 && growth <= (warmed == kWarm ? kMayGrow : kMayGrowYet) &&
                 free_now >= kMayShrink * free_then
             ? 0
             : 1;
}

}  // namespace
}  // namespace relievo::test

int main(int argc, char** argv) {
  const int visits = argc > 1 ? std::atoi(argv[1]) : 0;
  if (visits < 2) return std::puts("service_visits VISITS"), 2;
  return relievo::test::serve(visits);
}
