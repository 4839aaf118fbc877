// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The sensor: its noise is as large as its electrons say, and every frame's is its own.
#include "hal/sim/optics/exposure.h"

#include <gtest/gtest.h>

#include <cmath>

namespace relievo::hal::sim {
namespace {

LightPicture flat(float light) {
  LightPicture picture{160, 100, {}};
  picture.rgb.assign(160 * 100 * 3, light);
  return picture;
}

SensorOptions linear() {
  SensorOptions o;
  o.gamma = false;
  return o;
}

std::vector<double> noise_of(std::uint64_t seed) {
  const Picture picture = read_sensor(flat(0.5F), linear(), seed);
  std::vector<double> noise;
  for (const std::byte b : picture.bytes) noise.push_back(static_cast<double>(b) - 127.5);
  return noise;
}

TEST(Sensor, CountsElectrons) {
  const std::vector<double> noise = noise_of(5);
  double sum = 0, squares = 0;
  for (const double v : noise) sum += v, squares += v * v;
  const auto n = static_cast<double>(noise.size());
  const double expected =
      255 * std::sqrt(4500.0 + 81) / 9000;  // root of the electrons, and the reading's own
  EXPECT_NEAR(sum / n, 0, 0.05);
  EXPECT_NEAR(std::sqrt(squares / n - sum / n * sum / n), expected, 0.05);
}

TEST(Sensor, NoFramesNoiseIsAnothersMovedAlong) {
  const std::vector<double> a = noise_of(1000);
  for (const std::uint64_t seed : {1001U, 1002U, 1003U, 2000U}) {
    const std::vector<double> b = noise_of(seed);
    for (std::ptrdiff_t shift = -6; shift <= 6; ++shift) {
      double both = 0, own = 0;
      for (std::size_t i = 6; i + 6 < a.size(); ++i) {
        both += a[i] * b[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(i) + shift)];
        own += a[i] * a[i];
      }
      EXPECT_LT(std::abs(both / own), 0.03) << seed << " " << shift;
    }
  }
}

TEST(Sensor, TheSameSeedIsTheSameFrame) { EXPECT_EQ(noise_of(3), noise_of(3)); }

}  // namespace
}  // namespace relievo::hal::sim
