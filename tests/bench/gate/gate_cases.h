// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the gate is proven with: people before the rig with one fault each, and the gate itself as the kiosk
// runs it, on pictures a quarter of the rig's size. Thread: one caller. Errors: end the program with one
// line.
#pragma once

#include <array>

#include "hal/sim/base/noise.h"
#include "tests/support/gate_fixture.h"

namespace relievo::bench {

struct Fault {
  const char* name;
  pipeline::Advice expected;
  bool clutter = false;  // behind the head
};
// The first two are nobody's fault.
inline constexpr std::array kFaults{Fault{"none", pipeline::Advice::None},
                                    Fault{"nobody", pipeline::Advice::NoFace},
                                    Fault{"friend", pipeline::Advice::MoreThanOneFace},
                                    Fault{"too near", pipeline::Advice::TooClose},
                                    Fault{"too far", pipeline::Advice::TooFar},
                                    Fault{"off centre", pipeline::Advice::OffCentre},
                                    Fault{"turned", pipeline::Advice::TurnedAside},
                                    Fault{"bowed", pipeline::Advice::LooksUpOrDown},
                                    Fault{"tilted", pipeline::Advice::Tilted},
                                    Fault{"moving", pipeline::Advice::Moved},
                                    Fault{"dark", pipeline::Advice::TooDark},
                                    Fault{"bright", pipeline::Advice::TooBright},
                                    Fault{"one lamp", pipeline::Advice::UnevenLight},
                                    Fault{"blurred", pipeline::Advice::Blurred},
                                    Fault{"hand", pipeline::Advice::FaceHidden},
                                    Fault{"beside", pipeline::Advice::Background},
                                    Fault{"clutter", pipeline::Advice::None, true},
                                    Fault{"oily", pipeline::Advice::Highlights}};
inline constexpr std::size_t kFaultsOfVisits =
    kFaults.size() - 1;              // nobody's skin becomes oily while they stand there
inline constexpr int kVariants = 2;  // ways of standing with each fault

class GateTrial {
 public:
  explicit GateTrial(const char* album_folder) : album_(album_folder) {}
  // Few places a person, so that few photographs serve many cases.
  const test::Shot& shot(const Fault& fault, std::uint32_t person, int variant);
  // Exposure and noise, and how strong the fault is where developing makes it: much too dark and bright is
  // meant of the person's own skin.
  static test::Developing developing(pipeline::Advice fault, std::uint32_t person, hal::sim::Random& random);
  pipeline::GateAnswer look(const test::Shot& shot, const test::Developing& how, pipeline::GateTime now,
                            pipeline::GateHistory& history);

 private:
  test::Album album_;
  test::GateFixture gate_;
};

}  // namespace relievo::bench
