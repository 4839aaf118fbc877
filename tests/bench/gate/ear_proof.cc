// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How many of simulated visitors who see nothing come from a wrong pose to their picture by what they hear
// (tests/firmware/kiosk/ear_visit.h). Failures, and a visit alone, are printed with
// their pose and all that was said.
//   ear_proof VISITS [FIRST_SEED]
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "tests/firmware/kiosk/ear_visit.h"

int main(int argc, char** argv) {
  using namespace relievo::test;
  const int visits = argc > 1 ? std::max(1, std::atoi(argv[1])) : 100;
  const auto first = static_cast<std::uint32_t>(argc > 2 ? std::atoi(argv[2]) : 1000);
  Album album;
  GateFixture gate;
  std::vector<double> seconds;
  for (int i = 0; i < visits; ++i) {
    const std::uint32_t seed = first + static_cast<std::uint32_t>(i);
    const EarVisit visit = visit_by_ear(seed, album, gate);
    if (visit.captured) seconds.push_back(visit.seconds);
    if (!visit.captured || visits == 1)
      std::printf("visit %u %s: from %s to %s\n%s", seed, visit.captured ? "captured" : "failed",
                  print(visit.first).c_str(), print(visit.last).c_str(), visit.heard.c_str());
    std::printf("%zu of %d\n", seconds.size(), i + 1);
    std::fflush(stdout);
  }
  std::sort(seconds.begin(), seconds.end());
  if (!seconds.empty())
    std::printf("captured after %.1f s in the median, %.1f s at most\n", seconds[seconds.size() / 2],
                seconds.back());
  return static_cast<double>(seconds.size()) >= 0.95 * visits ? 0 : 1;
}
