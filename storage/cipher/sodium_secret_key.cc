// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <sodium.h>

#include <array>
#include <mutex>
#include <utility>

#include "storage/cipher/secret_key.h"
#include "storage/cipher/sodium_bytes.h"

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
    return Error{Errc::InvalidInput, "is no key of a store: 64 hexadecimal digits"};
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

}  // namespace relievo::storage
