// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// SHA-256, for everything in the store that must be noticed when it changes.
#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace relievo::storage {

using Sha256 = std::array<std::byte, 32>;

Sha256 sha256(std::span<const std::byte> bytes);

}  // namespace relievo::storage
