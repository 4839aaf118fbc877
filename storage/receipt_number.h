// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The number in the code a person quotes for their erasure: twelve digits, drawn by the system's generator
// for keys, so that who knows some knows nothing of another. Thread: any. Errors: none.
#pragma once

#include <cstdint>

namespace relievo::storage {

inline constexpr std::int64_t kLeastReceipt = 1, kMostReceipt = 999'999'999'999;

std::int64_t draw_receipt();

}  // namespace relievo::storage
