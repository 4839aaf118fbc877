// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/technician/camera_watch.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <thread>

#include "firmware/capture/live_judge.h"
#include "pipeline/gate/relief/live_relief.h"

namespace relievo::firmware {
namespace {

constexpr double kNearestDrawnMm = 350, kFarthestDrawnMm = 1000;

constexpr std::uint32_t kReliefVersion =
    0x80000000;  // it takes turns with the right picture: no version of the one is the other's
constexpr double kThirdOfAStop = 1.2599210498948732;  // cube root of 2

void count(const CameraCounts& from, ui::TechnicianCamera& to) {
  to.frames = from.frames;
  to.lost = from.lost;
  to.damaged = from.damaged + from.too_short;
}

}  // namespace

Result<ImageView> CameraWatchJob::relief_of(const pipeline::StereoFrame& frame, JobControl& control) {
  if (!calibration_) return Error{Errc::InvalidState, "without a calibration there is no relief"};
  try {
    if (!relief_room_) relief_room_.emplace();
    relief_room_->output.reset();
    pipeline::LiveRelief live;
    live.reduction = judged_reduction(calibration_->left.width_px);
    pipeline::StageContext context{relief_room_->output, relief_room_->scratch, relief_room_->pool,
                                   control.progress, control.cancelled};
    RELIEVO_TRY_ASSIGN(const pipeline::Relief relief,
                       pipeline::run_stage(context, [&](pipeline::StageContext& c) {
                         return live.look(frame, *calibration_, c);
                       }));
    relief_grey_.resize(relief.depth_mm.size());
    pipeline::draw_relief(relief, kNearestDrawnMm, kFarthestDrawnMm, relief_grey_.data());
    return ImageView{reinterpret_cast<const std::byte*>(relief_grey_.data()), relief.width_px,
                     relief.height_px, relief.width_px, PixelFormat::Grey8};
  } catch (const std::bad_alloc&) {
    return Error{Errc::OutOfMemory, "there is no memory left to draw the relief in"};
  }
}

void CameraWatchJob::prepare(const pipeline::StereoCalibration* calibration) {
  calibration_.reset();
  if (calibration != nullptr) calibration_ = *calibration;
  steps_.store(0, std::memory_order_relaxed);
  for (FocusHelp& focus : focus_) focus.reset();
  last_pair_.reset();
  const std::lock_guard lock(mutex_);
  figures_ = {};
}

Result<void> CameraWatchJob::run(JobControl& control) {
  RELIEVO_TRY(grabber_.start(device_.preferred_mode()));
  while (!control.cancelled.load(std::memory_order_relaxed)) {
    if (steps_.load(std::memory_order_relaxed) != 0) set_light();
    RELIEVO_TRY_ASSIGN(const pipeline::StereoFrame frame,
                       grabber_.grab(session_.free_slot(), control.cancelled));
    RELIEVO_TRY(look(frame, control));
    std::this_thread::sleep_for(budget::kLivePause);
  }
  return Error{Errc::Cancelled, "nobody watches the cameras any more"};
}

// What cannot be set stays; the page says so.
void CameraWatchJob::set_light() {
  const int steps = steps_.exchange(0, std::memory_order_relaxed);
  const auto left = device_.left().exposure_limits(), right = device_.right().exposure_limits();
  if (!left || !right) return;
  const hal::ExposureLimits limits = common_limits(*left, *right);
  const hal::Exposure now = device_.left().exposure();
  const auto wanted =
      std::chrono::microseconds(std::lround(double(now.time.count()) * std::pow(kThirdOfAStop, steps)));
  const hal::Exposure next{std::clamp(wanted, limits.least.time, limits.most.time), now.gain};
  if (device_.left().set_exposure(next)) (void)device_.right().set_exposure(next);
}

// Pictures of another size than the calibrated one have no relief; they are watched all the same.
bool CameraWatchJob::draw_relief(const pipeline::StereoFrame& frame, JobControl& control,
                                 ui::TechnicianCameras& now) {
  now.relief_shown = shows_relief();
  if (!now.relief_shown) return false;
  const Result<ImageView> relief = relief_of(frame, control);
  if (relief) (void)feeds_[2].fill(*relief);
  else if (relief.error().code != Errc::Cancelled) now.problem = ui::fault_of(relief.error());
  return relief.has_value();
}

Result<void> CameraWatchJob::look(const pipeline::StereoFrame& frame, JobControl& control) {
  ui::TechnicianCameras now;
  now.watched = true;
  now.edges_shown = shows_edges();
  for (std::size_t i = 0; i < 2; ++i) {
    const ImageView& view = i == 0 ? frame.left : frame.right;
    RELIEVO_TRY_ASSIGN(const FaceLight light, face_light(view, middle_box(view)));
    now.camera[i].mean = float(light.mean);
    now.camera[i].clipped = float(light.clipped);
    now.camera[i].focus = float(focus_[i].share_of_best(light));
    const ImageView shown = feeds_[i].fill(view);
    if (now.edges_shown)
      now.camera[i].sharp_edges =
          float(peaking_.mark(view, feeds_[i].filled(), shown.width_px, shown.height_px));
  }
  const bool relief = draw_relief(frame, control, now);
  const GrabCounts& counts = grabber_.counts();
  count(counts.left, now.camera[0]);
  count(counts.right, now.camera[1]);
  now.pairs = counts.pairs;
  now.apart = counts.apart;
  now.skew_us = float(frame.skew_ns) / 1000;
  now.exposure_us = float(device_.left().exposure().time.count());
  now.can_be_set =
      device_.left().exposure_limits().has_value() && device_.right().exposure_limits().has_value();
  const hal::Instant at = device_.clock().now();
  if (last_pair_ && at > *last_pair_)
    now.pairs_per_second = 1 / std::chrono::duration<float>(at - *last_pair_).count();
  last_pair_ = at;
  const std::lock_guard lock(mutex_);
  for (std::size_t i = 0; i < (relief ? 3U : 2U); ++i) feeds_[i].publish({});
  figures_ = now;
  return {};
}

ui::TechnicianCameras CameraWatchJob::newest() {
  const std::lock_guard lock(mutex_);
  ui::TechnicianCameras now = figures_;
  for (std::size_t i = 0; i < 2; ++i) {
    const ui::LiveView live = feeds_[i].newest();
    now.camera[i].picture = {live.picture, live.number};
  }
  if (now.relief_shown && now.problem.empty()) {
    const ui::LiveView live = feeds_[2].newest();
    now.relief = {live.picture, live.number == 0 ? 0 : live.number | kReliefVersion};
  }
  return now;
}

void CameraWatchJob::wipe() {
  for (LiveFeed& feed : feeds_) feed.wipe();
  relief_room_.reset();
  relief_grey_ = std::vector<std::uint8_t>();  // not {}: that keeps the block, and with it the picture
  peaking_.wipe();
  const std::lock_guard lock(mutex_);
  figures_ = {};
}

}  // namespace relievo::firmware
