// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whole visits, drawn from a seed. Three of five visitors are well-behaved: they walk up, perhaps too near or
// off the middle for a moment, and stand right. The others have one to four faults, stand right between them
// now and then for less than a capture takes, and either stand right in the end or leave. The gate looks at
// every fifth picture of simulated time: three or four a second instead of fifteen. A capture is what the
// kiosk calls one: kHeld without a reason (ui/view/visit.h). That a fault was there when it began or ended is
// judged by the script; kNearly without a reason while a fault is there is counted too, long before a
// capture.
#pragma once

#include <cstdint>

#include "tests/bench/gate/gate_cases.h"

namespace relievo::bench {

inline constexpr pipeline::GateTime kVisitFrame = std::chrono::milliseconds(300),
                                    kHeld = std::chrono::milliseconds(2100),
                                    kNearly = std::chrono::milliseconds(300);
inline constexpr pipeline::GateTime kAllowed = std::chrono::seconds(5);

struct VisitEnd {
  bool well_behaved = false;
  bool stood_right = false;          // in the end, until captured or for kAllowed
  bool nearly = false;               // kNearly without a reason while a fault was there
  const char* with_fault = nullptr;  // captured with this fault
  bool captured = false;             // standing right
  pipeline::GateTime after{};        // the capture, from standing right on
};

VisitEnd run_visit(GateTrial& trial, std::uint32_t person, std::uint64_t seed);

}  // namespace relievo::bench
