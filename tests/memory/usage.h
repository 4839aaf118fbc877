// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Usage: what this process has of the system now: page faults so far, memory, open files, threads.
#pragma once

#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace relievo::test {

struct Usage {
  long minor = 0, major = 0;
  double resident_mib = 0, in_use_mib = 0;
  std::ptrdiff_t files = 0, threads = 0;
  // The largest free block of the C library's heap, which has one arena: its end, or one in between.
  static double largest_free_mib() {
    char* text = nullptr;
    std::size_t size = 0;
    FILE* const out = open_memstream(&text, &size);
    malloc_info(0, out);
    std::fclose(out);
    std::size_t largest = mallinfo2().keepcost;
    for (const char* to = text; (to = std::strstr(to, " to=\"")) != nullptr; to += 5)
      largest = std::max<std::size_t>(largest, std::strtoull(to + 5, nullptr, 10));
    std::free(text);
    return double(largest) / (1 << 20);
  }
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
