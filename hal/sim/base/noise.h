// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Randomness that depends on a seed and a place only: the same head has the same pores everywhere, on every
// machine. Random is a sequence (SplitMix64), the others are fields over space. Thread: any.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "hal/sim/base/vec3.h"

namespace relievo::hal::sim {

class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed * 0x9e3779b97f4a7c15ULL + 0x1234567) {}
  std::uint64_t next();
  double uniform();  // [0, 1)
  double uniform(double from, double to) { return from + (to - from) * uniform(); }
  double normal();                     // mean 0, deviation 1
  double normal_within(double limit);  // the same, redrawn until within +-limit

 private:
  std::uint64_t state_;
};

std::uint32_t hash_cell(int x, int y, int z, std::uint32_t seed);
double unit_from_hash(std::uint32_t hash);  // [0, 1)
// A file's name for what was rendered from these numbers (FNV-1a over their bytes).
std::string name_of_numbers(std::span<const double> numbers);

double value_noise(Vec3 p, std::uint32_t seed);  // about [-1, 1], features of size 1
double fractal_noise(Vec3 p, std::uint32_t seed, int octaves);

struct NearestDot {
  double distance;     // to the nearest of the random dots, one per unit cell
  std::uint32_t hash;  // of that dot
};
// Searches the eight nearest cells only: exact for distances below a half, which is all dots need.
NearestDot nearest_dot(Vec3 p, std::uint32_t seed);

}  // namespace relievo::hal::sim
