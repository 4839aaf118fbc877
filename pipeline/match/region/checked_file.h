// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A cascade's file as text, read whole and checked by its SHA-256 before any library parses it.
// Thread: any. Errors: NotFound (no such file), StoreCorrupt (not the file we know).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "hal/base/result.h"

namespace relievo::pipeline {

// SHA-256 (FIPS 180-4) of bytes in memory: a data file is checked before a library parses it.
// Thread: any. No errors.
std::array<std::uint8_t, 32> sha256(std::span<const std::byte> bytes);

// Whether `digest` reads as `hex` (64 lower-case digits).
bool reads_as(const std::array<std::uint8_t, 32>& digest, std::string_view hex);

Result<std::string> read_checked(const std::filesystem::path& path, std::string_view sha256_hex);

}  // namespace relievo::pipeline
