// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where something went wrong (Error::where), in the reader's language: places are English words with figures
// in them, which a command prints as they are. Names, paths and keys that are no words stay. Thread: main.
// Errors: none.
#pragma once

#include <string_view>

#include "ui/screens/service/staff_frame.h"

namespace relievo::ui {

// What stands between two cameras' names: the calibrated one, the one that is there
// (firmware/capture/rig_cameras.cc).
inline constexpr std::string_view kBecame = " → ";

std::string_view said_place(StaffFrame& page, std::string_view place);

}  // namespace relievo::ui
