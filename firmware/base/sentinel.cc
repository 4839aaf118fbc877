// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/base/sentinel.h"

#include <pthread.h>
#include <unistd.h>

#include <cstdlib>
#include <string_view>
#include <utility>

#include "firmware/base/budget.h"

namespace relievo::firmware {

Sentinel::Sentinel(const hal::Clock& clock, std::function<void()> hangs)
    : clock_(clock), hangs_(std::move(hangs)), thread_([this] { watch(); }) {}

Sentinel::~Sentinel() {
  ends_.store(true);
  thread_.join();
}

// Asks for no memory and no lock: the thread that hangs may hold both. The screen's library gives the
// console's keyboard back when a program aborts.
void Sentinel::end_program() {
  constexpr std::string_view kWhy = "relievo: the program hangs: it ends, to be started anew\n";
  (void)!::write(STDERR_FILENO, kWhy.data(), kWhy.size());
  std::abort();
}

void Sentinel::watch() {
  pthread_setname_np(pthread_self(), "sentinel");
  hal::Instant::rep told = 0;
  while (!ends_.load()) {
    std::this_thread::sleep_for(budget::kTick);
    const hal::Instant::rep kicked = kicked_.load(std::memory_order_relaxed);
    const hal::Instant last{hal::Instant::duration(kicked)};
    if (kicked == told || clock_.now() - last < budget::kHangLimit) continue;
    told = kicked;
    hangs_();
  }
}

}  // namespace relievo::firmware
