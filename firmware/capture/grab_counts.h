// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// GrabCounts: what has gone well and wrong between the trigger and the slot since the cameras were
// first opened; for a technician, who reads a bad cable or a slow hub out of it.
#pragma once

#include <cstdint>

namespace relievo::firmware {

// Of one camera.
struct CameraCounts {
  std::uint64_t frames = 0;     // taken
  std::uint64_t late = 0;       // exposed before the pulse they were waited for, or out of order: dropped
  std::uint64_t lost = 0;       // numbers missing in the sequence
  std::uint64_t duplicate = 0;  // a number twice: dropped
  std::uint64_t damaged = 0;    // the driver says that bytes are wrong: refused
  std::uint64_t too_short = 0;  // fewer bytes than the picture has: refused
  std::uint64_t missing = 0;    // a wait that ended without a picture
  std::uint64_t vanished = 0;   // the camera went away
  std::uint64_t returned = 0;   // and came back
  std::uint64_t refused = 0;    // attempts to open it again that failed
};

struct GrabCounts {
  CameraCounts left;
  CameraCounts right;
  std::uint64_t pairs = 0;    // handed over
  std::uint64_t apart = 0;    // refused: exposed further apart than the limit
  std::uint64_t slipped = 0;  // pairs by time whose numbers moved against each other: a pulse was missed
};

}  // namespace relievo::firmware
