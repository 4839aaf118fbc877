// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// JobThread: one thread that does one job at a time: capture, worker and keeper are three of them.
//
//   idle --start()--> busy --job returns--> idle, and a report in the queue
//                      |
//                   cancel(): the job sees its flag and returns Errc::Cancelled within 100 ms
//
// The destructor cancels, waits for the job and joins. Thread: all methods main; Job::run() inside.
// Errors: start() says InvalidState while busy.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string_view>
#include <thread>

#include "firmware/base/budget.h"
#include "firmware/base/console.h"
#include "hal/base/assert.h"
#include "hal/base/mailbox.h"
#include "hal/base/result.h"
#include "pipeline/base/stage.h"

namespace relievo::firmware {

// Threads for a stage, the worker counted: as many as the machine has, at most budget's limit.
int pool_size();
// From now on the calling thread, and whatever threads it begins, get the processor when the main thread and
// the GL driver's leave it: a face that takes a moment longer is not noticed, a button that does not answer a
// finger is. Linux has this per thread. Thread: any; nothing on main.
void stand_behind_the_page();

// JobReport: what a thread says when a job has ended. JobReports: the queue in which the main thread
// hears it; of fixed length, so that nothing grows. One report per running job: it cannot overflow.
// Thread: any thread puts, main takes.
using JobId = std::uint32_t;  // 0 is no job

struct JobReport {
  JobId job = 0;
  std::optional<Error> error;  // nothing: done
};

class JobReports {
 public:
  void put(const JobReport& report) {
    {
      const std::lock_guard lock(mutex_);
      RELIEVO_ASSERT(count_ < ring_.size());
      ring_[(first_ + count_++) % ring_.size()] = report;
    }
    arrived_.notify_one();
  }
  // Waits until something arrives or the time is over.
  std::optional<JobReport> take_for(std::chrono::milliseconds wait) {
    std::unique_lock lock(mutex_);
    if (wait.count() > 0)
      arrived_.wait_for(lock, wait, [this] { return count_ > 0; });  // 0 would wait a moment
    if (count_ == 0) return std::nullopt;
    const JobReport report = ring_[first_];
    first_ = (first_ + 1) % ring_.size();
    --count_;
    return report;
  }

 private:
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::array<JobReport, budget::kEventQueueLength> ring_{};
  std::size_t first_ = 0;
  std::size_t count_ = 0;
};

// What a running job looks at and writes to.
struct JobControl {
  const std::atomic<bool>& cancelled;
  pipeline::Progress& progress;
};

class Job {
 public:
  virtual ~Job() = default;
  // May throw bad_alloc or a library's exception: the thread turns both into an error.
  virtual Result<void> run(JobControl& control) = 0;
};

// A job that is one function.
class FunctionJob final : public Job {
 public:
  explicit FunctionJob(std::function<Result<void>(JobControl&)> work) : work_(std::move(work)) {}
  Result<void> run(JobControl& control) override { return work_(control); }

 private:
  std::function<Result<void>(JobControl&)> work_;
};

// Done when a job leaves, also by what a library throws.
template <typename Work>
struct Finally {
  Work work;
  ~Finally() { work(); }
};
template <typename Work>
Finally(Work) -> Finally<Work>;

class JobThread {
 public:
  // The name is the system's for this thread (top -H): 15 letters at most.
  explicit JobThread(JobReports& reports, const char* name = "job");
  ~JobThread();
  JobThread& operator=(JobThread&&) = delete;

  // The job is borrowed until its report arrives or wait_until_idle() returns.
  Result<JobId> start(Job& job);
  void cancel() { cancelled_.store(true, std::memory_order_relaxed); }
  bool busy() const { return busy_.load(std::memory_order_acquire); }
  void wait_until_idle();  // the report is in the queue then
  float progress() const { return progress_.done.load(std::memory_order_relaxed); }

 private:
  struct Order {
    Job* job = nullptr;  // none: the thread ends
    JobId id = 0;
  };
  void serve();

  JobReports& reports_;
  Mailbox<Order> orders_;
  std::atomic<bool> cancelled_{false};
  std::atomic<bool> busy_{false};
  std::mutex idle_mutex_;
  std::condition_variable idle_;
  pipeline::Progress progress_;
  std::thread thread_;  // last: everything it uses stands before it starts
};

// Runs a job on a worker while this thread shows how far it is and listens for Ctrl-C. `stage_name` tells
// what the job is at. Returns the job's own result, after Ctrl-C Cancelled, without a place. Thread: main.
Result<void> run_watched(Job& job, Console& console, const std::function<std::string_view()>& stage_name);

}  // namespace relievo::firmware
