// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/base/thread_pool.h"

namespace relievo {

ThreadPool::ThreadPool(int threads) {
  for (int i = 1; i < threads; ++i) threads_.emplace_back([this] { serve(); });
}

ThreadPool::~ThreadPool() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void ThreadPool::for_each_band(int count, int bands, const Band& work) {
  if (count <= 0) return;
  std::unique_lock lock(mutex_);
  work_ = &work;
  count_ = count;
  bands_ = bands < 1 ? 1 : (bands > count ? count : bands);
  next_ = 0;
  open_ = bands_;
  failure_ = nullptr;
  wake_.notify_all();
  work_off(lock);
  done_.wait(lock, [this] { return open_ == 0; });
  work_ = nullptr;
  if (failure_) std::rethrow_exception(failure_);
}

void ThreadPool::work_off(std::unique_lock<std::mutex>& lock) {
  while (work_ != nullptr && next_ < bands_) {
    const int band = next_++;
    const Band& work = *work_;
    const auto edge = [this](int k) {
      return static_cast<int>(static_cast<long long>(count_) * k / bands_);
    };
    const int begin = edge(band);
    const int end = edge(band + 1);
    lock.unlock();
    std::exception_ptr failure;
    try {
      work(begin, end, band);
    } catch (...) {
      failure = std::current_exception();
    }
    lock.lock();
    if (failure && !failure_) failure_ = failure;
    if (--open_ == 0) done_.notify_all();
  }
}

void ThreadPool::serve() {
  std::unique_lock lock(mutex_);
  while (!stopping_) {
    work_off(lock);
    wake_.wait(lock, [this] { return stopping_ || (work_ != nullptr && next_ < bands_); });
  }
}

}  // namespace relievo
