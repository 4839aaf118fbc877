// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A PIN as it may be kept: salted and stretched by Argon2id (RFC 9106; 19 MiB, two passes, as OWASP's
// password sheet asks for at least). Takes about 40 ms and its memory from the heap.
// Thread: any (the keeper). Errors: OutOfMemory.
#pragma once

#include <string>
#include <string_view>

#include "hal/base/result.h"

namespace relievo::firmware {

Result<std::string> stretched(std::string_view pin);
Result<bool> is_pin_of(std::string_view pin, const std::string& kept);  // false, too, where there is none
void wipe_text(std::string& text);

}  // namespace relievo::firmware
