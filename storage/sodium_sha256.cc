// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "storage/sodium_sha256.h"

#include <sodium.h>

namespace relievo::storage {

static_assert(crypto_hash_sha256_BYTES == sizeof(Sha256));

Sha256 sha256(std::span<const std::byte> bytes) {
  Sha256 digest{};
  crypto_hash_sha256(reinterpret_cast<unsigned char*>(digest.data()),
                     reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  return digest;
}

}  // namespace relievo::storage
