// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/sim/base/noise.h"

#include <array>
#include <bit>
#include <cstdio>

namespace relievo::hal::sim {

std::uint64_t Random::next() {
  std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ULL);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

double Random::uniform() { return double(next() >> 11) * 0x1.0p-53; }

double Random::normal() {
  const double u = 1.0 - uniform();
  return std::sqrt(-2.0 * std::log(u)) * std::cos(6.283185307179586 * uniform());
}

double Random::normal_within(double limit) {
  for (;;)
    if (const double value = normal(); std::abs(value) <= limit) return value;
}

std::uint32_t hash_cell(int x, int y, int z, std::uint32_t seed) {
  std::uint32_t h = seed * 0x9e3779b1U ^ std::uint32_t(x) * 0x85ebca77U ^ std::uint32_t(y) * 0xc2b2ae3dU ^
                    std::uint32_t(z) * 0x27d4eb2fU;
  h = (h ^ (h >> 15)) * 0x2c1b3c6dU;
  h = (h ^ (h >> 12)) * 0x297a2d39U;
  return h ^ (h >> 15);
}

double unit_from_hash(std::uint32_t hash) { return (hash >> 8) * 0x1.0p-24; }

std::string name_of_numbers(std::span<const double> numbers) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const double number : numbers)
    for (const std::uint8_t byte : std::bit_cast<std::array<std::uint8_t, sizeof number>>(number))
      hash = (hash ^ byte) * 1099511628211ULL;
  std::array<char, 17> name{};
  std::snprintf(name.data(), name.size(), "%016llx", static_cast<unsigned long long>(hash));
  return name.data();
}

double value_noise(Vec3 p, std::uint32_t seed) {
  const double fx = std::floor(p.x), fy = std::floor(p.y), fz = std::floor(p.z);
  const int x = int(fx), y = int(fy), z = int(fz);
  const auto fade = [](double t) { return t * t * t * (t * (t * 6 - 15) + 10); };
  const double u = fade(p.x - fx), v = fade(p.y - fy), w = fade(p.z - fz);
  const auto at = [&](int i, int j, int k) { return unit_from_hash(hash_cell(x + i, y + j, z + k, seed)); };
  const double near = mix(mix(at(0, 0, 0), at(1, 0, 0), u), mix(at(0, 1, 0), at(1, 1, 0), u), v);
  const double far = mix(mix(at(0, 0, 1), at(1, 0, 1), u), mix(at(0, 1, 1), at(1, 1, 1), u), v);
  return 2 * mix(near, far, w) - 1;
}

double fractal_noise(Vec3 p, std::uint32_t seed, int octaves) {
  double sum = 0, weight = 1;
  for (int i = 0; i < octaves; ++i, weight *= 0.5, p = p * 2.03)
    sum += weight * value_noise(p, seed + std::uint32_t(i));
  return sum;
}

NearestDot nearest_dot(Vec3 p, std::uint32_t seed) {
  const int x = int(std::floor(p.x - 0.5)), y = int(std::floor(p.y - 0.5));
  const int z = int(std::floor(p.z - 0.5));
  NearestDot best{9, 0};
  for (int c = 0; c < 8; ++c) {
    const int i = x + (c & 1), j = y + ((c >> 1) & 1), k = z + (c >> 2);
    const std::uint32_t h = hash_cell(i, j, k, seed);
    // Ten bits an axis place the dot inside its cell.
    const Vec3 dot_at{i + (h & 1023) / 1024.0, j + ((h >> 10) & 1023) / 1024.0,
                      k + ((h >> 20) & 1023) / 1024.0};
    const Vec3 d = dot_at - p;
    const double squared = dot(d, d);
    if (squared < best.distance) best = {squared, h};
  }
  best.distance = std::sqrt(best.distance);
  return best;
}

}  // namespace relievo::hal::sim
