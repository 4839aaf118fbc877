// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One hostile picture: the first bytes are its shape, the rest its content, in a block of exactly its size,
// so that a sanitizer sees every byte read too many; what is written too much is seen in any build. Used by
// tests/fuzz/ and by the smoke test.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "hal/base/assert.h"
#include "hal/raw/develop.h"

namespace relievo::hal {

inline constexpr std::size_t kFuzzHeaderBytes = 8;

// Shape bytes: coding, filter, width and height (less 1, in units of 1 px, up to 256), stride beyond the
// row (-8 to 247), missing bytes at the end, room withheld, scratch withheld.
// Returns whether the picture was developed.
inline bool fuzz_raw(std::span<const std::uint8_t> data) {
  if (data.size() < kFuzzHeaderBytes) return false;
  const std::span<const std::uint8_t> content = data.subspan(kFuzzHeaderBytes);
  std::vector<std::byte> bytes(content.size());
  if (!content.empty()) std::memcpy(bytes.data(), content.data(), content.size());
  RawImage raw;
  raw.format.coding = static_cast<RawCoding>(data[0] % 10);
  raw.format.filter = static_cast<ColourFilter>(data[1] % 5);
  raw.width_px = data[2] + 1;
  raw.height_px = data[3] + 1;
  raw.stride_bytes = static_cast<int>(raw_row_bytes(raw.format.coding, raw.width_px)) + data[4] - 8;
  if (raw.format.coding != RawCoding::Mjpeg && raw.stride_bytes > 0) {
    // As much content as the shape wants, less what is missing: short pictures are as likely as whole ones.
    const std::size_t whole = raw_whole_bytes(raw);
    bytes.resize(whole > data[5] / 16U ? whole - data[5] / 16U : 0);
  }
  raw.bytes = bytes.data();
  raw.size_bytes = bytes.size();
  const std::size_t pixels = static_cast<std::size_t>(raw.width_px) * static_cast<std::size_t>(raw.height_px);
  // One block: whoever writes past the room or the scratch changes a guard.
  constexpr std::size_t kGuard = 64;
  constexpr std::byte kUntouched{0xA5};
  const std::size_t room_bytes = 3 * pixels - std::min<std::size_t>(pixels, data[6] / 32U);
  const std::size_t scratch_bytes = pixels - std::min<std::size_t>(pixels, data[7] / 32U);
  std::vector<std::byte> block(room_bytes + scratch_bytes + 3 * kGuard, kUntouched);
  const std::span<std::byte> all(block), room = all.subspan(kGuard, room_bytes),
                                         scratch = all.subspan(2 * kGuard + room_bytes, scratch_bytes);
  const auto view = develop(raw, room, scratch);
  for (const auto guard : {all.first(kGuard), all.subspan(kGuard + room_bytes, kGuard), all.last(kGuard)})
    RELIEVO_ASSERT(std::all_of(guard.begin(), guard.end(), [](std::byte b) { return b == kUntouched; }));
  if (!view) return false;
  // What is promised of a developed picture holds for every input.
  RELIEVO_ASSERT(view->width_px == raw.width_px && view->height_px == raw.height_px &&
                 view->bytes == room.data());
  RELIEVO_ASSERT(view->stride_bytes == view->width_px * bytes_per_pixel(view->format));
  RELIEVO_ASSERT(static_cast<std::size_t>(view->stride_bytes) * static_cast<std::size_t>(view->height_px) <=
                 room.size());
  return true;
}

}  // namespace relievo::hal
