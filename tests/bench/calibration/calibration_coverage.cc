// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Is the promised error honest? N simulated rigs (default 600), 6 to 20 views of a board, corner noise
// of 0.02 to 0.3 px: how often the true error lies in the predicted bands. Exit code 1 when a 95 % band
// holds less than 92 % or more than 98 % of the cases.
//   calibration_coverage [N]
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>

#include "tests/pipeline/calibrate/predicted_error.h"

int main(int argc, char** argv) {
  const int rigs = argc > 1 ? std::atoi(argv[1]) : 600;
  relievo::tests::PredictedError error;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> log_noise(std::log(0.02), std::log(0.3));
  std::uniform_int_distribution<int> views(6, 20);
  for (int seed = 1; seed <= rigs; ++seed) {
    const double noise_px = std::exp(log_noise(random));
    const int count = views(random);
    if (!error.add(static_cast<unsigned>(seed), noise_px, count))
      std::printf("rig %d was not calibrated\n", seed);
  }
  bool honest = true;
  std::printf("%-28s %12s %12s %10s\n", "", "one sigma", "95 % band", "cases");
  for (const auto* band : {&error.near, &error.face, &error.far, &error.scale, &error.projection}) {
    std::printf("%-28s %10.1f %% %10.1f %% %10d\n", band->name.c_str(), 100 * band->share_one(),
                100 * band->share_95(), band->cases);
    honest = honest && band->share_95() >= 0.92 && band->share_95() <= 0.98;
  }
  std::printf("%d of %d good views left out\n", error.left_out, error.given);
  return honest ? 0 : 1;
}
