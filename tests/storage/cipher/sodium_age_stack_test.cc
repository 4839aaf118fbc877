// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The key of a file of age is not left on the stack, also where the file is not opened with it after all.
#include <gtest/gtest.h>
#include <sodium.h>

#include <array>
#include <string>
#include <vector>

#include "hal/base/wiped_text.h"
#include "storage/cipher/age.h"
#include "tests/support/stack_search.h"

namespace relievo::storage {
namespace {

#ifndef RELIEVO_SANITIZED

using relievo::test::call_deep;
using relievo::test::kStackDisguise;
using relievo::test::left_on_stack;

using AgeFileKey = std::array<std::byte, 16>;

AgeFileKey disguised_key() {
  AgeFileKey key{};
  for (std::size_t i = 0; i < key.size(); ++i) key[i] = std::byte(static_cast<unsigned char>(7 + 13 * i));
  return key;
}

AgeFileKey plain_key() {
  AgeFileKey key = disguised_key();
  for (std::byte& byte : key) byte ^= kStackDisguise;
  return key;
}

[[gnu::noinline]] void leave_the_key() {
  const AgeFileKey key = plain_key();
  asm volatile("" : : "r"(key.data()) : "memory");  // written, though nobody reads it
}

template <std::size_t N>
std::string in_base64(const std::array<unsigned char, N>& bytes) {
  constexpr int kVariant = sodium_base64_VARIANT_ORIGINAL_NO_PADDING;
  std::string text(sodium_base64_encoded_len(N, kVariant), '\0');
  sodium_bin2base64(text.data(), text.size(), bytes.data(), N, kVariant);
  text.pop_back();
  return text;
}

// As age has it, with little work, and a wrong sum over its header.
[[gnu::noinline]] std::vector<std::byte> changed_file(const std::string& passphrase) {
  const std::array<unsigned char, 16> salt{};
  const std::string labelled = "age-encryption.org/v1/scrypt" + std::string(salt.size(), '\0');
  std::array<unsigned char, 32> by{}, wrapped{};
  EXPECT_EQ(crypto_pwhash_scryptsalsa208sha256_ll(reinterpret_cast<const unsigned char*>(passphrase.data()),
                                                  passphrase.size(),
                                                  reinterpret_cast<const unsigned char*>(labelled.data()),
                                                  labelled.size(), 2, 8, 1, by.data(), by.size()),
            0);
  const AgeFileKey key = plain_key();
  const std::array<unsigned char, 12> nonce{};
  crypto_aead_chacha20poly1305_ietf_encrypt(wrapped.data(), nullptr,
                                            reinterpret_cast<const unsigned char*>(key.data()), key.size(),
                                            nullptr, 0, nullptr, nonce.data(), by.data());
  const std::string text = "age-encryption.org/v1\n-> scrypt " + in_base64(salt) + " 1\n" +
                           in_base64(wrapped) + "\n--- " + in_base64(std::array<unsigned char, 32>{}) + "\n" +
                           std::string(32, '\0');
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

TEST(AgeStack, TheKeyOfAFileThatWasChangedIsNotLeftOnIt) {
  const AgeFileKey disguised = disguised_key();
  call_deep([] { leave_the_key(); });
  const int left = left_on_stack(disguised);
  EXPECT_GT(left, 0) << "it is not found where it is: this test shows nothing";
  const std::string passphrase = "correct horse";
  const std::vector<std::byte> file = changed_file(passphrase);
  wipe_stack();
  std::string said;
  call_deep([&] {
    const auto opened = age_open(Passphrase{passphrase}, file);
    if (!opened) said = opened.error().what.view();
  });
  const int after = left_on_stack(disguised);
  EXPECT_NE(said.find("changed or cut"), std::string::npos) << said << ": its key was not even found";
  EXPECT_EQ(after, 0);
}

#endif

}  // namespace
}  // namespace relievo::storage
