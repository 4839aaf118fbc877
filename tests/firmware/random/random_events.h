// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// RandomEvents: what the walks of chance have in common. The events come from a seed; whatever ends the
// walk, seed, step and the last events are printed, so that it can be walked again.
//
//   RELIEVO_RANDOM_SEED=S RELIEVO_RANDOM_EVENTS=N     (toolchain/random_machine)
#pragma once

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <string_view>

namespace relievo::firmware {

class RandomEvents {
 public:
  explicit RandomEvents(std::uint64_t usual_events)
      : seed_(number_of("RELIEVO_RANDOM_SEED", 1)),
        events_(number_of("RELIEVO_RANDOM_EVENTS", usual_events)),
        random_(seed_) {
    now_ = this;
    for (const int signal : {SIGABRT, SIGSEGV, SIGBUS}) ::signal(signal, died);
  }
  ~RandomEvents() {
    if (testing::Test::HasFailure()) say();
    for (const int signal : {SIGABRT, SIGSEGV, SIGBUS}) ::signal(signal, SIG_DFL);
    now_ = nullptr;
  }
  RandomEvents(const RandomEvents&) = delete;
  RandomEvents& operator=(const RandomEvents&) = delete;

  std::uint64_t seed() const { return seed_; }
  std::uint64_t events() const { return events_; }
  std::uint64_t step() const { return step_; }
  // The next step; false: all are done, or something has failed.
  bool go_on() {
    if (step_ >= events_ || testing::Test::HasFailure()) return false;
    ++step_;
    return true;
  }
  // 0 to below - 1.
  int of(int below) { return static_cast<int>(random_() % static_cast<std::uint64_t>(below)); }
  bool one_in(int n) { return of(n) == 0; }
  template <typename Choice, std::size_t N>
  Choice any(const std::array<Choice, N>& of_these) {
    return of_these[static_cast<std::size_t>(of(static_cast<int>(N)))];
  }
  void note(std::string_view event) {
    std::string& line = last_[noted_++ % last_.size()];
    line.assign(event);
  }
  void say() const {
    std::fprintf(stderr, "seed %lu, step %lu; the last events:\n", seed_, step_);
    const std::size_t from = noted_ < last_.size() ? 0 : noted_ - last_.size();
    for (std::size_t i = from; i < noted_; ++i)
      std::fprintf(stderr, "  %s\n", last_[i % last_.size()].c_str());
  }

 private:
  static std::uint64_t number_of(const char* variable, std::uint64_t usual) {
    const char* set = std::getenv(variable);
    return set == nullptr ? usual : std::strtoull(set, nullptr, 10);
  }
  // Not all of it may be called in a signal's handler: the process is at its end anyway.
  static void died(int signal) {
    ::signal(signal, SIG_DFL);
    if (now_ != nullptr) now_->say();
    ::raise(signal);
  }
  static inline const RandomEvents* now_ = nullptr;

  std::uint64_t seed_, events_, step_ = 0;
  std::mt19937_64 random_;
  std::array<std::string, 60> last_;
  std::size_t noted_ = 0;
};

}  // namespace relievo::firmware
