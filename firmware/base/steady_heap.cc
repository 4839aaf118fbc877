// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/base/steady_heap.h"

#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <vector>

namespace relievo::firmware {

#ifdef RELIEVO_SANITIZED  // sanitizers bring their own heap, and reserve terabytes

Result<void> take_heap(std::size_t) { return {}; }
Result<void> bound_memory(std::size_t) { return {}; }

#else

Result<void> take_heap(std::size_t bytes) {
  mallopt(M_ARENA_MAX, 1);
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, -1);
  // The heap grows by what does not fit into its end, and by the pad. Small blocks: what is given back is
  // wiped (base/wiping_heap.cc), and so touched.
  using Block = std::unique_ptr<void, decltype(&std::free)>;
  std::vector<Block> blocks;
  for (auto heap = mallinfo2(); heap.arena < bytes; heap = mallinfo2()) {
    mallopt(M_TOP_PAD, int(bytes - heap.arena));
    blocks.emplace_back(std::malloc(heap.keepcost + 1), &std::free);
    if (blocks.back() == nullptr)
      return Error{Errc::OutOfMemory, "this machine has too little memory for the appliance's heap"};
  }
  mallopt(M_TOP_PAD, 1 << 20);
  return {};
}

Result<void> bound_memory(std::size_t more_bytes) {
  std::size_t pages = 0;  // of data and stack, the sixth figure (proc(5))
  std::ifstream file("/proc/self/statm");
  for (int figure = 0; figure < 6; ++figure) file >> pages;
  rlimit limit{};
  if (!file || ::getrlimit(RLIMIT_DATA, &limit) != 0)
    return Error{Errc::IoFailed, "it cannot be told how much memory this process has", errno};
  const rlim_t bytes = rlim_t(pages) * rlim_t(::sysconf(_SC_PAGESIZE)) + more_bytes;
  if (limit.rlim_cur != RLIM_INFINITY && limit.rlim_cur <= bytes) return {};  // somebody gave it less
  limit.rlim_cur = bytes;
  if (::setrlimit(RLIMIT_DATA, &limit) != 0)
    return Error{Errc::IoFailed, "the process's memory cannot be bounded", errno};
  return {};
}

#endif

}  // namespace relievo::firmware
