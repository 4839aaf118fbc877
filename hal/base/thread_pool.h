// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// ThreadPool: a fixed set of threads, made at boot. for_each_band() cuts [0, count) into bands and calls the
// work once per band; it returns when all are done. The bands depend on `count` and `bands` only, never on
// the number of threads, so results do not either. A stage calls it a thousand times for a fraction of a
// millisecond each, and to wake a sleeping thread costs tens of microseconds: who waits looks again for a
// moment (kLooks) before it sleeps. Errors: the first exception thrown inside a band is rethrown in the
// caller. Thread: one caller at a time (the worker).
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <type_traits>
#include <vector>

namespace relievo {

class ThreadPool {
 public:
  // `threads` counts the caller: 1 makes no thread at all.
  explicit ThreadPool(int threads);
  ~ThreadPool();

  int size() const { return int(threads_.size()) + 1; }

  using Band = std::function<void(int begin, int end, int band)>;
  void for_each_band(int count, int bands, const Band& work);
  // work(i), or work(i, band), for each of [0, count). Takes nothing from the heap, however much `work`
  // refers to.
  template <typename Index = int, typename Work>
  void for_each(int count, int bands, const Work& work) {
    for_each_band(count, bands, [&work](int begin, int end, [[maybe_unused]] int band) {
      for (int i = begin; i < end; ++i)
        if constexpr (std::is_invocable_v<const Work&, Index, int>) work(Index(i), band);
        else work(Index(i));
    });
  }

 private:
  void serve();
  // Works bands off until none is left to begin.
  void work_off();
  bool take_band(int& band);
  bool anything_to_begin() const;
  void run_band(int band);

  // The round in the upper half, the bands left to begin in the lower: a band is taken by one exchange, and a
  // thread that comes late finds none left, whatever the next round has already written beside it.
  std::atomic<std::uint64_t> cursor_{0};
  std::atomic<const Band*> work_{nullptr};
  std::atomic<int> count_{0};
  std::atomic<int> bands_{0};
  std::atomic<int> open_{0};
  std::atomic<int> asleep_{0};
  std::atomic<bool> stopping_{false};
  std::mutex mutex_;  // of the sleepers and of failure_
  std::condition_variable wake_;
  std::condition_variable done_;
  std::exception_ptr failure_;
  std::vector<std::thread> threads_;
};

}  // namespace relievo
