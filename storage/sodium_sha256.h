// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// SHA-256, for everything in the store that must be noticed when it changes; and bytes as people compare
// them.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace relievo::storage {

using Sha256 = std::array<std::byte, 32>;

Sha256 sha256(std::span<const std::byte> bytes);
// Is their end the SHA-256 of all before it?
bool ends_in_sha256(std::span<const std::byte> bytes);

// In hexadecimal, small letters; and back: only what hex_of() makes of exactly so many bytes.
std::string hex_of(std::span<const std::byte> bytes);
bool from_hex(std::string_view hex, std::span<std::byte> bytes);

}  // namespace relievo::storage
