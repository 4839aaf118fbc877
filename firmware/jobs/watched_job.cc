// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/jobs/watched_job.h"

#include "firmware/base/budget.h"
#include "firmware/base/interrupt.h"

namespace relievo::firmware {

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
    if (report->error) return *report->error;
    return {};
  }
}

}  // namespace relievo::firmware
