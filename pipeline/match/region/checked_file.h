// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A cascade's file as text, read whole and checked by its SHA-256 before any library parses it.
// Thread: any. Errors: NotFound (no such file), StoreCorrupt (not the file we know).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "hal/base/result.h"

namespace relievo::pipeline {

Result<std::string> read_checked(const std::filesystem::path& path, std::string_view sha256_hex);

}  // namespace relievo::pipeline
