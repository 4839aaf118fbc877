// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Heat: how near the machine is to switching itself off, as the kernel tells it: each thermal zone with its
// temperature and its critical trip point (Documentation/driver-api/thermal/sysfs-api). Thread: any.
#pragma once

#include <filesystem>

namespace relievo::hal {

// Degrees below its critical point at which a zone counts.
inline constexpr double kHeatMargin = 5;

// Is any zone of `thermal` (/sys/class/thermal) so near? A zone that tells no temperature or no critical
// point is none.
bool near_switching_off(const std::filesystem::path& thermal);

}  // namespace relievo::hal
