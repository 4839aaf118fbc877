// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/base/core_dumps.h"

#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <string>

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

}  // namespace relievo::firmware
