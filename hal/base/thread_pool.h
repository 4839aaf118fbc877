// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// ThreadPool: a fixed set of threads, made at boot. for_each_band() cuts [0, count) into bands and
// calls the work once per band; it returns when all are done. The bands depend on `count` and
// `bands` only, never on the number of threads, so results do not either.
// Errors: the first exception thrown inside a band is rethrown in the caller.
// Thread: one caller at a time (the worker).
#pragma once

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace relievo {

class ThreadPool {
 public:
  // `threads` counts the caller: 1 makes no thread at all.
  explicit ThreadPool(int threads);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  int size() const { return static_cast<int>(threads_.size()) + 1; }

  using Band = std::function<void(int begin, int end, int band)>;
  void for_each_band(int count, int bands, const Band& work);

 private:
  void serve();
  void work_off(std::unique_lock<std::mutex>& lock);

  std::mutex mutex_;
  std::condition_variable wake_;
  std::condition_variable done_;
  const Band* work_ = nullptr;
  int count_ = 0;
  int bands_ = 0;
  int next_ = 0;
  int open_ = 0;
  bool stopping_ = false;
  std::exception_ptr failure_;
  std::vector<std::thread> threads_;
};

}  // namespace relievo
