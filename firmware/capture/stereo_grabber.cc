// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/capture/stereo_grabber.h"

#include <string.h>

#include <algorithm>
#include <string>
#include <thread>
#include <utility>

#include "hal/raw/develop.h"

namespace relievo::firmware {

Result<ImageView> StereoSlot::keep(Plane& plane, const hal::RawImage& raw) {
  // Before it is known whether all goes well: half a developed picture is to be wiped too.
  if (hal::check_shape(raw)) {
    const std::size_t pixels = std::size_t(raw.width_px) * std::size_t(raw.height_px);
    plane.used = std::max(plane.used, std::min(3 * pixels, plane.room.size()));
    scratch_used_ = std::max(
        scratch_used_,
        std::min(hal::develop_scratch_bytes(raw.format, raw.width_px, raw.height_px), scratch_.size()));
  }
  return hal::develop(raw, plane.room, scratch_);
}

void StereoSlot::wipe() {
  for (Plane* plane : {&left_, &right_}) {
    explicit_bzero(plane->room.data(), plane->used);
    plane->used = 0;
  }
  explicit_bzero(scratch_.data(), scratch_used_);
  scratch_used_ = 0;
}

namespace {

using hal::Camera;
using hal::Frame;
using pipeline::RigCameras;
using pipeline::StereoFrame;

std::string words(std::string_view kind, std::string_view name) {
  const std::size_t room = pipeline::kMaxCameraWords - kind.size();
  if (name.size() > room) name.remove_prefix(name.size() - room);  // names of sockets differ in their ends
  std::string text(kind);
  std::ranges::transform(name, std::back_inserter(text),
                         [](char c) { return c >= ' ' && c <= '~' ? c : '?'; });
  return text;
}

std::string words_of(const hal::Camera& camera, bool by_serial) {
  if (by_serial && !camera.serial().empty()) return words("serial ", camera.serial());
  return camera.socket().empty() ? std::string() : words("at ", camera.socket());
}

// Of nobody known there is nothing to say.
bool another(const std::string& calibrated, const std::string& found) {
  return !calibrated.empty() && !found.empty() && calibrated != found;
}

const Error kAway{Errc::Disconnected, "the camera is away: check its plug; it is tried again by itself"};

}  // namespace

Result<void> CameraLink::run(const hal::CaptureMode& mode) {
  if (camera_.state() == Camera::State::Closed) {
    RELIEVO_TRY(camera_.open(mode));
    ++opened_;
  }
  if (camera_.state() == Camera::State::Idle) {
    last_.reset();  // a stream counts from its own beginning
    RELIEVO_TRY(camera_.start());
  }
  return {};
}

Result<void> CameraLink::start(const hal::CaptureMode& mode) {
  if (!gone()) {
    const Result<void> runs = run(mode);
    // Pulled out while nothing streamed.
    if (!runs && opened_ > 0) lose();
    return runs;
  }
  if (clock_.now() < due_) return kAway;
  if (const Result<void> back = run(mode); !back) {
    camera_.close();
    ++counts_.refused;
    wait_ = std::min(2 * wait_, budget::kCameraRetryMost);
    due_ = clock_.now() + wait_;
    return back;
  }
  ++counts_.returned;
  wait_ = budget::kCameraRetryFirst;
  gone_.store(false, std::memory_order_relaxed);
  return {};
}

void CameraLink::restart() {
  if (camera_.state() == Camera::State::Closed) return;
  camera_.stop();
  last_.reset();
  if (!camera_.start()) lose();
}

void CameraLink::lose() {
  camera_.close();
  ++counts_.vanished;
  wait_ = budget::kCameraRetryFirst;
  due_ = clock_.now() + wait_;
  gone_.store(true, std::memory_order_relaxed);
}

// Waits in short slices, so that a cancelled person does not wait for a camera.
Result<Frame> CameraLink::wait(hal::Instant deadline, const std::atomic<bool>& cancelled) {
  for (;;) {
    if (cancelled.load(std::memory_order_relaxed)) return Error{Errc::Cancelled, "the capture was cancelled"};
    const hal::Instant slice = std::min(deadline, clock_.now() + budget::kTick);
    Result<Frame> frame = camera_.next_frame(slice);
    if (frame || frame.error().code != Errc::Timeout) return frame;
    if (clock_.now() >= deadline) return frame;
  }
}

CameraLink::Verdict CameraLink::judge(const Frame& frame, hal::Instant asked) {
  const std::uint32_t step = last_ ? frame.sequence() - *last_ : 1;  // wraps with the counter
  const bool backwards = step > 0x8000'0000U;
  if (step == 0) {
    ++counts_.duplicate;
    return Verdict::Skip;
  }
  if (const std::uint32_t behind = 0U - step; behind - 1 < gap_) {  // a newer one overtook it
    --counts_.lost;
    ++counts_.late;
    return Verdict::Skip;
  }
  last_ = frame.sequence();
  gap_ = backwards ? 0 : step - 1;
  counts_.lost += gap_;
  if (backwards || frame.exposed_at() + budget::kStampSlack < asked) {
    ++counts_.late;
    return Verdict::Skip;
  }
  if (frame.damaged()) {
    ++counts_.damaged;
    return Verdict::Refuse;
  }
  if (hal::is_short(frame.raw())) {
    ++counts_.too_short;
    return Verdict::Refuse;
  }
  return Verdict::Take;
}

Result<Frame> CameraLink::next(hal::Instant asked, hal::Instant deadline,
                               const std::atomic<bool>& cancelled) {
  if (gone()) return kAway;
  for (;;) {
    Result<Frame> frame = wait(deadline, cancelled);
    if (!frame) {
      if (frame.error().code == Errc::Timeout) ++counts_.missing;
      if (frame.error().code == Errc::Disconnected) lose();
      return frame;
    }
    switch (judge(*frame, asked)) {
      case Verdict::Take: ++counts_.frames; return frame;
      case Verdict::Refuse:
        return Error{Errc::IoFailed, "the camera's picture came damaged: check its cable"};
      case Verdict::Skip:
        // A camera that floods with old frames may not hold anybody past the deadline.
        if (clock_.now() >= deadline) {
          ++counts_.missing;
          return Error{Errc::Timeout,
                       "the camera gives only pictures from before the trigger: check its wire"};
        }
    }
  }
}

RigCameras cameras_of(const hal::Camera& left, const hal::Camera& right) {
  const bool one_device = left.socket() == right.socket();
  const bool by_serial = one_device || left.serial() != right.serial();
  return {words_of(left, by_serial), words_of(right, by_serial)};
}

Result<void> check_cameras(const RigCameras& calibrated, const RigCameras& found) {
  const bool left = another(calibrated.left, found.left), right = another(calibrated.right, found.right);
  if (!left && !right) return {};
  const std::string at_left = calibrated.left + " → " + found.left,
                    at_right = calibrated.right + " → " + found.right;
  const bool exchanged = calibrated.left == found.right && calibrated.right == found.left;
  const Literal what =
      !right
          ? Literal(
                "the left camera is not the one that was calibrated: put that one back, or calibrate again")
      : !left
          ? Literal(
                "the right camera is not the one that was calibrated: put that one back, or calibrate again")
      : exchanged
          ? Literal("the left and the right camera have changed places: swap their plugs, or calibrate again")
          : Literal("neither camera is the one that was calibrated: put those back, or calibrate again");
  return Error{Errc::NotCalibrated, what}.at(!right ? at_left : !left ? at_right : at_left + "; " + at_right);
}

GrabberOptions grabber_options(const hal::Device& device) {
  GrabberOptions options;
  options.together = device.exposes_together();
  if (!options.together) options.max_skew = budget::kMaxFreeSkew;
  return options;
}

Result<void> StereoGrabber::start(const hal::CaptureMode& mode) {
  const Result<void> left = left_.start(mode);
  const Result<void> right = right_.start(mode);
  if (left || right) streams_.store(true, std::memory_order_release);
  if (left && right) recognise();
  return left ? right : left;
}

void StereoGrabber::recognise() {
  const int opened = left_.opened() + right_.opened();
  if (opened == recognised_) return;
  recognised_ = opened;
  pipeline::RigCameras found = cameras_of(left_.camera(), right_.camera());
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
  streams_.store(false, std::memory_order_release);
}

CameraWatch StereoGrabber::watch() const {
  if (left_.gone()) return right_.gone() ? CameraWatch::BothGone : CameraWatch::LeftGone;
  return right_.gone() ? CameraWatch::RightGone : CameraWatch::Well;
}

Result<StereoFrame> StereoGrabber::grab(StereoSlot& slot, const std::atomic<bool>& cancelled,
                                        hal::Light light) {
  const bool lit = light == hal::Light::Flash || trigger_.lights_with_every_pulse();
  if (lit) {
    rest(trigger_.flash_allowed_at(), cancelled);
    if (cancelled.load(std::memory_order_relaxed)) return Error{Errc::Cancelled, "the capture was cancelled"};
  }
  const hal::Instant now = clock_.now();
  Result<StereoFrame> pair = grab_within({slot, now, now + budget::kFrameWait, cancelled}, light, lit);
  if (!pair && pair.error().code != Errc::Cancelled) {
    // Both first: two halves of one camera stop when nobody wants either.
    left_.stop();
    right_.stop();
    // A restart that fails too changes nothing: the first reason is the one to tell.
    left_.restart();
    right_.restart();
    offset_.reset();
  }
  return pair;
}

void StereoGrabber::rest(hal::Instant until, const std::atomic<bool>& cancelled) const {
  if (options_.wait) return options_.wait(until, cancelled);
  while (clock_.now() < until && !cancelled.load(std::memory_order_relaxed))
    std::this_thread::sleep_for(std::min<std::chrono::nanoseconds>(until - clock_.now(), budget::kTick));
}

// A new pulse for a pair that was refused; one reason more is not worth a person's wait.
Result<StereoFrame> StereoGrabber::grab_within(const Shot& shot, hal::Light light, bool lit) {
  for (int attempt = 1;; ++attempt) {
    const hal::Instant asked = clock_.now();
    RELIEVO_TRY(trigger_.pulse(budget::kTriggerPulse, light));
    Result<StereoFrame> pair = grab_once({shot.slot, asked, shot.deadline, shot.cancelled});
    if (pair || attempt == budget::kGrabTries) return pair;
    const Errc code = pair.error().code;
    const bool worth_it = code == Errc::IoFailed || (code == Errc::Timeout && clock_.now() < shot.deadline);
    // A lamp may not be asked again so soon.
    if (!worth_it || lit) return pair;
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
    return invalid("the two cameras give pictures of different sizes: set both to one mode");
  const std::uint32_t offset = right.sequence - left.sequence;
  if (offset_ && *offset_ != offset) ++counts_.slipped;
  offset_ = offset;
  ++counts_.pairs;
  return StereoFrame{left.view, right.view, left.sequence, (right.at - left.at).count()};
}

}  // namespace relievo::firmware
