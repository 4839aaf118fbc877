// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/allocation_counter.h"

#include <cerrno>
#include <cstddef>

namespace relievo {
namespace {

thread_local long allocations = 0;  // NOLINT: malloc has no other place

}  // namespace
}  // namespace relievo

#ifndef RELIEVO_SANITIZED
// The program's own malloc goes before the C library's; free() stays the C library's.
extern "C" {
// NOLINTBEGIN(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
// NOLINTEND(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)

void* malloc(std::size_t bytes) {
  ++relievo::allocations;
  return __libc_malloc(bytes);
}
void* calloc(std::size_t count, std::size_t bytes) {
  ++relievo::allocations;
  return __libc_calloc(count, bytes);
}
// A program whose heap wipes has its own (firmware/base/wiping_heap.cc), which asks malloc().
__attribute__((weak)) void* realloc(void* block, std::size_t bytes) {
  ++relievo::allocations;
  return __libc_realloc(block, bytes);
}
void* memalign(std::size_t alignment, std::size_t bytes) {
  ++relievo::allocations;
  return __libc_memalign(alignment, bytes);
}
void* aligned_alloc(std::size_t alignment, std::size_t bytes) { return memalign(alignment, bytes); }
int posix_memalign(void** block, std::size_t alignment, std::size_t bytes) {
  *block = memalign(alignment, bytes);
  return *block == nullptr ? ENOMEM : 0;
}
}
#endif

namespace relievo {

AllocationCounter::AllocationCounter() : at_start_(allocations) {}

bool AllocationCounter::counts() {
#ifdef RELIEVO_SANITIZED
  return false;
#else
  return true;
#endif
}

long AllocationCounter::made() const { return allocations - at_start_; }

}  // namespace relievo
