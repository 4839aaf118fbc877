// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The technician's test capture on a stick: captures/NAME/ with one recorded pair (hal/recording), which
// folder:DIR replays bit for bit. It is read back and compared before the folder gets its name, and then the
// stick is let go; what an earlier recording left half written is cleared away. Thread: keeper; between two
// steps it looks whether it is to stop. Memory: CaptureCopy's, wiped with it. Errors: MediaMissing (no
// stick), MediaFull, Disconnected (pulled out meanwhile), Cancelled, IoFailed (outcome_of_export() says what
// it means).
#pragma once

#include <string>
#include <vector>

#include "firmware/jobs/job_thread.h"
#include "firmware/service/export_records.h"
#include "hal/recording/recording.h"
#include "hal/removable_media.h"
#include "pipeline/model/stereo_frame.h"

namespace relievo::firmware {

// A pair of its own, so that the session may be wiped while a slow stick is still being written to.
class CaptureCopy {
 public:
  // Of `as_taken` the views are replaced.
  CaptureCopy(const pipeline::StereoFrame& frame, hal::RecordedPair as_taken);
  ~CaptureCopy();
  CaptureCopy(const CaptureCopy&) = delete;
  CaptureCopy& operator=(const CaptureCopy&) = delete;
  const hal::RecordedPair& pair() const { return pair_; }

 private:
  std::vector<std::byte> left_, right_;
  hal::RecordedPair pair_;
};

inline constexpr const char* kCapturesFolder = "captures";  // on the stick

Result<void> record_capture(const hal::RecordedPair& pair, const std::string& name,
                            hal::RemovableMedia& media, JobControl& control, ExportTrace& trace);

}  // namespace relievo::firmware
