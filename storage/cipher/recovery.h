// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The recovery words: twelve words on paper that open a store whose appliance's key is lost. 128 drawn bits
// and a checksum of 4, as BIP-39 has them, of its English list (Debian's python3-mnemonic, read when this
// program is built).
//
//   words ──► secret key of X25519 ──► opens what was sealed for its public half (libsodium, crypto_box_seal)
//
// The store keeps the public half alone: its key can be changed without the paper.
// Errors: InvalidInput says which word is none of the list, or that the words do not hang together;
// StoreCorrupt (it was not sealed for these words). Thread: any.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hal/base/result.h"
#include "storage/cipher/seal.h"

namespace relievo::storage {

inline constexpr std::size_t kRecoveryWords = 12, kRecoveryBytes = 16;
using RecoveryBits = std::array<std::byte, kRecoveryBytes>;
using RecoveryPublic = std::array<std::byte, 32>;

std::string draw_recovery_words();  // with one space between them
// Which two of them show that they were written down: one of either half, from 0.
std::array<std::size_t, 2> words_to_ask();
std::string words_of(const RecoveryBits& bits);
// Capitals and white space are as one likes.
Result<RecoveryBits> bits_of(std::string_view words);

Result<SecretKey> recovery_secret(std::string_view words);
RecoveryPublic recovery_public(const SecretKey& secret);
std::vector<std::byte> seal_for(const RecoveryPublic& recipient, const SecretKey& key);
Result<void> open_recovered(const SecretKey& secret, std::span<const std::byte> sealed, SecretKey& key);

// The list, one word a line; made by CMake.
std::string_view recovery_word_list();

}  // namespace relievo::storage
