// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Looks for what functions that have returned left on this thread's stack. What is looked for is kept in
// disguise, so that the search does not find its own copy. A sanitizer forbids it. Thread: whose stack it is.
#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace relievo::test {

inline constexpr std::byte kStackDisguise{0xA5};

// So far down that the search, called from the same place, does not lie over what is left.
template <typename Work>
[[gnu::noinline]] void call_deep(const Work& work) {
  std::array<std::byte, std::size_t{8} << 10> above;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  asm volatile("" : : "r"(above.data()) : "memory");
  work();
  asm volatile("" : : "r"(above.data()) : "memory");
}

// How often it is there.
[[gnu::noinline]] inline int left_on_stack(std::span<const std::byte> disguised) {
  constexpr std::size_t kSearched = std::size_t{64} << 10;
  const auto* const top = static_cast<const volatile std::byte*>(__builtin_frame_address(0));
  int count = 0;
  for (const auto* at = top - kSearched; at + disguised.size() < top; ++at) {
    std::size_t same = 0;
    while (same < disguised.size() && (at[same] ^ kStackDisguise) == disguised[same]) ++same;
    count += same == disguised.size() ? 1 : 0;
  }
  return count;
}

}  // namespace relievo::test
