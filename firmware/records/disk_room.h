// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Has the disk the room that the staff wants to stay free? Thread: any.
// Errors: MediaFull (it has not), IoFailed (it does not tell).
#pragma once

#include <cstdint>
#include <filesystem>

#include "hal/base/result.h"

namespace relievo::firmware {

Result<void> disk_has_room(const std::filesystem::path& folder, std::int32_t least_mib);

}  // namespace relievo::firmware
