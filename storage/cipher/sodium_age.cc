// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <sodium.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <string>

#include "storage/byte_order.h"
#include "storage/cipher/age.h"
#include "storage/text.h"

namespace relievo::storage {
namespace {

constexpr std::string_view kVersion = "age-encryption.org/v1\n", kX25519 = "age-encryption.org/v1/X25519",
                           kScrypt = "age-encryption.org/v1/scrypt";
constexpr std::size_t kFileKeyBytes = 16, kSaltBytes = 16, kTagBytes = 16, kPieceBytes = 64 * 1024,
                      kColumns = 64, kMostHeaderBytes = 64 * 1024;
constexpr int kWorkFactor = 17, kMostWorkFactor = 20;  // scrypt's N is two to this power
constexpr int kNoPadding = sodium_base64_VARIANT_ORIGINAL_NO_PADDING;

Error no_age_file() { return invalid("this is no sealed file of age, or it was changed or cut"); }

std::string base64(std::span<const std::byte> bytes) {
  std::string text(sodium_base64_encoded_len(bytes.size(), kNoPadding), '\0');
  sodium_bin2base64(text.data(), text.size(), raw(bytes), bytes.size(), kNoPadding);
  text.pop_back();  // its zero
  return text;
}

// Exactly that many bytes, or nothing.
bool from_base64(std::string_view text, std::span<std::byte> bytes) {
  std::size_t size = 0;
  const char* end = nullptr;
  return sodium_base642bin(raw(bytes), bytes.size(), text.data(), text.size(), nullptr, &size, &end,
                           kNoPadding) == 0 &&
         size == bytes.size() && end == text.data() + text.size();
}

// HMAC-SHA256 of several parts.
template <typename... Parts>
void hmac(std::span<const std::byte> key, std::span<std::byte> out, const Parts&... parts) {
  crypto_auth_hmacsha256_state state;
  crypto_auth_hmacsha256_init(&state, raw(key), key.size());
  (crypto_auth_hmacsha256_update(&state, raw(parts), parts.size()), ...);
  crypto_auth_hmacsha256_final(&state, raw(out));
  sodium_memzero(&state, sizeof state);
}

// HKDF-SHA256 (RFC 5869), whose first block is as long as a key.
void derive(std::span<const std::byte> from, std::span<const std::byte> salt, std::string_view info,
            SecretKey& key) {
  std::array<std::byte, 32> extracted{};
  hmac(salt, extracted, from);
  constexpr std::array kFirst{std::byte{1}};
  hmac(extracted, key.bytes(), bytes_of(info), kFirst);
  sodium_memzero(extracted.data(), extracted.size());
}

using Nonce = std::array<std::byte, 12>;

// A key wrapped for one use is wrapped under a nonce of zeros.
std::vector<std::byte> wrap(const SecretKey& with, std::span<const std::byte> file_key) {
  std::vector<std::byte> wrapped(kFileKeyBytes + kTagBytes);
  const Nonce zeros{};
  crypto_aead_chacha20poly1305_ietf_encrypt(raw(wrapped), nullptr, raw(file_key), kFileKeyBytes, nullptr, 0,
                                            nullptr, raw(zeros), raw(with.bytes()));
  return wrapped;
}

bool unwrap_key(const SecretKey& with, std::span<const std::byte> wrapped, std::span<std::byte> file_key) {
  const Nonce zeros{};
  return crypto_aead_chacha20poly1305_ietf_decrypt(raw(file_key), nullptr, nullptr, raw(wrapped),
                                                   wrapped.size(), nullptr, 0, raw(zeros),
                                                   raw(with.bytes())) == 0;
}

// The secret of two who know one half each; nothing where the other half is a weak one.
bool agree(const SecretKey& secret, std::span<const std::byte> theirs, std::span<const std::byte> share,
           std::span<const std::byte> recipient, SecretKey& key) {
  std::array<std::byte, 32> shared{};
  if (crypto_scalarmult(raw(shared), raw(secret.bytes()), raw(theirs)) != 0) return false;
  std::vector<std::byte> salt(share.begin(), share.end());
  salt.insert(salt.end(), recipient.begin(), recipient.end());
  derive(shared, salt, kX25519, key);
  sodium_memzero(shared.data(), shared.size());
  return true;
}

Result<void> stretch(std::string_view passphrase, std::span<const std::byte> salt, int work, SecretKey& key) {
  std::vector<std::byte> labelled(bytes_of(kScrypt).begin(), bytes_of(kScrypt).end());
  labelled.insert(labelled.end(), salt.begin(), salt.end());
  if (crypto_pwhash_scryptsalsa208sha256_ll(
          reinterpret_cast<const unsigned char*>(passphrase.data()), passphrase.size(), raw(labelled),
          labelled.size(), std::uint64_t{1} << work, 8, 1, raw(key.bytes()), SecretKey::kBytes) != 0)
    return Error{Errc::OutOfMemory, "not enough memory for a passphrase: close other programs"};
  return {};
}

Nonce nonce_of(std::uint64_t piece, bool last) {
  Nonce nonce{};
  for (std::size_t i = 0; i < 8; ++i) nonce[10 - i] = std::byte(static_cast<unsigned char>(piece >> (8 * i)));
  nonce[11] = std::byte{last};
  return nonce;
}

// Bech32 (BIP 173): 32 bytes behind `prefix`. They may be a secret key: they are written to `bytes` alone.
constexpr std::string_view kBech32 = "qpzry9x8gf2tvdw0s3jn54khce6mua7l";

bool bech32(std::string_view prefix, std::string text, std::span<std::byte> bytes) {
  constexpr std::size_t kData = 52, kSum = 6;  // letters of five bits
  const bool capitals = std::ranges::none_of(text, [](char c) { return c >= 'a' && c <= 'z'; });
  if (capitals) std::ranges::transform(text, text.begin(), small_letter);
  if (!text.starts_with(prefix) || text.size() != prefix.size() + 1 + kData + kSum ||
      text[prefix.size()] != '1')
    return false;
  std::uint32_t sum = 1;
  const auto add = [&sum](std::uint32_t five) {
    constexpr std::array<std::uint32_t, 5> kGenerator{0x3b6a57b2, 0x26508e6d, 0x1ea119fa, 0x3d4233dd,
                                                      0x2a1462b3};
    const std::uint32_t top = sum >> 25U;
    sum = (sum & 0x1ffffffU) << 5U ^ five;
    for (std::size_t i = 0; i < 5; ++i) sum ^= (top >> i & 1U) != 0 ? kGenerator[i] : 0;
  };
  for (const char c : prefix) add(static_cast<unsigned char>(c) >> 5U);
  add(0);
  for (const char c : prefix) add(static_cast<unsigned char>(c) & 31U);
  std::ranges::fill(bytes, std::byte{0});
  for (std::size_t i = 0; i < kData + kSum; ++i) {
    const std::size_t five = kBech32.find(text[prefix.size() + 1 + i]);
    if (five == std::string_view::npos) return false;
    add(std::uint32_t(five));
    for (std::size_t bit = 0; i < kData && bit < 5; ++bit) {
      const std::size_t at = 5 * i + bit;
      const bool set = (five >> (4 - bit) & 1U) != 0;
      if (at < 256 && set) bytes[at / 8] |= std::byte{1} << (7 - at % 8);
      if (at >= 256 && set) return false;  // padding
    }
  }
  return sum == 1;
}

// One way to the file's key, as its header has it.
struct Stanza {
  std::vector<std::string_view> words;
  std::string body;
};

struct Header {
  std::vector<Stanza> stanzas;
  std::string_view signed_part;  // to the three dashes
  std::array<std::byte, 32> mac{};
  std::size_t bytes = 0;
};

std::optional<Header> read_header(std::string_view text) {
  if (!text.starts_with(kVersion)) return std::nullopt;
  Header header;
  std::size_t at = kVersion.size();
  const auto line = [&]() -> std::optional<std::string_view> {
    const std::size_t end = text.substr(0, kMostHeaderBytes).find('\n', at);
    if (end == std::string_view::npos) return std::nullopt;
    const std::string_view one = text.substr(at, end - at);
    at = end + 1;
    return one;
  };
  for (;;) {
    const std::size_t begin = at;
    const auto first = line();
    if (!first) return std::nullopt;
    if (first->starts_with("--- ")) {
      header.signed_part = text.substr(0, begin + 3);
      header.bytes = at;
      if (!from_base64(first->substr(4), header.mac)) return std::nullopt;
      return header;
    }
    if (!first->starts_with("-> ")) return std::nullopt;
    Stanza& stanza = header.stanzas.emplace_back(Stanza{split(first->substr(3), ' '), {}});
    for (std::size_t length = kColumns; length == kColumns;) {
      const auto more = line();
      if (!more || more->size() > kColumns) return std::nullopt;
      length = more->size();
      stanza.body += *more;
    }
  }
}

// Whether this stanza gives the key to whom `by` is.
Result<bool> file_key_in(const Stanza& stanza, const AgeBy& by, std::span<std::byte> file_key) {
  std::array<std::byte, kFileKeyBytes + kTagBytes> wrapped{};
  RELIEVO_TRY_ASSIGN(auto key, SecretKey::make());
  if (const auto* identity = std::get_if<const SecretKey*>(&by)) {
    AgeRecipient share{}, own{};
    if (stanza.words.size() != 2 || stanza.words[0] != "X25519") return false;
    if (!from_base64(stanza.words[1], share) || !from_base64(stanza.body, wrapped)) return no_age_file();
    crypto_scalarmult_base(raw(own), raw((*identity)->bytes()));
    return agree(**identity, share, share, own, key) && unwrap_key(key, wrapped, file_key);
  }
  std::array<std::byte, kSaltBytes> salt{};
  if (stanza.words.size() != 3 || stanza.words[0] != "scrypt") return false;
  int work = 0;
  const std::string_view factor = stanza.words[2];
  const auto [end, wrong] = std::from_chars(factor.data(), factor.data() + factor.size(), work);
  if (!from_base64(stanza.words[1], salt) || !from_base64(stanza.body, wrapped) || wrong != std::errc() ||
      end != factor.data() + factor.size() || factor[0] == '0' || work < 1)
    return no_age_file();
  if (work > kMostWorkFactor) return invalid("this file's passphrase asks for more work than is done here");
  RELIEVO_TRY(stretch(std::get<Passphrase>(by).text, salt, work, key));
  return unwrap_key(key, wrapped, file_key);
}

Result<void> mac_of(std::span<const std::byte> file_key, std::string_view header, std::span<std::byte> mac) {
  RELIEVO_TRY_ASSIGN(auto key, SecretKey::make());
  constexpr std::array<std::byte, 32> kNoSalt{};
  derive(file_key, kNoSalt, "header", key);
  hmac(key.bytes(), mac, bytes_of(header));
  return {};
}

}  // namespace

Result<AgeRecipient> age_recipient(std::string_view text) {
  AgeRecipient recipient{};
  if (!bech32("age", std::string(text), recipient) || text.starts_with("AGE"))
    return invalid("this is no recipient: it begins with age1 and has 62 letters and figures");
  return recipient;
}

Result<SecretKey> age_identity(std::string_view text) {
  RELIEVO_TRY_ASSIGN(auto key, SecretKey::make());
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find_first_of("\r\n", at), text.size());
    if (bech32("age-secret-key-", std::string(text.substr(at, end - at)), key.bytes())) return key;
    at = end + 1;
  }
  return invalid("there is no key of age in it: a line begins with AGE-SECRET-KEY-1");
}

Result<std::vector<std::byte>> age_seal(const AgeTo& to, std::span<const std::byte> plain) {
  RELIEVO_TRY_ASSIGN(auto file_key, LockedBytes::make(kFileKeyBytes));
  randombytes_buf(file_key.bytes().data(), kFileKeyBytes);
  RELIEVO_TRY_ASSIGN(auto key, SecretKey::make());
  std::string header(kVersion);
  if (const auto* recipient = std::get_if<AgeRecipient>(&to)) {
    RELIEVO_TRY_ASSIGN(auto once, SecretKey::make());
    once.draw();
    AgeRecipient share{};
    crypto_scalarmult_base(raw(share), raw(once.bytes()));
    if (!agree(once, *recipient, share, *recipient, key))
      return invalid("nothing can be sealed to this recipient: it is a weak key");
    header += "-> X25519 " + base64(share) + "\n";
  } else {
    std::array<std::byte, kSaltBytes> salt{};
    randombytes_buf(salt.data(), salt.size());
    RELIEVO_TRY(stretch(std::get<Passphrase>(to).text, salt, kWorkFactor, key));
    header += "-> scrypt " + base64(salt) + " " + std::to_string(kWorkFactor) + "\n";
  }
  header += base64(wrap(key, file_key.bytes())) + "\n---";
  std::array<std::byte, 32> mac{};
  RELIEVO_TRY(mac_of(file_key.bytes(), header, mac));
  header += " " + base64(mac) + "\n";

  std::array<std::byte, kSaltBytes> salt{};
  randombytes_buf(salt.data(), salt.size());
  derive(file_key.bytes(), salt, "payload", key);
  std::vector<std::byte> sealed(bytes_of(header).begin(), bytes_of(header).end());
  sealed.insert(sealed.end(), salt.begin(), salt.end());
  const std::size_t pieces = std::max<std::size_t>(1, (plain.size() + kPieceBytes - 1) / kPieceBytes);
  std::size_t at = sealed.size();
  sealed.resize(at + plain.size() + pieces * kTagBytes);
  for (std::size_t i = 0; i < pieces; ++i) {
    const auto piece = plain.subspan(i * kPieceBytes, std::min(kPieceBytes, plain.size() - i * kPieceBytes));
    const Nonce nonce = nonce_of(i, i + 1 == pieces);
    crypto_aead_chacha20poly1305_ietf_encrypt(raw(std::span(sealed).subspan(at)), nullptr, raw(piece),
                                              piece.size(), nullptr, 0, nullptr, raw(nonce),
                                              raw(key.bytes()));
    at += piece.size() + kTagBytes;
  }
  return sealed;
}

Result<std::vector<std::byte>> age_open(const AgeBy& by, std::span<const std::byte> sealed) {
  const auto header = read_header({reinterpret_cast<const char*>(sealed.data()), sealed.size()});
  if (!header || sealed.size() < header->bytes + kSaltBytes + kTagBytes) return no_age_file();
  RELIEVO_TRY_ASSIGN(auto file_key, LockedBytes::make(kFileKeyBytes));
  bool found = false;
  for (std::size_t i = 0; i < header->stanzas.size() && !found; ++i) {
    // A passphrase stands alone.
    if (header->stanzas[i].words[0] == "scrypt" && header->stanzas.size() != 1) return no_age_file();
    RELIEVO_TRY_ASSIGN(found, file_key_in(header->stanzas[i], by, file_key.bytes()));
  }
  if (!found) return invalid("this file was sealed to another key or passphrase");
  std::array<std::byte, 32> mac{};
  RELIEVO_TRY(mac_of(file_key.bytes(), header->signed_part, mac));
  if (sodium_memcmp(mac.data(), header->mac.data(), mac.size()) != 0) return no_age_file();

  RELIEVO_TRY_ASSIGN(auto key, SecretKey::make());
  auto rest = sealed.subspan(header->bytes);
  derive(file_key.bytes(), rest.first(kSaltBytes), "payload", key);
  rest = rest.subspan(kSaltBytes);
  constexpr std::size_t kSealedPiece = kPieceBytes + kTagBytes;
  std::vector<std::byte> plain(rest.size());
  std::size_t at = 0;
  for (std::uint64_t i = 0;; ++i) {
    const bool last = rest.size() <= kSealedPiece;
    const auto piece = rest.first(std::min(rest.size(), kSealedPiece));
    const Nonce nonce = nonce_of(i, last);
    unsigned long long size = 0;
    // A last piece of nothing is an empty file's only.
    if (piece.size() < kTagBytes || (piece.size() == kTagBytes && i > 0) ||
        crypto_aead_chacha20poly1305_ietf_decrypt(raw(std::span(plain).subspan(at)), &size, nullptr,
                                                  raw(piece), piece.size(), nullptr, 0, raw(nonce),
                                                  raw(key.bytes())) != 0)
      return no_age_file();
    at += size;
    rest = rest.subspan(piece.size());
    if (last) break;
  }
  plain.resize(at);
  return plain;
}

}  // namespace relievo::storage
