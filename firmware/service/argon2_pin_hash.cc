// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The reference implementation works in the heap. libsodium's would map its memory anew for every PIN, and
// what is in service asks the system for none; the texts it wrote are the same.
#include <argon2.h>
#include <string.h>
#include <sys/random.h>

#include <array>

#include "firmware/service/access.h"

namespace relievo::firmware {
namespace {

constexpr std::uint32_t kPasses = 2, kMemoryKiB = 19 << 10, kLanes = 1;
constexpr std::size_t kSaltBytes = 16, kHashBytes = 32, kTextBytes = 128;

Error no_memory() {
  return {Errc::OutOfMemory, "there is not enough memory to look at a PIN safely: restart, then try again"};
}

}  // namespace

Result<std::string> stretched(std::string_view pin) {
  std::array<unsigned char, kSaltBytes> salt{};
  std::array<char, kTextBytes> text{};
  if (::getrandom(salt.data(), salt.size(), 0) != ssize_t(salt.size()) ||
      argon2id_hash_encoded(kPasses, kMemoryKiB, kLanes, pin.data(), pin.size(), salt.data(), salt.size(),
                            kHashBytes, text.data(), text.size()) != ARGON2_OK)
    return no_memory();
  return std::string(text.data());
}

Result<bool> is_pin_of(std::string_view pin, const std::string& kept) {
  if (kept.empty() || kept.size() >= kTextBytes) return false;
  const int answer = argon2id_verify(kept.c_str(), pin.data(), pin.size());
  if (answer == ARGON2_MEMORY_ALLOCATION_ERROR) return no_memory();
  return answer == ARGON2_OK;
}

void wipe_text(std::string& text) {
  text.resize(text.capacity());  // of one that was longer, or moved, more lies behind its end
  ::explicit_bzero(text.data(), text.size());
  text.clear();
}

}  // namespace relievo::firmware
