// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/technician/relief_watch.h"

#include <string.h>

#include <new>

#include "firmware/base/boot_memory.h"
#include "firmware/capture/live_judge.h"
#include "hal/base/thread_pool.h"
#include "pipeline/gate/relief/live_relief.h"
#include "pipeline/gate/relief/relief_picture.h"

namespace relievo::firmware {
namespace {

constexpr double kNearestDrawnMm = 350, kFarthestDrawnMm = 1000;

}  // namespace

struct ReliefWatch::Room {
  BootMemory memory{0, kOutputBytes, kScratchBytes};
  Arena output{memory.output()}, scratch{memory.scratch()};
  ThreadPool pool{1};
  ~Room() {
    explicit_bzero(memory.output().data(), output.high_water());
    explicit_bzero(memory.scratch().data(), scratch.high_water());
  }
};

ReliefWatch::ReliefWatch() = default;
ReliefWatch::~ReliefWatch() { forget(); }

void ReliefWatch::use(const pipeline::StereoCalibration* calibration) {
  calibration_.reset();
  if (calibration != nullptr) calibration_ = *calibration;
}

Result<ImageView> ReliefWatch::look(const pipeline::StereoFrame& frame, JobControl& control) {
  if (!calibration_) return Error{Errc::InvalidState, "without a calibration there is no relief"};
  try {
    if (room_ == nullptr) room_ = std::make_unique<Room>();
    room_->output.reset();
    pipeline::LiveReliefOptions options;
    options.reduction = judged_reduction(calibration_->left.width_px);
    pipeline::StageContext context{room_->output, room_->scratch, room_->pool, control.progress,
                                   control.cancelled};
    RELIEVO_TRY_ASSIGN(const pipeline::Relief relief,
                       pipeline::run_stage(context, [&](pipeline::StageContext& c) {
                         return pipeline::LiveRelief(options).look(frame, *calibration_, c);
                       }));
    grey_.resize(relief.depth_mm.size());
    pipeline::draw_relief(relief, kNearestDrawnMm, kFarthestDrawnMm, grey_.data());
    return ImageView{reinterpret_cast<const std::byte*>(grey_.data()), relief.width_px, relief.height_px,
                     relief.width_px, PixelFormat::Grey8};
  } catch (const std::bad_alloc&) {
    return Error{Errc::OutOfMemory, "there is no memory left to draw the relief in"};
  }
}

void ReliefWatch::forget() {
  room_.reset();
  if (!grey_.empty()) explicit_bzero(grey_.data(), grey_.size());
  grey_ = {};
}

}  // namespace relievo::firmware
