// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is given back to the heap is wiped: names, codes and models pass through strings, rows and encoders of
// many libraries, and nothing of a visitor may lie in memory that nobody holds any more. The program's own
// free() goes before the C library's. Thread: any.
#include <cstddef>

#if defined(__SANITIZE_ADDRESS__)

#include <cstring>

extern "C" {
// NOLINTBEGIN(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)
std::size_t __sanitizer_get_allocated_size(const volatile void*);
void __sanitizer_free_hook(const volatile void* block) {
  if (block != nullptr) std::memset(const_cast<void*>(block), 0, __sanitizer_get_allocated_size(block));
}
// NOLINTEND(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)
}

#elif !defined(RELIEVO_SANITIZED)

#include <malloc.h>
#include <string.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>

extern "C" {
void __libc_free(void*);  // NOLINT(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)

void free(void* block) {
  if (block == nullptr) return;
  const int error = errno;  // it stays as it was
  explicit_bzero(block, malloc_usable_size(block));
  __libc_free(block);
  errno = error;
}
// The C library's would leave the old block as it is.
void* realloc(void* block, std::size_t bytes) {
  if (block == nullptr) return malloc(bytes);
  if (bytes == 0) {
    free(block);
    return nullptr;
  }
  const std::size_t usable = malloc_usable_size(block);
  if (bytes <= usable && bytes >= usable / 2) {
    explicit_bzero(static_cast<std::byte*>(block) + bytes, usable - bytes);
    return block;
  }
  void* larger = malloc(bytes);
  if (larger == nullptr) return nullptr;
  memcpy(larger, block, std::min(bytes, usable));
  free(block);
  return larger;
}
}

#endif
