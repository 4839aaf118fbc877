// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <sodium.h>

#include <algorithm>

#include "storage/byte_order.h"
#include "storage/cipher/recovery.h"
#include "storage/sodium_sha256.h"
#include "storage/text.h"

namespace relievo::storage {
namespace {

constexpr std::size_t kWordBits = 11;
constexpr std::string_view kPurpose = "relievo recovery 1";
static_assert(sizeof(RecoveryPublic) == crypto_box_PUBLICKEYBYTES &&
              SecretKey::kBytes == crypto_box_SECRETKEYBYTES);

std::vector<std::string_view> word_list() {
  auto list = split(recovery_word_list(), '\n');
  std::erase(list, "");
  return list;
}

// Bit i of the words: first those that were drawn, then the first of their SHA-256.
bool bit_of(const RecoveryBits& bits, const Sha256& digest, std::size_t i) {
  const std::byte byte = i < 8 * kRecoveryBytes ? bits[i / 8] : digest[i / 8 - kRecoveryBytes];
  return ((byte >> (7 - i % 8)) & std::byte{1}) != std::byte{0};
}

}  // namespace

std::string words_of(const RecoveryBits& bits) {
  const auto list = word_list();
  const Sha256 digest = sha256(bits);
  std::string words;
  for (std::size_t word = 0; word < kRecoveryWords; ++word) {
    std::size_t index = 0;
    for (std::size_t i = 0; i < kWordBits; ++i)
      index = index * 2 + (bit_of(bits, digest, word * kWordBits + i) ? 1 : 0);
    words += (word == 0 ? "" : " ") + std::string(list.at(index));
  }
  return words;
}

std::array<std::size_t, 2> words_to_ask() {
  const std::size_t first = randombytes_uniform(kRecoveryWords / 2);
  return {first, first + kRecoveryWords / 2};
}

std::string draw_recovery_words() {
  RecoveryBits bits{};
  randombytes_buf(bits.data(), bits.size());
  const auto words = words_of(bits);
  sodium_memzero(bits.data(), bits.size());
  return words;
}

Result<RecoveryBits> bits_of(std::string_view words) {
  const auto list = word_list();
  constexpr std::string_view kSpace = " \t\r\n";
  RecoveryBits bits{};
  std::array<bool, kRecoveryWords * kWordBits> given{};
  std::size_t count = 0;
  for (std::size_t at = 0; (at = words.find_first_not_of(kSpace, at)) != std::string_view::npos; ++count) {
    std::string word(words.substr(at, std::min(words.find_first_of(kSpace, at), words.size()) - at));
    at += word.size();
    std::ranges::transform(word, word.begin(), small_letter);
    const auto found = std::ranges::lower_bound(list, std::string_view(word));
    if (found == list.end() || *found != word)
      return invalid("this is none of the words: look at the sheet again")
          .at("word " + std::to_string(count + 1));
    const auto index = std::size_t(found - list.begin());
    for (std::size_t i = 0; count < kRecoveryWords && i < kWordBits; ++i)
      given[count * kWordBits + i] = ((index >> (kWordBits - 1 - i)) & 1) != 0;
  }
  if (count != kRecoveryWords) return invalid("the sheet has twelve words: give all of them, in their order");
  for (std::size_t i = 0; i < 8 * kRecoveryBytes; ++i)
    if (given[i]) bits[i / 8] |= std::byte{1} << (7 - i % 8);
  const Sha256 digest = sha256(bits);
  for (std::size_t i = 0; i < given.size(); ++i)
    if (given[i] != bit_of(bits, digest, i))
      return invalid("the words do not hang together: one is wrong, or out of its place");
  return bits;
}

Result<SecretKey> recovery_secret(std::string_view words) {
  RELIEVO_TRY_ASSIGN(auto bits, bits_of(words));
  RELIEVO_TRY_ASSIGN(auto secret, SecretKey::make());
  crypto_generichash(raw(secret.bytes()), SecretKey::kBytes, raw(bits), bits.size(),
                     reinterpret_cast<const unsigned char*>(kPurpose.data()), kPurpose.size());
  sodium_memzero(bits.data(), bits.size());
  return secret;
}

RecoveryPublic recovery_public(const SecretKey& secret) {
  RecoveryPublic half{};
  crypto_scalarmult_base(raw(half), raw(secret.bytes()));
  return half;
}

std::vector<std::byte> seal_for(const RecoveryPublic& recipient, const SecretKey& key) {
  std::vector<std::byte> sealed(crypto_box_SEALBYTES + SecretKey::kBytes);
  crypto_box_seal(raw(sealed), raw(key.bytes()), SecretKey::kBytes, raw(recipient));
  return sealed;
}

Result<void> open_recovered(const SecretKey& secret, std::span<const std::byte> sealed, SecretKey& key) {
  const RecoveryPublic half = recovery_public(secret);
  if (sealed.size() != crypto_box_SEALBYTES + SecretKey::kBytes ||
      crypto_box_seal_open(raw(key.bytes()), raw(sealed), sealed.size(), raw(half), raw(secret.bytes())) != 0)
    return Error{Errc::StoreCorrupt, "these words do not open this store: take the newest sheet"};
  return {};
}

}  // namespace relievo::storage
