// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files sealed to whom they are for, in the published format of age (age-encryption.org/v1, C2SP age.md):
// anybody opens them with Debian's `age`. For a recipient by X25519, or by a passphrase through scrypt; the
// content by ChaCha20-Poly1305 in pieces of 64 KiB (STREAM). What is cut, changed or turned is refused as a
// whole. Errors: InvalidInput (no such recipient, key or file; not for this key; changed or cut), OutOfMemory
// (scrypt takes 128 MiB, to open somebody else's file up to 1 GiB). May throw std::bad_alloc. Thread: any.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "hal/base/result.h"
#include "storage/cipher/seal.h"

namespace relievo::storage {

using AgeRecipient = std::array<std::byte, 32>;
Result<AgeRecipient> age_recipient(std::string_view text);  // "age1..."
Result<SecretKey> age_identity(std::string_view text);  // "AGE-SECRET-KEY-1...", as age-keygen's file has it

struct Passphrase {
  std::string_view text;
};
using AgeTo = std::variant<AgeRecipient, Passphrase>;
using AgeBy = std::variant<const SecretKey*, Passphrase>;

Result<std::vector<std::byte>> age_seal(const AgeTo& to, std::span<const std::byte> plain);
Result<std::vector<std::byte>> age_open(const AgeBy& by, std::span<const std::byte> sealed);

}  // namespace relievo::storage
