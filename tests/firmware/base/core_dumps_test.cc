// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/base/process_memory.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstddef>
#include <cstdio>
#include <fstream>
#include <string>

namespace relievo::firmware {
namespace {

// In a child: it cannot be taken back.
TEST(CoreDumps, AreForbiddenForGood) {
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    if (!forbid_core_dumps()) ::_exit(1);
    rlimit limit{1, 1};
    if (::getrlimit(RLIMIT_CORE, &limit) != 0 || limit.rlim_cur != 0 || limit.rlim_max != 0) ::_exit(2);
    if (::prctl(PR_GET_DUMPABLE, 0, 0, 0, 0) != 0) ::_exit(3);
    ::signal(SIGSEGV, SIG_DFL);
    ::raise(SIGSEGV);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status)) << WEXITSTATUS(status);
  EXPECT_FALSE(WCOREDUMP(status));
}

// In a child, for the same reason: what is asked for after the lock is locked once it is touched, and what is
// not touched stays no memory.
TEST(Swap, SeesNothingOfWhatComesLater) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer's program locks nothing: it reserves terabytes";
#endif
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    constexpr std::size_t kBytes = std::size_t{64} << 20, kTouched = std::size_t{8} << 20;
    if (::mlockall(MCL_CURRENT | MCL_ONFAULT) != 0) ::_exit(5);
    if (::munlockall() != 0 || !keep_out_of_swap()) ::_exit(1);
    auto* const block = static_cast<std::byte*>(
        ::mmap(nullptr, kBytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
    if (block == MAP_FAILED) ::_exit(2);
    for (std::size_t k = 0; k < kTouched; k += 4096) block[k] = std::byte{1};
    const auto address = reinterpret_cast<unsigned long>(block);
    std::ifstream maps("/proc/self/smaps");
    std::size_t locked_kb = 0;
    bool here = false;
    for (std::string line; std::getline(maps, line);) {
      unsigned long from = 0, to = 0;
      if (std::sscanf(line.c_str(), "%lx-%lx ", &from, &to) == 2) here = from <= address && address < to;
      if (here && line.starts_with("Locked:")) locked_kb = std::stoul(line.substr(7));
    }
    ::_exit(locked_kb >= kTouched / 1024 && locked_kb < kBytes / 1024 ? 0 : 4);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  if (WEXITSTATUS(status) == 5) GTEST_SKIP() << "this user may not lock memory";
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

}  // namespace
}  // namespace relievo::firmware
