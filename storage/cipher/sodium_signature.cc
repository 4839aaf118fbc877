// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <sodium.h>

#include "storage/cipher/signature.h"
#include "storage/cipher/sodium_bytes.h"

namespace relievo::storage {

Result<Signed> sign_with(const SecretKey& seed, std::span<const std::byte> bytes) {
  RELIEVO_TRY_ASSIGN(auto secret, LockedBytes::make(crypto_sign_SECRETKEYBYTES));
  Signed made;
  crypto_sign_seed_keypair(raw(made.by), raw(secret.bytes()), raw(seed.bytes()));
  crypto_sign_detached(raw(made.signature), nullptr, raw(bytes), bytes.size(), raw(secret.bytes()));
  return made;
}

bool is_signed(const Signed& claimed, std::span<const std::byte> bytes) {
  return crypto_sign_verify_detached(raw(claimed.signature), raw(bytes), bytes.size(), raw(claimed.by)) == 0;
}

}  // namespace relievo::storage
