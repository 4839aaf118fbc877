// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Intent: what a person at the screen asks for. The machine decides whether it listens.
#pragma once

#include <cstdint>

namespace relievo::ui {

enum class Intent : std::uint8_t {
  Begin, Accept, Retake, Cancel,
  OpenTechnician, LeaveTechnician, Calibrate, Export
};

}  // namespace relievo::ui
