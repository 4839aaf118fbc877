// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The version, as CMakeLists.txt states it.
#pragma once

#include <string_view>

namespace relievo::firmware {

inline constexpr std::string_view kVersion = RELIEVO_VERSION;

}  // namespace relievo::firmware
