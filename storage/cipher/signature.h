// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Who made a piece of bytes: Ed25519 (RFC 8032), which anybody checks who knows the public half.
// Errors: OutOfMemory. Thread: any.
#pragma once

#include <cstddef>
#include <span>

#include "hal/base/result.h"
#include "storage/cipher/secret_key.h"
#include "storage/record.h"

namespace relievo::storage {

// `seed`: Ed25519's secret half, as its standard has it.
Result<Signed> sign_with(const SecretKey& seed, std::span<const std::byte> bytes);
bool is_signed(const Signed& claimed, std::span<const std::byte> bytes);

}  // namespace relievo::storage
