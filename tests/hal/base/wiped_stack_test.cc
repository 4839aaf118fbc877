// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/base/wiped_text.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <thread>

#include "hal/base/thread_pool.h"

namespace relievo {
namespace {

// Whole words, not bytes: an address that a sleeping thread keeps on its stack may well hold one byte of any
// value.
constexpr std::uint64_t kSecret = 0x5AC3'96E1'7B2D'48F0;
constexpr std::size_t kWords = std::size_t{8} << 10;

[[gnu::noinline]] std::uintptr_t leave_a_secret() {
  std::array<std::uint64_t, kWords> secret;
  secret.fill(kSecret);
  volatile auto address = reinterpret_cast<std::uintptr_t>(secret.data());
  asm volatile("" ::: "memory");  // written, though nobody reads it
  return address;
}

[[gnu::noinline]] std::size_t secrets_at(std::uintptr_t address) {
  const auto* at = reinterpret_cast<const volatile std::uint64_t*>(address);
  std::size_t count = 0;
  for (std::size_t i = 0; i < kWords; ++i) count += at[i] == kSecret ? 1 : 0;
  return count;
}

TEST(WipedStack, NothingIsLeftOfAFunctionThatReturned) {
#ifdef RELIEVO_SANITIZED
  GTEST_SKIP() << "a sanitizer forbids looking at what is below the stack";
#endif
  const std::uintptr_t address = leave_a_secret();
  EXPECT_GT(secrets_at(address), kWords - 128) << "there is nothing to wipe: this test shows nothing";
  const std::uintptr_t again = leave_a_secret();
  wipe_stack();
  EXPECT_EQ(secrets_at(again), 0U);
}

TEST(WipedStack, NothingIsLeftOnAThreadOfAPoolThatSleeps) {
#ifdef RELIEVO_SANITIZED
  GTEST_SKIP() << "a sanitizer forbids looking at what is below the stack";
#endif
  ThreadPool pool(2);
  std::array<std::uintptr_t, 2> addresses{};
  std::atomic<int> begun{0}, looked{0};
  std::size_t seen = 0;
  const auto caller = std::this_thread::get_id();
  pool.for_each_band(2, 2, [&](int, int, int) {
    ++begun;
    while (begun < 2) std::this_thread::yield();  // each by a thread of its own
    const bool own = std::this_thread::get_id() == caller;
    const std::uintptr_t address = leave_a_secret();
    if (!own) seen = secrets_at(address);
    addresses[own ? 0 : 1] = address;
    ++looked;
    while (looked < 2) std::this_thread::yield();
  });
  EXPECT_GT(seen, kWords - 128) << "there is nothing to wipe: this test shows nothing";
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (secrets_at(addresses[1]) > 0 && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_EQ(secrets_at(addresses[1]), 0U);
}

}  // namespace
}  // namespace relievo
