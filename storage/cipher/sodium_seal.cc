// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <sodium.h>

#include <algorithm>
#include <string>

#include "storage/cipher/seal.h"
#include "storage/cipher/sodium_bytes.h"

namespace relievo::storage {
namespace {

constexpr std::size_t kNonce = crypto_aead_xchacha20poly1305_ietf_NPUBBYTES;
static_assert(kSealBytes == kNonce + crypto_aead_xchacha20poly1305_ietf_ABYTES);
static_assert(SealedStream::kTagBytes == crypto_secretstream_xchacha20poly1305_ABYTES);
static_assert(sizeof(StreamHeader) == crypto_secretstream_xchacha20poly1305_HEADERBYTES);
static_assert(sizeof(KeyedHash) == crypto_generichash_BYTES);

crypto_secretstream_xchacha20poly1305_state* state_in(LockedBytes& room) {
  return reinterpret_cast<crypto_secretstream_xchacha20poly1305_state*>(room.bytes().data());
}

// The place as bytes: both names with their lengths, so that no two places read alike, then the row.
struct Bound {
  explicit Bound(const Place& place) {
    for (const std::string_view name : {place.table, place.column}) {
      const std::size_t room = std::min(name.size(), std::size_t{40});
      bytes[size++] = static_cast<unsigned char>(room);
      for (std::size_t i = 0; i < room; ++i) bytes[size++] = static_cast<unsigned char>(name[i]);
    }
    for (int shift = 0; shift < 64; shift += 8)
      bytes[size++] = static_cast<unsigned char>(std::uint64_t(place.row) >> shift);
  }
  std::array<unsigned char, 96> bytes{};
  std::size_t size = 0;
};

Error refused(const Place& place) {
  return Error{Errc::StoreCorrupt,
               "this value was changed, or stands in the place of another: restore a copy of the store"}
      .at(std::string(place.table) + " " + std::to_string(place.row) + ", " + std::string(place.column));
}

Result<void> unseal_into(const SecretKey& key, const Place& place, std::span<const std::byte> sealed,
                         std::span<std::byte> plain) {
  const Bound bound(place);
  if (sealed.size() != plain.size() + kSealBytes ||
      crypto_aead_xchacha20poly1305_ietf_decrypt(raw(plain), nullptr, nullptr, raw(sealed) + kNonce,
                                                 sealed.size() - kNonce, bound.bytes.data(), bound.size,
                                                 raw(sealed), raw(key.bytes())) != 0)
    return refused(place);
  return {};
}

}  // namespace

std::vector<std::byte> seal(const SecretKey& key, const Place& place, std::span<const std::byte> plain) {
  const Bound bound(place);
  std::vector<std::byte> sealed(plain.size() + kSealBytes);
  randombytes_buf(sealed.data(), kNonce);
  crypto_aead_xchacha20poly1305_ietf_encrypt(raw(sealed) + kNonce, nullptr, raw(plain), plain.size(),
                                             bound.bytes.data(), bound.size, nullptr, raw(sealed),
                                             raw(key.bytes()));
  return sealed;
}

Result<std::vector<std::byte>> unseal(const SecretKey& key, const Place& place,
                                      std::span<const std::byte> sealed) {
  if (sealed.size() < kSealBytes) return refused(place);
  std::vector<std::byte> plain(sealed.size() - kSealBytes);
  RELIEVO_TRY(unseal_into(key, place, sealed, plain));
  return plain;
}

Result<void> unwrap(const SecretKey& key, const Place& place, std::span<const std::byte> sealed,
                    SecretKey& inner) {
  return unseal_into(key, place, sealed, inner.bytes());
}

std::size_t SealedStream::sealed_bytes(std::size_t plain) {
  return plain + kTagBytes * std::max<std::size_t>(1, (plain + kPieceBytes - 1) / kPieceBytes);
}
std::size_t SealedStream::plain_bytes(std::size_t sealed) {
  const std::size_t tags = kTagBytes * ((sealed + kSealedPieceBytes - 1) / kSealedPieceBytes);
  return sealed < tags ? 0 : sealed - tags;
}

Result<SealedStream> SealedStream::make() {
  RELIEVO_TRY_ASSIGN(auto state, LockedBytes::make(sizeof(crypto_secretstream_xchacha20poly1305_state)));
  return SealedStream(std::move(state));
}

StreamHeader SealedStream::begin_sealing(const SecretKey& key) {
  StreamHeader header{};
  crypto_secretstream_xchacha20poly1305_init_push(state_in(state_), raw(header), raw(key.bytes()));
  return header;
}

std::span<const std::byte> SealedStream::seal_piece(const Place& place, std::span<const std::byte> plain,
                                                    bool last) {
  const Bound bound(place);
  sealed_.resize(plain.size() + kTagBytes);
  crypto_secretstream_xchacha20poly1305_push(state_in(state_), raw(sealed_), nullptr, raw(plain),
                                             plain.size(), bound.bytes.data(), bound.size,
                                             last ? crypto_secretstream_xchacha20poly1305_TAG_FINAL : 0);
  return sealed_;
}

void SealedStream::begin_opening(const SecretKey& key, const StreamHeader& header) {
  crypto_secretstream_xchacha20poly1305_init_pull(state_in(state_), raw(header), raw(key.bytes()));
}

Result<void> SealedStream::open_piece(const Place& place, std::span<const std::byte> sealed, bool last,
                                      std::span<std::byte> plain) {
  const Bound bound(place);
  unsigned char tag = 0;
  if (sealed.size() != plain.size() + kTagBytes ||
      crypto_secretstream_xchacha20poly1305_pull(state_in(state_), raw(plain), nullptr, &tag, raw(sealed),
                                                 sealed.size(), bound.bytes.data(), bound.size) != 0 ||
      (tag == crypto_secretstream_xchacha20poly1305_TAG_FINAL) != last)
    return refused(place);
  return {};
}

KeyedHash keyed_hash(const SecretKey& key, std::span<const std::byte> bytes) {
  KeyedHash hash{};
  crypto_generichash(raw(hash), hash.size(), raw(bytes), bytes.size(), raw(key.bytes()), SecretKey::kBytes);
  return hash;
}

}  // namespace relievo::storage
