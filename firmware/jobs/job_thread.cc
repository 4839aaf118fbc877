// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/jobs/job_thread.h"

#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <exception>
#include <new>

#include "hal/base/wiped_text.h"

namespace relievo::firmware {
namespace {

// Unique over all threads, so that a late report of a cancelled job is never taken for another's.
std::atomic<JobId> next_id{1};

Result<void> run_guarded(Job& job, JobControl& control) {
  try {
    return job.run(control);
  } catch (const std::bad_alloc&) {
    return Error{Errc::OutOfMemory, "the job's memory is used up: use smaller pictures"};
  } catch (const std::exception&) {
    return Error{Errc::LibraryFailed, "a library gave up on this input: try another picture"};
  }
}

}  // namespace

int pool_size() { return std::clamp(int(std::thread::hardware_concurrency()), 1, budget::kMaxPoolThreads); }

void stand_behind_the_page() {
#ifndef RELIEVO_SANITIZED  // there a page is always busy, and what stands behind it would outlast a visitor
  constexpr int kBehind = 10;
  if (gettid() == getpid()) return;
  (void)setpriority(PRIO_PROCESS, 0, getpriority(PRIO_PROCESS, static_cast<id_t>(getpid())) + kBehind);
#endif
}

JobThread::JobThread(JobReports& reports, const char* name)
    : reports_(reports), thread_([this, name] {
        pthread_setname_np(pthread_self(), name);
        serve();
      }) {}

JobThread::~JobThread() {
  cancel();
  wait_until_idle();
  orders_.put(Order{});
  thread_.join();
}

Result<JobId> JobThread::start(Job& job) {
  if (busy()) return Error{Errc::InvalidState, "the thread is still busy with the job before"};
  cancelled_.store(false, std::memory_order_relaxed);
  progress_.done.store(0, std::memory_order_relaxed);
  busy_.store(true, std::memory_order_release);
  const JobId id = next_id.fetch_add(1, std::memory_order_relaxed);
  orders_.put({&job, id});
  return id;
}

void JobThread::wait_until_idle() {
  std::unique_lock lock(idle_mutex_);
  idle_.wait(lock, [this] { return !busy(); });
}

void JobThread::serve() {
  for (;;) {
    const std::optional<Order> order = orders_.take_for(std::chrono::hours(1));
    if (!order) continue;
    if (order->job == nullptr) return;
    JobControl control{cancelled_, progress_};
    const Result<void> result = run_guarded(*order->job, control);
    JobReport report{order->id, std::nullopt};
    if (!result) report.error = result.error();
    wipe_stack();  // its visitor may be gone when the next job comes
    {
      const std::lock_guard lock(idle_mutex_);
      busy_.store(false, std::memory_order_release);  // before the report: who hears it may start the next
      reports_.put(report);                           // in the lock: who waited until it is idle finds it
    }
    idle_.notify_all();
  }
}

Result<void> run_watched(Job& job, Console& console, const std::function<std::string_view()>& stage_name) {
  const std::atomic<bool>& stop = interrupted();
  JobReports reports;
  JobThread worker(reports);
  RELIEVO_TRY(worker.start(job));
  for (;;) {
    const auto report = reports.take_for(budget::kTick);
    if (stop.load()) worker.cancel();
    if (!report) {
      console.progress(stage_name(), worker.progress());
      continue;
    }
    console.clear_progress();
    if (!report->error) return {};
    // What the job was at is no news to who stopped it.
    return report->error->code == Errc::Cancelled ? Error{Errc::Cancelled, "cancelled: nothing was written"}
                                                  : *report->error;
  }
}

}  // namespace relievo::firmware
