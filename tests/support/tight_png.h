// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A picture to be kept in the repository: coarse in its grey levels, packed as tightly as PNG does. False
// where it cannot be written.
#pragma once

#include <filesystem>

#include "hal/picture_file.h"

namespace relievo::test {

// Every channel to the next multiple of `step`.
bool write_tight_png(const hal::Picture& rgb, int step, const std::filesystem::path& file);

}  // namespace relievo::test
