// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/gate/gate_cases.h"

#include "hal/sim/head/shape/head_traits.h"

namespace relievo::bench {
namespace {

using pipeline::Advice;
using test::Extra;
using test::standing;

constexpr double kOily = 8;         // times the person's own shine: a face wet with sweat
constexpr double kPaleSkin = 0.45;  // mean linear reflectance

test::Guise oily() {
  test::Guise guise;
  guise.shine = kOily;
  return guise;
}

}  // namespace

const test::Shot& GateTrial::shot(const Fault& fault, std::uint32_t person, int variant) {
  const bool other = variant != 0;
  if (fault.clutter)
    return album_.shoot(person, other ? standing(600, -12, 8, -4, 3, 3) : standing(560), Extra::WallBehind);
  switch (fault.expected) {
    case Advice::NoFace: return album_.shoot(0, {0, 0, 0, 0, 0, 0});
    case Advice::MoreThanOneFace:
      return album_.shoot(person, other ? standing(540, 35, 5, -3) : standing(560, -40), Extra::Friend);
    case Advice::TooClose:
      return album_.shoot(person, other ? standing(385, 15, -10, 6, 4, 3) : standing(400));
    case Advice::TooFar:
      return album_.shoot(person, other ? standing(740, -15, 0, -4) : standing(760, 20, 10, 5, 5, -8));
    case Advice::OffCentre:
      return album_.shoot(person, other ? standing(570, -80, 10, 4) : standing(560, 85));
    case Advice::TurnedAside:
      return album_.shoot(person, other ? standing(580, 8, 4, -25, 2, 2) : standing(560, 0, 0, 25));
    case Advice::LooksUpOrDown: return album_.shoot(person, standing(560, 0, 0, 0, other ? -20 : 20));
    case Advice::Tilted:
      return album_.shoot(person, other ? standing(545, -10, 0, 3, 0, -21) : standing(560, 0, 0, 0, 0, 20));
    case Advice::FaceHidden:
      return album_.shoot(person, standing(560), other ? Extra::HandOnCheek : Extra::HandBefore);
    case Advice::Background:
      return album_.shoot(person, other ? standing(590, 30, -5, -3, 2, 2) : standing(545, -30, 5, 3),
                          Extra::BagBeside);
    case Advice::Highlights:
      return album_.shoot(person, other ? standing(600, -12, 8, -4, 3, 3) : standing(560), Extra::None,
                          oily());
    case Advice::None:
    case Advice::Moved:
    case Advice::TooDark:
    case Advice::TooBright:
    case Advice::UnevenLight:
    case Advice::Blurred:
    case Advice::EyesHidden:
    case Advice::EyesClosed:
    case Advice::GlassesGlare:
    case Advice::MouthOpen:
    case Advice::NotNeutral: break;
  }
  return other ? album_.shoot(person, standing(600, -12, 8, -4, 3, 3)) : album_.shoot(person, standing(560));
}

test::Developing GateTrial::developing(Advice fault, std::uint32_t person, hal::sim::Random& random) {
  const hal::sim::Vec3 skin = hal::sim::traits_of(person).skin;
  const double paleness = (skin.x + skin.y + skin.z) / 3 / kPaleSkin;
  test::Developing how;
  how.exposure = random.uniform(0.75, 1.4);
  how.noise_seed = random.next() >> 2;
  if (fault == Advice::TooDark) how.exposure = random.uniform(0.01, 0.06) / paleness;
  if (fault == Advice::TooBright) how.exposure = random.uniform(5, 12) / paleness;
  if (fault == Advice::UnevenLight) how.one_sided = random.uniform(0.0, 0.05);
  if (fault == Advice::Blurred) how.defocus_px = random.uniform(2, 4);
  return how;
}

pipeline::GateAnswer GateTrial::look(const test::Shot& shot, const test::Developing& how,
                                     pipeline::GateTime now, pipeline::GateHistory& history) {
  return gate_.look(album_, shot, how, now, history).answer;
}

}  // namespace relievo::bench
