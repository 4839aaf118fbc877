// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How the gate does with eyes, mouth and glasses of simulated people its limits were not set with: for every
// kind how often its advice is given (hit), how often nothing is said (taken as good), and how often its
// advice is given to another kind (false alarm).
//   expression_proof PEOPLE CASES [FIRST_SEED] [ALBUM] [MEASURES]
// Each person is photographed in two places and poses within the gate's limits a kind (kept in the folder
// ALBUM, when named); CASES of each photograph differ in exposure and noise; MEASURES is a file for what was
// measured of every case, a line each. Whether a lamp is mirrored before an eye is known from the geometry of
// lens and lamp.
#include <array>
#include <cstdio>
#include <cstdlib>

#include "hal/sim/base/noise.h"
#include "hal/sim/head/shape/head_field.h"
#include "tests/support/gate_fixture.h"

namespace relievo::bench {
namespace {

using hal::sim::Random;
using pipeline::Advice;
using test::Guise;

enum class Kind : std::uint8_t {
  Rest,
  Glasses,
  Glare,
  DarkGlasses,
  EyesClosed,
  MouthOpen,
  Grin,
  Tongue,
  Smile,
  Count
};
constexpr auto kKinds = static_cast<std::size_t>(Kind::Count);
constexpr std::array<const char*, kKinds> kNames{"at rest",      "glasses",     "a lamp in the glasses",
                                                 "dark glasses", "eyes closed", "mouth open",
                                                 "grin",         "tongue",      "smile, lips closed"};
constexpr std::array<Advice, kKinds> kExpected{Advice::None,       Advice::None,       Advice::GlassesGlare,
                                               Advice::EyesHidden, Advice::EyesClosed, Advice::MouthOpen,
                                               Advice::MouthOpen,  Advice::MouthOpen,  Advice::NotNeutral};
constexpr double kFreeMm2 = 2, kGlareMm2 = 90;  // of mirrored lamp before an eye: none, or enough to matter

Guise guise_of(Kind kind, Random& random) {
  Guise g;
  g.wears_glasses = kind == Kind::Glasses || kind == Kind::Glare || kind == Kind::DarkGlasses;
  if (kind == Kind::DarkGlasses) g.glasses.passes = random.uniform(0.06, 0.15);
  if (kind == Kind::EyesClosed) g.expression.lids_open = random.uniform(0, 0.15);
  if (kind == Kind::MouthOpen) g.expression.jaw_mm = random.uniform(8, 14);
  if (kind == Kind::Grin)
    g.expression.jaw_mm = random.uniform(5.5, 8.5), g.expression.smile = random.uniform(0.7, 1);
  if (kind == Kind::Tongue)
    g.expression.jaw_mm = random.uniform(10, 13), g.expression.tongue_mm = random.uniform(13, 22);
  if (kind == Kind::Smile) g.expression.smile = random.uniform(0.7, 1);
  return g;
}

hal::sim::HeadPose pose_of(Random& random) {
  const double far = random.uniform(480, 640), right = random.uniform(-20, 20),
               down = random.uniform(-15, 15), yaw = random.uniform(-9, 9), pitch = random.uniform(-8, 6);
  return test::standing(far, right, down, yaw, pitch, random.uniform(-6, 6));
}

struct Posed {
  Guise guise;
  hal::sim::HeadPose pose;
};

// Glasses that mirror as the kind asks, as the left camera sees them, in some pose.
void find_glasses(Kind kind, std::uint32_t seed, Posed& posed, Random& random) {
  const hal::sim::HeadField field(hal::sim::traits_of(seed));
  const hal::sim::Vec3 eye = field.eye.centre();
  const hal::sim::Wearer wearer{{eye, {-eye.x, eye.y, eye.z}}, field.eye.radius(), field.traits.head_breadth};
  for (int i = 0; i < 500; ++i) {
    hal::sim::Glasses& g = posed.guise.glasses;
    g.curve_mm = random.uniform(80, 150), g.tilt_deg = random.uniform(0, 9),
    g.half_width_mm = random.uniform(22, 25), g.half_height_mm = random.uniform(14, 18);
    posed.pose = pose_of(random);
    const double mirrored = mirrored_mm2(wearer, posed.pose, g, {0, 0, 0});
    if (kind == Kind::Glare ? mirrored > kGlareMm2 : mirrored < kFreeMm2) return;
  }
}

struct Proof {
  test::Album album;
  test::GateFixture gate;

  pipeline::GateAnswer look(const Posed& posed, std::uint32_t seed, Random& random) {
    const test::Shot& shot = album.shoot(seed, posed.pose, test::Extra::None, posed.guise);
    test::Developing how;
    how.exposure = random.uniform(0.75, 1.4);
    how.noise_seed = random.next() >> 2;
    return gate.first_look(album, shot, how).answer;
  }
};

void print_measures(std::FILE* file, std::uint32_t seed, Kind kind, int place,
                    const pipeline::GateAnswer& answer) {
  const pipeline::GateMeasures& m = answer.measures;
  std::fprintf(file, "%u,\"%s\",%d,%d,%.1f,%.1f,%.1f,%.3f", seed, kNames[static_cast<std::size_t>(kind)],
               place, static_cast<int>(answer.reason), m.head.yaw_deg, m.head.pitch_deg, m.head.roll_deg,
               m.light.side_ratio);
  for (const pipeline::EyeMeasurement& e : m.eyes)
    std::fprintf(file, ",%.3f,%.2f,%.1f,%.1f,%.1f", e.contrast, e.brightness, e.glare_mm2, e.right_mm,
                 e.down_mm);
  std::fprintf(file, ",%.1f,%.2f,%.2f,%.2f\n", m.mouth.dark_mm2, m.mouth.steps_mm, m.mouth.before_mm,
               m.mouth.rise_mm);
}

void print_table(const std::array<std::array<int, 32>, kKinds>& given, int cases) {
  std::printf("| case | cases | hit | taken as good | given to others |\n| --- | --- | --- | --- | --- |\n");
  for (std::size_t k = 0; k < kKinds; ++k) {
    const auto own = static_cast<std::size_t>(kExpected[k]);
    int elsewhere = 0, others = 0;
    for (std::size_t other = 0; other < kKinds; ++other)
      if (kExpected[other] != kExpected[k]) elsewhere += given[other][own], others += cases;
    std::printf("| %s | %d | %d | %d | %d of %d |", kNames[k], cases, given[k][own], given[k][0], elsewhere,
                others);
    for (std::size_t a = 1; a < given[k].size(); ++a)
      if (given[k][a] > 0 && a != own) std::printf(" advice %zu: %d", a, given[k][a]);
    std::printf("\n");
  }
}

int run(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: expression_proof PEOPLE CASES [FIRST_SEED] [ALBUM] [MEASURES]\n");
    return 2;
  }
  const int people = std::max(1, std::atoi(argv[1])), cases = std::max(1, std::atoi(argv[2]));
  const auto first = static_cast<std::uint32_t>(argc > 3 ? std::atoi(argv[3]) : 71);
  Proof proof{test::Album(argc > 4 ? argv[4] : ""), test::GateFixture()};
  std::FILE* measures = argc > 5 ? std::fopen(argv[5], "w") : nullptr;
  if (argc > 5 && measures == nullptr) {
    std::fprintf(stderr, "expression_proof: the file for the measures cannot be written\n");
    return 1;
  }
  std::array<std::array<int, 32>, kKinds> given{};
  for (int person = 0; person < people; ++person) {
    const std::uint32_t seed = first + static_cast<std::uint32_t>(person);
    for (std::size_t k = 0; k < kKinds; ++k) {
      Random random(1000 * static_cast<std::uint64_t>(seed) + k);
      Posed posed{guise_of(static_cast<Kind>(k), random), {}};
      for (int place = 0; place < 2; ++place) {
        posed.pose = pose_of(random);
        if (posed.guise.wears_glasses) find_glasses(static_cast<Kind>(k), seed, posed, random);
        for (int i = 0; i < cases; ++i) {
          const pipeline::GateAnswer answer = proof.look(posed, seed, random);
          ++given[k][static_cast<std::size_t>(answer.reason)];
          if (measures != nullptr) print_measures(measures, seed, static_cast<Kind>(k), place, answer);
        }
      }
    }
    std::fprintf(stderr, "%d of %d people\n", person + 1, people);
  }
  if (measures != nullptr) std::fclose(measures);
  print_table(given, 2 * people * cases);
  return 0;
}

}  // namespace
}  // namespace relievo::bench

int main(int argc, char** argv) { return relievo::bench::run(argc, argv); }
