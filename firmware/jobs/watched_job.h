// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs a job on a worker while this thread shows how far it is and listens for Ctrl-C.
// Thread: main.
#pragma once

#include <functional>
#include <string_view>

#include "firmware/base/console.h"
#include "firmware/jobs/job_thread.h"

namespace relievo::firmware {

// `stage_name` tells what the job is at. Returns the job's own result; Cancelled after Ctrl-C.
Result<void> run_watched(Job& job, Console& console, const std::function<std::string_view()>& stage_name);

}  // namespace relievo::firmware
