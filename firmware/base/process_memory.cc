// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/base/process_memory.h"

#include <malloc.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

namespace relievo::firmware {
namespace {

// A line for each place that is swapped to, below their heading (proc(5)).
bool there_is_swap() {
  std::ifstream places("/proc/swaps");
  std::string line;
  return std::getline(places, line) && std::getline(places, line);
}

// Under a limit a lock may succeed, and memory asked for later be refused: worse than swap.
bool may_lock_all() {
  rlimit limit{};
  return ::geteuid() == 0 || (::getrlimit(RLIMIT_MEMLOCK, &limit) == 0 && limit.rlim_cur == RLIM_INFINITY);
}

}  // namespace

Result<void> keep_out_of_swap() {
  if (may_lock_all() && ::mlockall(MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT) == 0) return {};
  if (!there_is_swap()) return {};
  return Error{Errc::IoFailed,
               "faces and names may come to lie on this machine's swap: allow locked memory "
               "(LimitMEMLOCK=infinity), or switch swap off"};
}

Result<void> forbid_core_dumps(bool measures_itself) {
  const rlimit none{0, 0};
  if (setrlimit(RLIMIT_CORE, &none) != 0 || (!measures_itself && prctl(PR_SET_DUMPABLE, 0, 0, 0, 0) != 0))
    return Error{Errc::IoFailed, "core dumps cannot be switched off: faces and keys would be in them", errno};
  return {};
}

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
