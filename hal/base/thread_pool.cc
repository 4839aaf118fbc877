// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/base/thread_pool.h"

#include <utility>

#include "hal/base/wiped_text.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace relievo {
namespace {

// How often a waiting thread looks before it sleeps: some 50 microseconds, the price of two wake-ups.
constexpr int kLooks = 2000;

void breathe() {
#if defined(__x86_64__)
  _mm_pause();
#elif defined(__aarch64__)
  asm volatile("yield");
#endif
}

template <typename Condition>
bool soon(const Condition& condition) {
  for (int i = 0; i < kLooks; ++i) {
    if (condition()) return true;
    breathe();
  }
  return condition();
}

constexpr std::uint64_t kRound = std::uint64_t{1} << 32;
constexpr std::uint64_t kLeft = kRound - 1;

}  // namespace

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
  bands = bands < 1 ? 1 : (bands > count ? count : bands);
  work_ = &work;
  count_ = count;
  bands_ = bands;
  open_ = bands;
  cursor_ = (cursor_ & ~kLeft) + kRound + std::uint64_t(bands);
  if (asleep_ > 0) {
    // A sleeper looks at the cursor under the lock before it sleeps: it has either seen this round or hears
    // this.
    { const std::lock_guard lock(mutex_); }
    wake_.notify_all();
  }
  work_off();
  if (!soon([this] { return open_ == 0; })) {
    std::unique_lock lock(mutex_);
    done_.wait(lock, [this] { return open_ == 0; });
  }
  const std::lock_guard lock(mutex_);
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

bool ThreadPool::anything_to_begin() const { return (cursor_ & kLeft) > 0; }

bool ThreadPool::take_band(int& band) {
  std::uint64_t cursor = cursor_;
  while ((cursor & kLeft) > 0) {
    if (!cursor_.compare_exchange_weak(cursor, cursor - 1)) continue;
    band = bands_ - int(cursor & kLeft);
    return true;
  }
  return false;
}

void ThreadPool::run_band(int band) {
  // Neither changes before this band is done, since the caller waits for it.
  const long long count = count_;
  const int bands = bands_;
  const auto edge = [&](int k) { return int(count * k / bands); };
  try {
    (*work_.load())(edge(band), edge(band + 1), band);
  } catch (...) {
    const std::lock_guard lock(mutex_);
    if (!failure_) failure_ = std::current_exception();
  }
  if (open_.fetch_sub(1) == 1) {
    { const std::lock_guard lock(mutex_); }
    done_.notify_all();
  }
}

void ThreadPool::work_off() {
  for (int band = 0; take_band(band);) run_band(band);
}

void ThreadPool::serve() {
  const auto called = [this] { return stopping_ || anything_to_begin(); };
  while (!stopping_) {
    work_off();
    if (soon(called)) continue;
    wipe_stack();  // whoever it worked for may be gone when it wakes
    std::unique_lock lock(mutex_);
    ++asleep_;
    wake_.wait(lock, called);
    --asleep_;
  }
}

}  // namespace relievo
