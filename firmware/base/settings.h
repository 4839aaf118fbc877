// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where things are when nobody says otherwise, and the staff's settings as the store keeps them: a line each,
// "key value". Thread: any.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "hal/base/result.h"
#include "ui/device/settings.h"

namespace relievo::firmware {

// The folder that is named; where none is, $XDG_DATA_HOME/relievo, or ~/.local/share/relievo. InvalidInput:
// there is no home either.
Result<std::filesystem::path> store_folder(const std::filesystem::path& named);

inline constexpr const char* kDeviceSetting = "device";  // the store's key of all of them

std::string text_of(const ui::Settings& settings);
// What is missing, or not one of a setting's values, stays as usual; `complaints` are the lines that say such
// a thing.
ui::Settings settings_of(std::string_view text, std::vector<std::string>& complaints);

// Has the disk the room that the staff wants to stay free? MediaFull: it has not; IoFailed: it does not tell.
Result<void> disk_has_room(const std::filesystem::path& folder, std::int32_t least_mib);

}  // namespace relievo::firmware
