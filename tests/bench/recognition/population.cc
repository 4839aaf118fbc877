// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/recognition/population.h"

#include <array>
#include <cstdio>
#include <random>

namespace relievo::bench {
namespace {

constexpr std::uint32_t kFirstOwn = 1001, kFirstOther = 2001;  // seeds that no other test or set uses
constexpr std::array<double, kProbes> kYaw{-30, -18, 8, 18, 30};

// mt19937's numbers are the same everywhere; the library's distributions are not.
class Draw {
 public:
  explicit Draw(std::uint32_t seed) : engine_(seed) {}
  double between(double least, double most) {
    return least + (most - least) * static_cast<double>(engine_()) / 4294967295.0;
  }
  bool chance(double share) { return between(0, 1) < share; }

 private:
  std::mt19937 engine_;
};

// Each person has one way to smile and squint, so that two heads a person are enough to make.
void take_expression(Visit& v, std::uint32_t seed) {
  Draw draw(seed * 64 + 63);
  v.smile = draw.between(0.3, 1);
  v.squint = draw.between(0, 1);
}

Visit visit(const Person& person, std::uint32_t seed, int number) {
  Draw draw(seed * 64 + static_cast<std::uint32_t>(number));
  Visit v;
  v.name = person.name + (number == 0 ? "_enrol" : "_p" + std::to_string(number));
  v.maker = person.maker;
  v.person_seed = seed;
  v.visit_seed = seed * 16 + static_cast<std::uint32_t>(number);
  if (number == 0) return v;
  const double yaw = kYaw[static_cast<std::size_t>(number - 1)];
  v.yaw_deg = yaw == 30 || yaw == -30 ? yaw : yaw + draw.between(-5, 5);
  v.pitch_deg = draw.between(-8, 8);
  v.roll_deg = draw.between(-4, 4);
  v.distance_mm = draw.between(535, 585);
  v.noise = draw.between(0.8, 1.6);
  v.right_gain = draw.between(-0.12, 0.12);
  v.light_left = draw.between(0.4, 1.3);
  v.light_right = draw.between(0.6, 2.2);
  v.light_below = draw.between(0, 3);
  if (draw.chance(0.6)) take_expression(v, seed);
  return v;
}

}  // namespace

std::vector<Person> make_population(int own, int other) {
  std::vector<Person> people;
  for (int i = 0; i < own + other; ++i) {
    Person person;
    person.maker = i < own ? Maker::Own : Maker::Other;
    const int number = i < own ? i : i - own;
    char name[32];
    std::snprintf(name, sizeof name, "%s%03d", i < own ? "own" : "other", number + 1);
    person.name = name;
    const std::uint32_t seed = (i < own ? kFirstOwn : kFirstOther) + static_cast<std::uint32_t>(number);
    person.enrolment = visit(person, seed, 0);
    for (int p = 1; p <= kProbes; ++p) person.probes.push_back(visit(person, seed, p));
    people.push_back(std::move(person));
  }
  return people;
}

}  // namespace relievo::bench
