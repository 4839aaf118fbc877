// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "storage/cipher/seal.h"

#include <sodium.h>

#include <algorithm>
#include <array>
#include <mutex>
#include <string>
#include <utility>

#include "storage/byte_order.h"

namespace relievo::storage {
namespace {

constexpr char kContext[] = "relievo1";
static_assert(sizeof kContext - 1 == crypto_kdf_CONTEXTBYTES);
static_assert(SecretKey::kBytes == crypto_kdf_KEYBYTES &&
              SecretKey::kBytes == crypto_aead_xchacha20poly1305_ietf_KEYBYTES);

// What was given up, wiped, waits for the next of its size: a kiosk in service maps no memory (an enrolment
// needs two keys for a moment). Never given back. Thread: any.
class Spare {
 public:
  std::byte* take(std::size_t size) {
    const std::lock_guard lock(mutex_);
    for (Room& room : rooms_)
      if (room.data != nullptr && room.size == size) return std::exchange(room.data, nullptr);
    return nullptr;
  }
  bool keep(std::byte* data, std::size_t size) {
    const std::lock_guard lock(mutex_);
    for (Room& room : rooms_)
      if (room.data == nullptr) return room = {data, size}, true;
    return false;
  }

 private:
  struct Room {
    std::byte* data = nullptr;
    std::size_t size = 0;
  };
  std::mutex mutex_;
  std::array<Room, 8> rooms_;
};
Spare& spare() {
  static Spare rooms;
  return rooms;
}

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

Result<LockedBytes> LockedBytes::make(std::size_t size) {
  static const int ready = sodium_init();
  if (auto* kept = spare().take(size)) return LockedBytes(kept, size);
  auto* data = ready < 0 ? nullptr : static_cast<std::byte*>(sodium_malloc(size));
  if (data == nullptr) return Error{Errc::OutOfMemory, "there is no memory for the store's keys"};
  // sodium_malloc() locks, and is silent where it could not: asked once more, it says so. Such a room is not
  // kept.
  if (sodium_mlock(data, size) != 0) {
    sodium_free(data);
    return Error{Errc::OutOfMemory,
                 "the store's keys cannot be kept out of swap: allow more locked memory (LimitMEMLOCK)"};
  }
  LockedBytes room(data, size);
  room.wipe();
  return room;
}

LockedBytes::~LockedBytes() {
  if (data_ == nullptr) return;
  wipe();
  if (!spare().keep(data_, size_)) sodium_free(data_);  // unlocks
}

void LockedBytes::wipe() { sodium_memzero(data_, size_); }

Result<SecretKey> SecretKey::make() {
  RELIEVO_TRY_ASSIGN(auto room, LockedBytes::make(kBytes));
  return SecretKey(std::move(room));
}

void SecretKey::draw() { randombytes_buf(bytes().data(), kBytes); }

void SecretKey::derive(const SecretKey& from, std::uint64_t purpose) {
  crypto_kdf_derive_from_key(raw(bytes()), kBytes, purpose, kContext, raw(from.bytes()));
}

Result<void> read_key(std::string_view text, SecretKey& key) {
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r' || text.back() == ' '))
    text.remove_suffix(1);
  std::size_t got = 0;
  if (text.size() != 2 * SecretKey::kBytes ||
      sodium_hex2bin(raw(key.bytes()), SecretKey::kBytes, text.data(), text.size(), nullptr, &got, nullptr) !=
          0 ||
      got != SecretKey::kBytes) {
    key.wipe();
    return invalid("is no key of a store: 64 hexadecimal digits");
  }
  return {};
}

Result<LockedBytes> key_text(const SecretKey& key) {
  constexpr std::size_t kDigits = 2 * SecretKey::kBytes;
  RELIEVO_TRY_ASSIGN(auto text, LockedBytes::make(kDigits + 1));
  sodium_bin2hex(reinterpret_cast<char*>(text.bytes().data()), kDigits + 1, raw(key.bytes()),
                 SecretKey::kBytes);
  text.bytes().back() = std::byte{'\n'};
  return text;
}

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
