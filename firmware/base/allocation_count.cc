// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/base/process_memory.h"

#ifdef RELIEVO_SANITIZED

std::function<long()> relievo::firmware::allocation_count() { return {}; }

#else

#include <cstdlib>
#include <new>

namespace {

thread_local long taken = 0;  // NOLINT: operator new has no other place

void* counted(void* block) {
  ++taken;
  if (block == nullptr) throw std::bad_alloc();
  return block;
}

}  // namespace

// The C++ library's other forms lead to these.
void* operator new(std::size_t bytes) { return counted(std::malloc(bytes == 0 ? 1 : bytes)); }
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  const auto step = std::size_t(alignment);
  return counted(std::aligned_alloc(step, (bytes + step - 1) / step * step));
}
void operator delete(void* block) noexcept { std::free(block); }
void operator delete(void* block, std::size_t) noexcept { std::free(block); }
void operator delete(void* block, std::align_val_t) noexcept { std::free(block); }
void operator delete(void* block, std::size_t, std::align_val_t) noexcept { std::free(block); }

std::function<long()> relievo::firmware::allocation_count() {
  return [] { return taken; };
}

#endif
