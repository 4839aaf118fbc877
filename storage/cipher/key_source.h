// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the appliance's key comes from: the key that opens the store's own (storage/README.md, "Keys").
// Errors: NotFound (no key there), InvalidInput (what is there is no key, or others may read it), MediaFull,
// IoFailed, OutOfMemory; each names the file. Thread: one at a time.
#pragma once

#include <filesystem>
#include <memory>

#include "hal/base/result.h"
#include "storage/cipher/secret_key.h"

namespace relievo::storage {

class KeySource {
 public:
  virtual ~KeySource() = default;
  virtual Result<void> read(SecretKey& key) = 0;
  // Draws a new key and keeps it, on the disk when this returns. Unsupported: this source only reads.
  virtual Result<void> make(SecretKey& key) = 0;
};

// A file of key_text(), 0600. One that others may read is refused.
std::unique_ptr<KeySource> key_file(std::filesystem::path file);

// A systemd credential: a file in $CREDENTIALS_DIRECTORY, which systemd decrypted (systemd.exec(5)). Its
// maker is the operator.
std::unique_ptr<KeySource> key_credential(std::filesystem::path file);

}  // namespace relievo::storage
