// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A key in memory: locked (never in swap), left out of core dumps, between guard pages, wiped when it is
// given up (libsodium, "Secure memory"). Owns its bytes; moves, never copies itself.
// Errors: OutOfMemory, also where the system lets nothing be locked. Thread: one at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>

#include "hal/base/result.h"
#include "storage/record.h"

namespace relievo::storage {

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

// Who made a piece of bytes: Ed25519 (RFC 8032), which anybody checks who knows the public half.
// Errors: OutOfMemory. Thread: any.

// `seed`: Ed25519's secret half, as its standard has it.
Result<Signed> sign_with(const SecretKey& seed, std::span<const std::byte> bytes);
bool is_signed(const Signed& claimed, std::span<const std::byte> bytes);

}  // namespace relievo::storage
