// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the appliance's key comes from: the key that opens the store's own (storage/cipher/README.md).
// Errors: NotFound (no key there), InvalidInput (what is there is no key, or others may read it), MediaFull,
// IoFailed, OutOfMemory; each names the file. Thread: one at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "hal/base/result.h"
#include "storage/cipher/seal.h"

namespace relievo::storage {

class KeySource {
 public:
  virtual ~KeySource() = default;
  virtual Result<void> read(SecretKey& key) = 0;
  // A key is changed in two steps, so that a power cut leaves one that opens the store: the next lies beside
  // the one in use until the store goes by it, then takes its place. On the disk when each returns.
  // Unsupported: this source only reads. InvalidInput: what is there is no key, and would be replaced.
  virtual Result<void> make_next(SecretKey& key) = 0;  // drawn
  virtual Result<void> read_next(SecretKey& key) = 0;
  virtual Result<void> take_next() = 0;
  // It lies apart from the store, and may be another's.
  virtual bool is_apart() const { return false; }
  // What it protects against and what not, in a sentence for whoever sets up the device.
  virtual std::string_view protects() const = 0;
};

// What a key that is made anew is: as text, sealed by the board's TPM (seal_by_tpm()), or as the one it
// follows; the first one of a store, beside it, is sealed where the board has a TPM.
enum class NextKey : std::uint8_t { Plain, SealedByTpm, AsBefore };

// A file of key_text() or of what the TPM sealed, 0600; the next one is FILE.next. One that others may read
// is refused. `beside_the_store`: whoever takes the store takes it along. `owner_of`: whose owner may read a
// key that root makes; empty: beside the store its folder's, else that of the key it follows. Errors further:
// those of open_by_tpm().
std::unique_ptr<KeySource> key_file(std::filesystem::path file, bool beside_the_store = true,
                                    NextKey next = NextKey::Plain, std::filesystem::path owner_of = {});
bool is_key_sealed_by_tpm(const std::filesystem::path& file);

// A systemd credential: a file in $CREDENTIALS_DIRECTORY, which systemd decrypted (systemd.exec(5)). Its
// maker is the operator.
std::unique_ptr<KeySource> key_credential(std::filesystem::path file);

// A key sealed by this board's TPM 2.0: what seal_by_tpm() returns can be opened by that chip alone, until it
// is cleared. It is a keyed-hash object under the storage primary key that the chip makes anew from its
// owner's seed each time (the TCG's template, ECC P-256): nothing is kept in the chip. What passes on the
// wire to it is encrypted.
//
// Which TPM: TPM2TOOLS_TCTI, as tpm2-tools have it (`none`: none at all), else the device /dev/tpmrm0.
// Errors: IoFailed (no TPM answers, or it refuses: its number is named), InvalidInput (sealed by another TPM,
// or by this one before it was cleared; changed since), OutOfMemory. Thread: one at a time.

// Whether this program has one to go to; it may still not answer.
bool tpm_is_there();

Result<std::vector<std::byte>> seal_by_tpm(const SecretKey& key);
bool is_sealed_by_tpm(std::span<const std::byte> bytes);
Result<void> open_by_tpm(std::span<const std::byte> sealed, SecretKey& key);

inline constexpr std::size_t kMostSealedByTpm = 1024;

}  // namespace relievo::storage
