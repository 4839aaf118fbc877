// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <sodium.h>

#include "storage/receipt_number.h"

namespace relievo::storage {

// What is beyond the last whole multiple of the range is drawn again: every number is as likely as every
// other.
std::int64_t draw_receipt() {
  constexpr auto kRange = std::uint64_t(kMostReceipt - kLeastReceipt + 1);
  constexpr std::uint64_t kEnd = UINT64_MAX - UINT64_MAX % kRange;
  std::uint64_t drawn = 0;
  do randombytes_buf(&drawn, sizeof drawn);
  while (drawn >= kEnd);
  return kLeastReceipt + std::int64_t(drawn % kRange);
}

}  // namespace relievo::storage
