// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/capture/stereo_grabber.h"

#include <chrono>
#include <utility>

#include "firmware/capture/rig_cameras.h"

namespace relievo::firmware {

using pipeline::StereoFrame;

GrabberOptions grabber_options(const hal::Device& device) {
  GrabberOptions options;
  options.together = device.exposes_together();
  if (!options.together) options.max_skew = budget::kMaxFreeSkew;
  return options;
}

Result<void> StereoGrabber::start(const hal::CaptureMode& mode) {
  const Result<void> left = left_.start(mode);
  const Result<void> right = right_.start(mode);
  if (left && right) recognise();
  return left ? right : left;
}

void StereoGrabber::recognise() {
  const int opened = left_.opened() + right_.opened();
  if (opened == recognised_) return;
  recognised_ = opened;
  pipeline::RigCameras found = cameras_of(left_camera_, right_camera_);
  const std::lock_guard lock(names_);
  found_ = std::move(found);
}

pipeline::RigCameras StereoGrabber::cameras() const {
  const std::lock_guard lock(names_);
  return found_;
}

void StereoGrabber::expect(pipeline::RigCameras calibrated) {
  const std::lock_guard lock(names_);
  expected_ = std::move(calibrated);
}

Result<void> StereoGrabber::check_cameras() const {
  const std::lock_guard lock(names_);
  return firmware::check_cameras(expected_, found_);
}

void StereoGrabber::stop() {
  left_.stop();
  right_.stop();
}

CameraWatch StereoGrabber::watch() const {
  if (left_.gone()) return right_.gone() ? CameraWatch::BothGone : CameraWatch::LeftGone;
  return right_.gone() ? CameraWatch::RightGone : CameraWatch::Well;
}

Result<StereoFrame> StereoGrabber::grab(StereoSlot& slot, const std::atomic<bool>& cancelled,
                                        hal::Light light) {
  const hal::Instant now = clock_.now();
  Result<StereoFrame> pair = grab_within({slot, now, now + budget::kFrameWait, cancelled}, light);
  if (!pair && pair.error().code != Errc::Cancelled) {
    // A restart that fails too changes nothing: the first reason is the one to tell.
    left_.restart();
    right_.restart();
    offset_.reset();
  }
  return pair;
}

// A new pulse for a pair that was refused; one reason more is not worth a person's wait.
Result<StereoFrame> StereoGrabber::grab_within(const Shot& shot, hal::Light light) {
  for (int attempt = 1;; ++attempt) {
    const hal::Instant asked = clock_.now();
    RELIEVO_TRY(trigger_.pulse(budget::kTriggerPulse, light));
    Result<StereoFrame> pair = grab_once({shot.slot, asked, shot.deadline, shot.cancelled});
    if (pair || attempt == budget::kGrabTries) return pair;
    const Errc code = pair.error().code;
    const bool worth_it = code == Errc::IoFailed || (code == Errc::Timeout && clock_.now() < shot.deadline);
    // A lamp may not be asked again so soon.
    if (!worth_it || light == hal::Light::Flash) return pair;
  }
}

// Copies before the partner is there, so that the driver has its buffer back.
Result<StereoGrabber::Half> StereoGrabber::take(CameraLink& camera, const Shot& shot) {
  RELIEVO_TRY_ASSIGN(const hal::Frame frame, camera.next(shot.asked, shot.deadline, shot.cancelled));
  Half half{{}, frame.exposed_at(), frame.sequence()};
  RELIEVO_TRY_ASSIGN(
      half.view, &camera == &left_ ? shot.slot.keep_left(frame.raw()) : shot.slot.keep_right(frame.raw()));
  return half;
}

Result<StereoFrame> StereoGrabber::grab_once(const Shot& shot) {
  RELIEVO_TRY_ASSIGN(Half left, take(left_, shot));
  RELIEVO_TRY_ASSIGN(Half right, take(right_, shot));
  for (;;) {
    const auto skew = right.at - left.at;
    if (std::chrono::abs(skew) <= options_.max_skew) return pair_of(left, right);
    ++counts_.apart;
    if (options_.together)
      return Error{Errc::Timeout, "the two cameras did not expose together: check the trigger wire"};
    if (clock_.now() >= shot.deadline)
      return Error{Errc::Timeout, "the two cameras run too far apart: join them by a trigger wire"};
    if (skew.count() > 0) {  // the older one has lost its partner
      RELIEVO_TRY_ASSIGN(left, take(left_, shot));
    } else {
      RELIEVO_TRY_ASSIGN(right, take(right_, shot));
    }
  }
}

Result<StereoFrame> StereoGrabber::pair_of(const Half& left, const Half& right) {
  if (left.view.width_px != right.view.width_px || left.view.height_px != right.view.height_px)
    return Error{Errc::InvalidInput,
                 "the two cameras give pictures of different sizes: set both to one mode"};
  const std::uint32_t offset = right.sequence - left.sequence;
  if (offset_ && *offset_ != offset) ++counts_.slipped;
  offset_ = offset;
  ++counts_.pairs;
  return StereoFrame{left.view, right.view, left.sequence, (right.at - left.at).count()};
}

}  // namespace relievo::firmware
