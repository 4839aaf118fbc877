// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a bundle says of itself, beside its files:
//   manifest.json   whose it is, when it was made and by which version, from which consent; the SHA-256 of
//   each file signature.json  by which key the manifest is signed (Ed25519, over all its bytes), in
//   hexadecimal
// Thread: any. Errors: the store's.
#pragma once

#include <vector>

#include "hal/base/result.h"
#include "storage/export/bundle.h"
#include "storage/store.h"

namespace relievo::firmware {

// Puts both at the end of `files`.
Result<void> add_manifest(storage::Store& store, const storage::Subject& subject,
                          const storage::Enrolment& enrolment, storage::WallTime now,
                          std::vector<storage::BundleFile>& files);

}  // namespace relievo::firmware
