// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files in one: a tar archive (POSIX ustar), made in memory. Whoever it is for unpacks it with `tar`.
// Errors: OutOfMemory, InvalidInput (a name too long for it). May throw std::bad_alloc. Thread: any.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hal/base/result.h"

namespace relievo::storage {

struct BundleFile {
  std::string name;
  std::vector<std::byte> bytes;
};

Result<std::vector<std::byte>> bundle_bytes(std::span<const BundleFile> files);
// Only exactly what bundle_bytes() makes is taken: plain files with plain names, and not a byte more or less.
// InvalidInput says what else there is.
Result<std::vector<BundleFile>> bundle_files(std::span<const std::byte> tar);

// A name in one folder: no way elsewhere.
bool is_plain_name(std::string_view name);

}  // namespace relievo::storage
