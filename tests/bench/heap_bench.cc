// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What wiping costs (firmware/base/wiping_heap.cc): a block taken, written and given back, by the program's
// free() and by the C library's. Of blocks that are written once, as most are: the ratio is of the whole.
#include <string.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>

extern "C" void __libc_free(void*);  // NOLINT(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)

namespace {

constexpr std::size_t kTogether = 64;

template <typename Free>
double ns_a_block(std::size_t bytes, Free give_back) {
  const std::size_t rounds = std::max<std::size_t>(20, (std::size_t{64} << 20) / (bytes * kTogether));
  double best = 1e30;
  for (int again = 0; again < 7; ++again) {
    const auto begin = std::chrono::steady_clock::now();
    for (std::size_t r = 0; r < rounds; ++r) {
      std::array<void*, kTogether> blocks;
      for (void*& block : blocks) {
        block = std::malloc(bytes);
        if (block == nullptr) std::abort();
        memset(block, 0x5A, bytes);
        asm volatile("" ::"r"(block) : "memory");  // written, though nobody reads it
      }
      for (void* block : blocks) give_back(block);
    }
    const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - begin;
    best = std::min(best, took.count() / static_cast<double>(rounds * kTogether));
  }
  return best;
}

}  // namespace

int main() {
  std::printf("%10s %14s %14s %8s\n", "bytes", "wiped, ns", "not wiped, ns", "ratio");
  for (const std::size_t bytes : {32UL, 256UL, 1024UL, 16'384UL, 131'000UL, 4'000'000UL}) {
    const double wiped = ns_a_block(bytes, [](void* block) { std::free(block); });
    const double plain = ns_a_block(bytes, [](void* block) { __libc_free(block); });
    std::printf("%10zu %14.0f %14.0f %8.2f\n", bytes, wiped, plain, wiped / plain);
  }
}
