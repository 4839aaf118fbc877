// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A file read or written as a whole. A written file appears under its name complete or not at all:
// temporary name in the same folder, fsync, rename, fsync of the folder. Only a device (/dev/full,
// /dev/stdout) is written in place, since a rename would replace it.
// Errors, each with the path: NotFound, InvalidInput (not a file, empty, too large), IoFailed,
// MediaFull (no room or over quota), OutOfMemory.
// Thread: any.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "hal/base/result.h"

namespace relievo::hal {

Result<std::vector<std::byte>> read_whole_file(const std::filesystem::path& file, std::size_t limit_bytes);
Result<void> write_whole_file(const std::filesystem::path& file, std::span<const std::byte> bytes);

}  // namespace relievo::hal
