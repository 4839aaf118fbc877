// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "storage/sodium_sha256.h"

#include <sodium.h>

#include <algorithm>

#include "storage/record.h"

namespace relievo::storage {

static_assert(crypto_hash_sha256_BYTES == sizeof(Sha256));

Sha256 sha256(std::span<const std::byte> bytes) {
  Sha256 digest{};
  crypto_hash_sha256(reinterpret_cast<unsigned char*>(digest.data()),
                     reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  return digest;
}

bool ends_in_sha256(std::span<const std::byte> bytes) {
  constexpr std::size_t kBytes = sizeof(Sha256);
  return bytes.size() >= kBytes &&
         std::ranges::equal(sha256(bytes.first(bytes.size() - kBytes)), bytes.last(kBytes));
}

std::string hex_of(std::span<const std::byte> bytes) {
  std::string hex(2 * bytes.size() + 1, '\0');
  sodium_bin2hex(hex.data(), hex.size(), reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  hex.pop_back();  // its zero
  return hex;
}

bool from_hex(std::string_view hex, std::span<std::byte> bytes) {
  std::size_t size = 0;
  return sodium_hex2bin(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size(), hex.data(), hex.size(),
                        nullptr, &size, nullptr) == 0 &&
         size == bytes.size() && hex_of(bytes) == hex;
}

// What is beyond the last whole multiple of the range is drawn again: every number is as likely as every
// other.
std::int64_t draw_receipt() {
  constexpr auto kRange = std::uint64_t(kMostReceipt - kLeastReceipt + 1);
  constexpr std::uint64_t kEnd = UINT64_MAX - UINT64_MAX % kRange;
  std::uint64_t drawn = 0;
  do randombytes_buf(&drawn, sizeof drawn);
  while (drawn >= kEnd);
  return kLeastReceipt + std::int64_t(drawn % kRange);
}

}  // namespace relievo::storage
