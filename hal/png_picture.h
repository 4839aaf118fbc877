// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hal/picture_file.h"

namespace relievo::hal {

// bytes: a PNG whose header passed read_picture_header(). Grey stays what it is; colour becomes 8 bit, as no
// stage looks at deeper colour; transparency is dropped. Errors: InvalidInput, OutOfMemory. Thread: any.
Result<Picture> decode_png(std::span<const std::byte> bytes);

}  // namespace relievo::hal
