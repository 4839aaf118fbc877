// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Advice: what the person in front of the cameras can do. Not an error: nothing is broken.
#pragma once

#include <cstdint>

namespace relievo::pipeline {

enum class Advice : std::uint8_t { None, NoFace, TooClose, TooFar, OffCentre, TooDark, TooBright, Blurred, Moved };

}  // namespace relievo::pipeline
