// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// FrozenThread: stops a thread of this process where it stands, by a signal whose handler does not return:
// as a driver's call that never comes back. One name at a time.
#pragma once

#include <csignal>
#include <ctime>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include <sys/syscall.h>
#include <unistd.h>

namespace relievo::test {

class FrozenThread {
 public:
  // Freezes the thread that has this name, and those that libraries started from it, which have it, too. Is
  // there one?
  static bool freeze(std::string_view name) {
    std::signal(SIGUSR1, stand);
    bool found = false;
    for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
      std::string its;
      std::getline(std::ifstream(task.path() / "comm") >> std::ws, its);
      if (its != name) continue;
      frozen.store(true);
      found |= syscall(SYS_tgkill, getpid(), std::stoi(task.path().filename()), SIGUSR1) == 0;
    }
    return found;
  }
  static void thaw() { frozen.store(false); }

 private:
  static inline std::atomic<bool> frozen{false};
  static void stand(int) {
    const timespec moment{0, 1'000'000};
    while (frozen.load()) nanosleep(&moment, nullptr);
  }
};

}  // namespace relievo::test
