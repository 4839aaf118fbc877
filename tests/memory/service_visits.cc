// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Visits on end on the small simulated rig, without a screen, so that the GL driver's memory is not in it:
// what each asks of the system once all is warm. Prints a line a visit; fails where memory grows.
//
//   service_visits VISITS
//
// toolchain/service_proof runs it under strace, which counts the calls: the lines are its marks.
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "firmware/base/steady_heap.h"
#include "tests/memory/usage.h"
#include "tests/memory/visitor.h"
#include "tests/support/temporary_folder.h"

namespace relievo::test {
namespace {

constexpr int kWarm = 3;           // visits until everything has been used once
constexpr double kMayGrow = 1.01;  // of what is resident, from then to the end

int serve(int visits) {
  firmware::share_one_heap();
  const TemporaryFolder folder;
  auto visitor = Visitor::at(folder.path() / "store");
  firmware::keep_heap_steady();
  if (!visitor) return std::puts("the kiosk does not open"), 1;
  int failed = 0;
  Usage warm, before = Usage::now();
  std::vector<double> resident;
  for (int number = 1; number <= visits; ++number) {
    const VisitEnd end = (*visitor)->visit();
    if (!end.stored) ++failed;
    const Usage now = Usage::now();
    std::printf("visit %d: %s, %ld minor and %ld major faults, %.1f MiB resident, %.1f MiB in use\n", number,
                end.stored ? "stored" : "not stored", now.minor - before.minor, now.major - before.major,
                now.resident_mib, now.in_use_mib);
    std::fflush(stdout);
    before = now;
    if (number == kWarm) warm = now;
  }
  const double growth = before.resident_mib / warm.resident_mib;
  std::printf(
      "after warm-up: %ld minor and %ld major faults in %d visits, resident memory x %.4f; %d not stored\n",
      before.minor - warm.minor, before.major - warm.major, visits - kWarm, growth, failed);
  std::fflush(stdout);  // strace's mark: what comes is the end
  return failed == 0 && growth <= kMayGrow ? 0 : 1;
}

}  // namespace
}  // namespace relievo::test

int main(int argc, char** argv) {
  const int visits = argc > 1 ? std::atoi(argv[1]) : 0;
  if (visits < 5) return std::puts("service_visits VISITS   (5 at least)"), 2;
  return relievo::test::serve(visits);
}
