// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A key sealed by this board's TPM 2.0: what seal_by_tpm() returns can be opened by that chip alone, until it
// is cleared. It is a keyed-hash object under the storage primary key that the chip makes anew from its
// owner's seed each time (the TCG's template, ECC P-256): nothing is kept in the chip. What passes on the
// wire to it is encrypted.
//
// Which TPM: TPM2TOOLS_TCTI, as tpm2-tools have it (`none`: none at all), else the device /dev/tpmrm0.
// Errors: IoFailed (no TPM answers, or it refuses: its number is named), InvalidInput (sealed by another TPM,
// or by this one before it was cleared; changed since), OutOfMemory. Thread: one at a time.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "hal/base/result.h"
#include "storage/cipher/secret_key.h"

namespace relievo::storage {

// Whether this program has one to go to; it may still not answer.
bool tpm_is_there();

Result<std::vector<std::byte>> seal_by_tpm(const SecretKey& key);
bool is_sealed_by_tpm(std::span<const std::byte> bytes);
Result<void> open_by_tpm(std::span<const std::byte> sealed, SecretKey& key);

inline constexpr std::size_t kMostSealedByTpm = 1024;

}  // namespace relievo::storage
