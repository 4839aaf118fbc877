// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Mailbox<T>: one slot between two threads. put() replaces what was not yet taken: the newest
// counts, a slow reader never holds up a writer, and nothing grows.
// Thread: any, on both sides.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <utility>

namespace relievo {

template <typename T>
class Mailbox {
 public:
  void put(T item) {
    {
      const std::lock_guard lock(mutex_);
      slot_.emplace(std::move(item));
    }
    arrived_.notify_one();
  }
  // Waits until something arrives or the time is over.
  std::optional<T> take_for(std::chrono::milliseconds wait) {
    std::unique_lock lock(mutex_);
    arrived_.wait_for(lock, wait, [this] { return slot_.has_value(); });
    return std::exchange(slot_, std::nullopt);
  }

 private:
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::optional<T> slot_;
};

}  // namespace relievo
