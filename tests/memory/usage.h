// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Usage: what this process has of the system now: page faults so far, memory, open files, threads.
#pragma once

#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace relievo::test {

struct Usage {
  long minor = 0, major = 0;
  double resident_mib = 0, in_use_mib = 0;
  std::ptrdiff_t files = 0, threads = 0;
  static Usage now() {
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    std::size_t all = 0, resident = 0;
    std::ifstream("/proc/self/statm") >> all >> resident;
    const auto mib = [](std::size_t bytes) { return static_cast<double>(bytes) / (1 << 20); };
    const auto entries = [](const char* folder) {
      return std::distance(std::filesystem::directory_iterator(folder), {});
    };
    return {used.ru_minflt,
            used.ru_majflt,
            mib(resident * static_cast<std::size_t>(getpagesize())),
            mib(mallinfo2().uordblks),
            entries("/proc/self/fd"),
            entries("/proc/self/task")};
  }
};

}  // namespace relievo::test
