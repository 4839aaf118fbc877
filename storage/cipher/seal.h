// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Keys in memory, and what is sealed, found and signed by them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "hal/base/result.h"
#include "storage/record.h"

namespace relievo::storage {

// A key in memory: locked (never in swap), left out of core dumps, between guard pages, wiped when it is
// given up (libsodium, "Secure memory"). Owns its bytes; moves, never copies itself.
// Errors: OutOfMemory, also where the system lets nothing be locked. Thread: one at a time.

// `size` bytes of such memory, for keys and for what is made of them.
class LockedBytes {
 public:
  static Result<LockedBytes> make(std::size_t size);  // zeros
  ~LockedBytes();
  LockedBytes(LockedBytes&& other) noexcept
      : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0)) {}
  LockedBytes& operator=(LockedBytes&&) = delete;

  std::span<std::byte> bytes() { return {data_, size_}; }
  std::span<const std::byte> bytes() const { return {data_, size_}; }
  void wipe();

 private:
  LockedBytes(std::byte* data, std::size_t size) : data_(data), size_(size) {}
  std::byte* data_;
  std::size_t size_;
};

class SecretKey {
 public:
  static constexpr std::size_t kBytes = 32;

  static Result<SecretKey> make();  // zeros
  std::span<std::byte> bytes() { return room_.bytes(); }
  std::span<const std::byte> bytes() const { return room_.bytes(); }

  void draw();                                                // from the system's generator
  void derive(const SecretKey& from, std::uint64_t purpose);  // one way; each purpose another key
  void wipe() { room_.wipe(); }

 private:
  explicit SecretKey(LockedBytes room) : room_(std::move(room)) {}
  LockedBytes room_;
};

// As it stands in files: 64 hexadecimal digits. Reading takes white space at the end.
// InvalidInput: anything else.
Result<void> read_key(std::string_view text, SecretKey& key);
Result<LockedBytes> key_text(const SecretKey& key);  // with a line's end

// Encryption of what the store holds: XChaCha20-Poly1305 (draft-irtf-cfrg-xchacha-03; libsodium
// crypto_aead_xchacha20poly1305_ietf), large values as crypto_secretstream_xchacha20poly1305.
//
//   a sealed value:   nonce 24, drawn | ciphertext, as long as the plain | tag 16
//   a sealed stream:  pieces of kPieceBytes, the last may be shorter, each 17 bytes longer than its plain.
//                     The header of 24 bytes is kept apart. A cut or turned stream is refused.
//
// Each is bound to the place it belongs to (its associated data): opened for any other it is refused.
// Errors of opening: StoreCorrupt, which names the place. May throw std::bad_alloc. Thread: any; a
// SealedStream one at a time.

struct Place {
  std::string_view table;
  std::string_view column;
  std::int64_t row = 0;
};

inline constexpr std::size_t kSealBytes = 24 + 16;  // what sealing adds

std::vector<std::byte> seal(const SecretKey& key, const Place& place, std::span<const std::byte> plain);
Result<std::vector<std::byte>> unseal(const SecretKey& key, const Place& place,
                                      std::span<const std::byte> sealed);
// A key sealed as a value, straight into locked memory.
Result<void> unwrap(const SecretKey& key, const Place& place, std::span<const std::byte> sealed,
                    SecretKey& inner);

using StreamHeader = std::array<std::byte, 24>;

class SealedStream {
 public:
  static constexpr std::size_t kPieceBytes = 256 * 1024, kTagBytes = 17;
  static constexpr std::size_t kSealedPieceBytes = kPieceBytes + kTagBytes;
  static std::size_t sealed_bytes(std::size_t plain);
  static std::size_t plain_bytes(std::size_t sealed);

  static Result<SealedStream> make();

  StreamHeader begin_sealing(const SecretKey& key);
  // Returns sealed bytes, valid until the next call.
  std::span<const std::byte> seal_piece(const Place& place, std::span<const std::byte> plain, bool last);

  void begin_opening(const SecretKey& key, const StreamHeader& header);
  // `plain` has as many bytes as `sealed` less kTagBytes.
  Result<void> open_piece(const Place& place, std::span<const std::byte> sealed, bool last,
                          std::span<std::byte> plain);
  void end() { state_.wipe(); }

 private:
  explicit SealedStream(LockedBytes state) : state_(std::move(state)) {}
  LockedBytes state_;
  std::vector<std::byte> sealed_;
};

// BLAKE2b with a key (RFC 7693; crypto_generichash): found again by who has the key, and by nobody else.
using KeyedHash = std::array<std::byte, 32>;
KeyedHash keyed_hash(const SecretKey& key, std::span<const std::byte> bytes);

// Who made a piece of bytes: Ed25519 (RFC 8032), which anybody checks who knows the public half.
// Errors: OutOfMemory. Thread: any.

// `seed`: Ed25519's secret half, as its standard has it.
Result<Signed> sign_with(const SecretKey& seed, std::span<const std::byte> bytes);
bool is_signed(const Signed& claimed, std::span<const std::byte> bytes);

}  // namespace relievo::storage
