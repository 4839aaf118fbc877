// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <sodium.h>

#include <array>

#include "firmware/service/pin_hash.h"

namespace relievo::firmware {
namespace {

constexpr unsigned long long kPasses = 2;
constexpr std::size_t kMemory = std::size_t{19} << 20;

}  // namespace

Result<std::string> stretched(std::string_view pin) {
  std::array<char, crypto_pwhash_STRBYTES> text{};
  if (sodium_init() < 0 || crypto_pwhash_str(text.data(), pin.data(), pin.size(), kPasses, kMemory) != 0)
    return Error{Errc::OutOfMemory,
                 "there is not enough memory to keep a PIN safely: restart, then try again"};
  return std::string(text.data());
}

bool is_pin_of(std::string_view pin, const std::string& kept) {
  return !kept.empty() && kept.size() < crypto_pwhash_STRBYTES && sodium_init() >= 0 &&
         crypto_pwhash_str_verify(kept.c_str(), pin.data(), pin.size()) == 0;
}

void wipe_text(std::string& text) {
  sodium_memzero(text.data(), text.size());
  text.clear();
}

}  // namespace relievo::firmware
