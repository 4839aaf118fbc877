// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// CameraWatch: what both cameras see and how well, for a hand at lens, lamp and cable: pictures, light and
// focus of the middle of each, how far apart the two were exposed, what the grabber has counted, and the
// relief when asked. It watches in the session's free slot, beside the test capture, until it is cancelled.
// Errors of run(): the grabber's; Cancelled. Thread: run() capture; the rest main.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <vector>

#include "firmware/base/boot_memory.h"
#include "firmware/capture/face_light.h"
#include "firmware/capture/focus_peaking.h"
#include "firmware/capture/live_feed.h"
#include "firmware/jobs/job_thread.h"
#include "firmware/work/jobs.h"
#include "hal/base/arena.h"
#include "hal/base/image_view.h"
#include "hal/base/thread_pool.h"
#include "pipeline/model/calibration.h"
#include "pipeline/model/stereo_frame.h"
#include "ui/technician/technician_view.h"

namespace relievo::firmware {

// What reliefs are made in: the session's memory may be the worker's meanwhile.
struct ReliefRoom {
  BootMemory memory{0, std::size_t{4} << 20, std::size_t{64} << 20};  // touched: 1 MB and 27 MB
  Arena output{memory.output()}, scratch{memory.scratch()};
  ThreadPool pool{1};
  ~ReliefRoom() { output.wipe(), scratch.wipe(); }
};

class CameraWatchJob final : public CameraJob {
 public:
  using CameraJob::CameraJob;
  // With the calibration in use; null: there is none, and no relief. While the job does not run.
  void prepare(const pipeline::StereoCalibration* calibration);
  // With every pair its relief, from the next one on.
  void show_relief(bool on) { relief_shown_.store(on, std::memory_order_relaxed); }
  bool shows_relief() const { return relief_shown_.load(std::memory_order_relaxed); }
  // What is in focus is coloured, from the next pair on.
  void show_edges(bool on) { edges_shown_.store(on, std::memory_order_relaxed); }
  bool shows_edges() const { return edges_shown_.load(std::memory_order_relaxed); }
  // A third stop brighter (1) or darker (-1) from the next pair on.
  void change_light(int steps) { steps_.fetch_add(steps, std::memory_order_relaxed); }
  Result<void> run(JobControl& control) override;
  // The newest pair and its figures; `watched` false before the first one.
  ui::TechnicianCameras newest();
  void wipe();

 private:
  Result<void> look(const pipeline::StereoFrame& frame, JobControl& control);
  bool draw_relief(const pipeline::StereoFrame& frame, JobControl& control, ui::TechnicianCameras& now);
  void set_light();
  // Where the rig sees depth and where it does not, as the gate judges by it. Grey8, near is bright, black is
  // unknown; valid until the next one or wipe(). Errors: InvalidState (no calibration), those of LiveRelief,
  // OutOfMemory.
  Result<ImageView> relief_of(const pipeline::StereoFrame& frame, JobControl& control);
  std::array<LiveFeed, 3> feeds_{LiveFeed(budget::kWatchedSidePx), LiveFeed(budget::kWatchedSidePx),
                                 LiveFeed()};  // left, right, relief
  std::array<FocusHelp, 2> focus_;
  FocusPeaking peaking_;
  std::optional<pipeline::StereoCalibration> calibration_;
  std::optional<ReliefRoom> relief_room_;  // the first relief takes it, wipe() gives it back
  std::vector<std::uint8_t> relief_grey_;
  std::atomic<int> steps_{0};
  std::atomic<bool> relief_shown_{false}, edges_shown_{false};
  std::optional<hal::Instant> last_pair_;
  std::mutex mutex_;
  ui::TechnicianCameras figures_;  // without pictures and texts; with those of the feeds, under the mutex
};

}  // namespace relievo::firmware
