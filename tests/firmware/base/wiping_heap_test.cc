// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What lies in a block that was given back (firmware/base/wiping_heap.cc is linked into this program). The
// C library's own free() is the control: what it leaves must be seen, else nothing is shown.
#include <gtest/gtest.h>
#include <malloc.h>
#include <string.h>

#include <cstdint>
#include <cstdlib>

extern "C" void __libc_free(void*);  // NOLINT(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)

namespace relievo::firmware {
namespace {

constexpr unsigned char kSecret = 0x5A;
constexpr std::size_t kLists = 32;  // the C library keeps its lists at the beginning of a free block

// Of what is free: the compiler must not know it for the block that was.
std::size_t secrets_at(std::uintptr_t address, std::size_t bytes) {
  volatile std::uintptr_t hidden = address;
  const auto* at = reinterpret_cast<const volatile unsigned char*>(hidden);
  std::size_t count = 0;
  for (std::size_t i = 0; i < bytes; ++i) count += at[i] == kSecret ? 1 : 0;
  return count;
}

class WipingHeap : public testing::TestWithParam<std::size_t> {
 protected:
  void SetUp() override {
#ifdef RELIEVO_SANITIZED
    GTEST_SKIP() << "a sanitizer has its own heap, which forbids looking at what is free";
#endif
    block = std::malloc(GetParam());
    fence = std::malloc(64);  // the end of the heap is not given back to the system
    ASSERT_NE(block, nullptr);
    usable = malloc_usable_size(block);
    memset(block, kSecret, usable);
    address = reinterpret_cast<std::uintptr_t>(block);
    asm volatile("" ::: "memory");  // written, though nobody reads it before it is freed
  }
  void TearDown() override { std::free(fence); }
  std::size_t left() const { return secrets_at(address + kLists, usable - kLists); }

  void* block = nullptr;
  void* fence = nullptr;
  std::uintptr_t address = 0;
  std::size_t usable = 0;
};

TEST_P(WipingHeap, NothingIsLeftInABlockThatWasFreed) {
  std::free(block);
  EXPECT_EQ(left(), 0U);
}

TEST_P(WipingHeap, TheCLibraryLeavesIt) {
  __libc_free(block);
  EXPECT_GT(left(), usable - kLists - 16);
}

TEST_P(WipingHeap, ABlockThatGrewIsWipedWhereItWas) {
  void* grown = std::realloc(block, usable + 1);
  ASSERT_NE(grown, nullptr);
  EXPECT_EQ(secrets_at(reinterpret_cast<std::uintptr_t>(grown), usable), usable);
  ASSERT_NE(reinterpret_cast<std::uintptr_t>(grown), address);
  EXPECT_EQ(left(), 0U);
  std::free(grown);
}

TEST_P(WipingHeap, WhatABlockLostByShrinkingIsWiped) {
  const std::size_t shorter = usable * 3 / 4;
  void* shrunk = std::realloc(block, shorter);
  ASSERT_NE(shrunk, nullptr);
  EXPECT_EQ(secrets_at(reinterpret_cast<std::uintptr_t>(shrunk), shorter), shorter);
  EXPECT_EQ(secrets_at(address + shorter, usable - shorter), 0U);
  std::free(shrunk);
}

INSTANTIATE_TEST_SUITE_P(Sizes, WipingHeap, testing::Values(200, 1000, 60'000));

}  // namespace
}  // namespace relievo::firmware
