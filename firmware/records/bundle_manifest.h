// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What an exported copy of a person says of itself, beside its files:
//   person.record   all the store has of them, for another store (storage/record.h)
//   manifest.json   whose it is, when it was made and by which version, from which consent; the SHA-256 of
//                   each; the number by which the operator may offer the portrait (link_number_of)
//   signature.json  by which key the manifest is signed (Ed25519, over all its bytes), in hexadecimal
// A copy is a folder, a tar of it (storage/export/bundle.h), or that tar sealed (storage/cipher/age.h).
// Thread: any. Errors: the store's, the disk's.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "hal/base/result.h"
#include "storage/export/bundle.h"
#include "storage/sodium_sha256.h"
#include "storage/store.h"

namespace relievo::firmware {

using Sums = std::map<std::string, storage::Sha256>;  // of files, by their names

// Whose copy it is, and when it is made.
struct CopyOf {
  const storage::Subject& subject;
  const storage::Enrolment& enrolment;  // the one the files show
  storage::WallTime now;
};

// The three above, for files of these sums.
Result<std::vector<storage::BundleFile>> manifest_files(storage::Store& store, const CopyOf& of, Sums sums);
// Beside the files that are in the folder. An error names `place`, as that of write_text().
Result<void> write_manifest(storage::Store& store, const CopyOf& of, const std::filesystem::path& folder,
                            const std::filesystem::path& place);
// Before the copy leaves: no portrait is out of the store of which the store's log does not tell.
Result<void> log_export(storage::Store& store, const CopyOf& of);
Result<Sums> sums_of(const std::filesystem::path& folder);  // of every file in it

using SigningKey = std::array<std::byte, 32>;  // the public half of Ed25519
std::string text_of(const SigningKey& key);    // in hexadecimal

// Every file is what the manifest says, nothing is missing or added; returns who signed it. InvalidInput.
Result<SigningKey> check_bundle(std::span<const storage::BundleFile> files);

// A copy that was unpacked. InvalidInput: what is in it is no plain file, or too large.
Result<std::vector<storage::BundleFile>> read_bundle_folder(const std::filesystem::path& folder);

}  // namespace relievo::firmware
