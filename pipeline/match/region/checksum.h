// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// SHA-256 (FIPS 180-4) of bytes in memory: a data file is checked before a library parses it.
// Thread: any. No errors.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace relievo::pipeline {

std::array<std::uint8_t, 32> sha256(std::span<const std::byte> bytes);

// Whether `digest` reads as `hex` (64 lower-case digits).
bool reads_as(const std::array<std::uint8_t, 32>& digest, std::string_view hex);

}  // namespace relievo::pipeline
