// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/base/wiped_stack.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace relievo {
namespace {

constexpr unsigned char kSecret = 0x5A;
constexpr std::size_t kBytes = std::size_t{64} << 10;

[[gnu::noinline]] std::uintptr_t leave_a_secret() {
  std::array<unsigned char, kBytes> secret;
  secret.fill(kSecret);
  volatile auto address = reinterpret_cast<std::uintptr_t>(secret.data());
  asm volatile("" ::: "memory");  // written, though nobody reads it
  return address;
}

[[gnu::noinline]] std::size_t secrets_at(std::uintptr_t address) {
  const auto* at = reinterpret_cast<const volatile unsigned char*>(address);
  std::size_t count = 0;
  for (std::size_t i = 0; i < kBytes; ++i) count += at[i] == kSecret ? 1 : 0;
  return count;
}

TEST(WipedStack, NothingIsLeftOfAFunctionThatReturned) {
#ifdef RELIEVO_SANITIZED
  GTEST_SKIP() << "a sanitizer forbids looking at what is below the stack";
#endif
  const std::uintptr_t address = leave_a_secret();
  EXPECT_GT(secrets_at(address), kBytes - 1024) << "there is nothing to wipe: this test shows nothing";
  const std::uintptr_t again = leave_a_secret();
  wipe_stack();
  EXPECT_EQ(secrets_at(again), 0U);
}

}  // namespace
}  // namespace relievo
