// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/jobs/job_thread.h"

#include <gtest/gtest.h>

#include <chrono>
#include <new>
#include <stdexcept>
#include <thread>

namespace relievo::firmware {
namespace {

using std::chrono::milliseconds;

class Quick final : public Job {
 public:
  int runs = 0;
  Result<void> run(JobControl& control) override {
    ++runs;
    control.progress.done.store(1);
    return {};
  }
};

// Runs until it is cancelled.
class Endless final : public Job {
 public:
  std::atomic<bool> began{false};
  Result<void> run(JobControl& control) override {
    began.store(true);
    while (!control.cancelled.load()) std::this_thread::sleep_for(milliseconds(1));
    return Error{Errc::Cancelled, "asked to stop"};
  }
};

template <typename Exception>
class Throwing final : public Job {
 public:
  Result<void> run(JobControl&) override { throw Exception(); }
};
struct LibraryError : std::runtime_error {
  LibraryError() : std::runtime_error("inside") {}
};

JobReport report_of(JobReports& reports) {
  for (;;) {
    if (const auto report = reports.take_for(milliseconds(1000))) return *report;
  }
}

TEST(JobThread, DoesOneJobAfterAnotherAndReportsEach) {
  JobReports reports;
  JobThread thread(reports);
  Quick job;
  for (int i = 1; i <= 100; ++i) {
    const Result<JobId> id = thread.start(job);
    ASSERT_TRUE(id);
    const JobReport report = report_of(reports);
    EXPECT_EQ(report.job, *id);
    EXPECT_FALSE(report.error);
    EXPECT_EQ(job.runs, i);
  }
  EXPECT_EQ(thread.progress(), 1.0F);
}

TEST(JobThread, RefusesASecondJobWhileBusy) {
  JobReports reports;
  JobThread thread(reports);
  Endless job;
  Quick other;
  ASSERT_TRUE(thread.start(job));
  const auto refused = thread.start(other);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::InvalidState);
  thread.cancel();
  thread.wait_until_idle();
  EXPECT_EQ(other.runs, 0);
}

TEST(JobThread, CancelReachesTheJobAndTheNextOneStartsUncancelled) {
  JobReports reports;
  JobThread thread(reports);
  Endless job;
  ASSERT_TRUE(thread.start(job));
  while (!job.began.load()) std::this_thread::yield();
  thread.cancel();
  const JobReport report = report_of(reports);
  ASSERT_TRUE(report.error);
  EXPECT_EQ(report.error->code, Errc::Cancelled);
  Quick next;
  ASSERT_TRUE(thread.start(next));
  EXPECT_FALSE(report_of(reports).error);
}

TEST(JobThread, ExceptionsBecomeErrors) {
  JobReports reports;
  JobThread thread(reports);
  Throwing<std::bad_alloc> no_memory;
  ASSERT_TRUE(thread.start(no_memory));
  EXPECT_EQ(report_of(reports).error->code, Errc::OutOfMemory);
  Throwing<LibraryError> library;
  ASSERT_TRUE(thread.start(library));
  EXPECT_EQ(report_of(reports).error->code, Errc::LibraryFailed);
}

TEST(JobThread, EndsWithAJobUnderWay) {
  JobReports reports;
  Endless job;
  {
    JobThread thread(reports);
    ASSERT_TRUE(thread.start(job));
    while (!job.began.load()) std::this_thread::yield();
  }
  EXPECT_EQ(report_of(reports).error->code, Errc::Cancelled);
}

TEST(JobThread, EachOfThreeThreadsHasItsOwnJobs) {
  JobReports reports;
  JobThread capture(reports);
  JobThread worker(reports);
  Endless slow;
  Quick quick;
  const auto slow_id = worker.start(slow);
  const auto quick_id = capture.start(quick);
  ASSERT_TRUE(slow_id);
  ASSERT_TRUE(quick_id);
  EXPECT_NE(*slow_id, *quick_id);
  EXPECT_EQ(report_of(reports).job, *quick_id);  // the slow one does not hold it up
  worker.cancel();
  EXPECT_EQ(report_of(reports).job, *slow_id);
}

}  // namespace
}  // namespace relievo::firmware
