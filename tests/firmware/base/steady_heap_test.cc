// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RELIEVO_SANITIZED  // sanitizers bring their own heap
#include "firmware/base/process_memory.h"

#include <gtest/gtest.h>
#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <functional>
#include <memory>
#include <new>

#include "tests/memory/usage.h"

namespace relievo::firmware {
namespace {

constexpr std::size_t kMiB = std::size_t{1} << 20;

// In a child: none of it can be taken back. What `work` returns is the number of what was wrong, 0: nothing.
int in_a_child(const std::function<int()>& work) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(work());
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

bool is_there(std::size_t bytes) {
  try {
    return std::make_unique_for_overwrite<std::byte[]>(bytes) != nullptr;
  } catch (const std::bad_alloc&) {
    return false;
  }
}

TEST(SteadyHeap, IsTakenOnceUntouchedAndLargeBlocksComeFromIt) {
  EXPECT_EQ(in_a_child([] {
              const double resident = test::Usage::now().resident_mib;
              if (!take_heap(256 * kMiB)) return 1;
              if (test::Usage::now().resident_mib > resident + 8) return 2;
              const std::size_t heap = mallinfo2().arena;
              const void* const end = ::sbrk(0);
              if (heap < 256 * kMiB) return 3;
              for (int round = 0; round < 3; ++round)
                if (!is_there(100 * kMiB) || mallinfo2().hblks != 0) return 4;
              return ::sbrk(0) == end && mallinfo2().arena == heap ? 0 : 5;
            }),
            0);
}

TEST(SteadyHeap, MemoryPastItsBoundIsRefused) {
  EXPECT_EQ(in_a_child([] {
              if (!take_heap(64 * kMiB) || !bound_memory(32 * kMiB)) return 1;
              if (!is_there(48 * kMiB)) return 2;  // the heap's own
              if (is_there(128 * kMiB)) return 3;
              if (::mmap(nullptr, 64 * kMiB, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) !=
                      MAP_FAILED ||
                  errno != ENOMEM)
                return 4;
              return is_there(48 * kMiB) ? 0 : 5;
            }),
            0);
}

TEST(SteadyHeap, ABoundThatSomebodyElseGaveStays) {
  EXPECT_EQ(in_a_child([] {
              rlimit given{}, after{};
              ::getrlimit(RLIMIT_DATA, &given);
              given.rlim_cur = 512 * kMiB;
              if (::setrlimit(RLIMIT_DATA, &given) != 0 || !bound_memory(4096 * kMiB)) return 1;
              ::getrlimit(RLIMIT_DATA, &after);
              return after.rlim_cur == given.rlim_cur ? 0 : 2;
            }),
            0);
}

}  // namespace
}  // namespace relievo::firmware
#endif
