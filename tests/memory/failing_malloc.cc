// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/memory/failing_malloc.h"

#include <execinfo.h>
#include <pthread.h>

#include <atomic>
#include <cerrno>
#include <cstddef>

namespace relievo::test {
namespace {

thread_local int exempt = 0;  // NOLINT: malloc has no other place
std::atomic<long> counted{0}, first{0}, last{0};
std::atomic<bool> refused{false};
char name[16];
void* stack[24];
int depth = 0;

bool refuses() {
  if (exempt > 0) return false;
  const long number = counted.fetch_add(1, std::memory_order_relaxed) + 1;
  const long from = first.load(std::memory_order_relaxed);
  if (from == 0 || number < from || number > last.load(std::memory_order_relaxed)) return false;
  if (!refused.exchange(true)) {
    ++exempt;
    pthread_getname_np(pthread_self(), name, sizeof name);
    depth = backtrace(stack, 24);
    --exempt;
  }
  errno = ENOMEM;
  return true;
}

}  // namespace

Exempt::Exempt() { ++exempt; }
Exempt::~Exempt() { --exempt; }
Counted::Counted() : before_(exempt) { exempt = 0; }
Counted::~Counted() { exempt = before_; }

void refuse_allocation(long number, long refusals) {
  first = 0;
  counted = 0;
  refused = false;
  last = number + refusals - 1;
  first = number;
}
long allocations_counted() { return counted; }
bool was_refused() { return refused; }
const char* refused_thread() { return name; }
void print_refused_stack(int file) { backtrace_symbols_fd(stack, depth, file); }

}  // namespace relievo::test

// The program's own malloc goes before the C library's; free() stays the C library's.
extern "C" {
// NOLINTBEGIN(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
// NOLINTEND(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)

using relievo::test::refuses;
void* malloc(std::size_t bytes) { return refuses() ? nullptr : __libc_malloc(bytes); }
void* calloc(std::size_t count, std::size_t bytes) {
  return refuses() ? nullptr : __libc_calloc(count, bytes);
}
void* realloc(void* block, std::size_t bytes) { return refuses() ? nullptr : __libc_realloc(block, bytes); }
void* memalign(std::size_t alignment, std::size_t bytes) {
  return refuses() ? nullptr : __libc_memalign(alignment, bytes);
}
void* aligned_alloc(std::size_t alignment, std::size_t bytes) { return memalign(alignment, bytes); }
int posix_memalign(void** block, std::size_t alignment, std::size_t bytes) {
  *block = memalign(alignment, bytes);
  return *block == nullptr ? ENOMEM : 0;
}
}
