// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/technician/technician_jobs.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <thread>
#include <utility>

#include "firmware/calibrate/calibrate_command.h"
#include "firmware/capture/live_judge.h"
#include "pipeline/calibrate/board/board_finder.h"
#include "pipeline/gate/relief/live_relief.h"

namespace relievo::firmware {
namespace {

// The kiosk's own cameras.
class GrabbedPairs final : public LivePairs {
 public:
  GrabbedPairs(StereoGrabber& grabber, StereoSlot& slot, hal::Device& device,
               const std::atomic<bool>& cancelled)
      : grabber_(grabber), slot_(slot), device_(device), cancelled_(cancelled) {}
  // Cameras that are not open, or have been away, are opened.
  Result<std::optional<LivePair>> next(const pipeline::LiveState&) override {
    RELIEVO_TRY(grabber_.start(device_.preferred_mode()));
    pipeline::RigCameras cameras = grabber_.cameras();
    if (first_ && cameras != *first_)
      return Error{Errc::NotCalibrated,
                   "these are not the cameras that the views before were taken with: begin again"};
    RELIEVO_TRY_ASSIGN(const pipeline::StereoFrame frame, grabber_.grab(slot_, cancelled_));
    if (!first_) first_ = std::move(cameras);
    return std::optional<LivePair>({frame.left, frame.right, device_.clock().now().time_since_epoch()});
  }

 private:
  StereoGrabber& grabber_;
  StereoSlot& slot_;
  hal::Device& device_;
  const std::atomic<bool>& cancelled_;
  std::optional<pipeline::RigCameras> first_;  // those of the first pair
};

// Rgb8, rows without padding.
class Drawing {
 public:
  Drawing(std::uint8_t* rgb, const ImageView& view, double scale)
      : rgb_(rgb), width_(view.width_px), height_(view.height_px), scale_(scale) {}
  void dot(const pipeline::Vec2d& at, std::array<std::uint8_t, 3> colour) {
    const int x = int(std::lround(at.x * scale_)), y = int(std::lround(at.y * scale_));
    for (int v = y - 2; v <= y + 2; ++v) {
      for (int u = x - 2; u <= x + 2; ++u) put(u, v, colour);
    }
  }
  void line(const pipeline::Vec2d& from, const pipeline::Vec2d& to, std::array<std::uint8_t, 3> colour) {
    const double dx = (to.x - from.x) * scale_, dy = (to.y - from.y) * scale_;
    const int steps = std::clamp(int(std::max(std::abs(dx), std::abs(dy))), 1, 4 * budget::kLiveSidePx);
    for (int i = 0; i <= steps; ++i) {
      const double t = double(i) / steps;
      const int x = int(std::lround(from.x * scale_ + t * dx)),
                y = int(std::lround(from.y * scale_ + t * dy));
      put(x, y, colour);
      put(x + 1, y, colour);
      put(x, y + 1, colour);
    }
  }

 private:
  void put(int x, int y, std::array<std::uint8_t, 3> colour) {
    if (x < 0 || y < 0 || x >= width_ || y >= height_) return;
    std::ranges::copy(colour, rgb_ + std::ptrdiff_t{3} * (std::ptrdiff_t(y) * width_ + x));
  }
  std::uint8_t* rgb_;
  int width_, height_;
  double scale_;
};

static_assert(ui::kCoverageCells == pipeline::kCoverageColumns &&
              ui::kCoverageCells == pipeline::kCoverageRows);

constexpr std::array<std::uint8_t, 3> kSeen{64, 240, 120}, kWanted{255, 170, 40};

constexpr std::chrono::seconds kPatience{8};  // with cameras that give no pair

}  // namespace

void CalibrateJob::order(const Order& order) {
  order_ = order;
  finish_.store(false, std::memory_order_relaxed);
  result_.reset();
  outcome_ = {};
  const std::lock_guard lock(mutex_);
  figures_ = {};
}

Result<void> CalibrateJob::run(JobControl& control) {
  outcome_ = Error{Errc::LibraryFailed, "the calibration ended early"};
  return outcome_ = calibrate(control);
}

Result<void> CalibrateJob::calibrate(JobControl& control) {
  pipeline::LiveOptions options;
  options.in_use = order_.in_use;
  RELIEVO_TRY_ASSIGN(auto live, pipeline::LiveCalibration::begin(pattern_of(order_.board), options, pool_));
  std::unique_ptr<LivePairs> pairs;
  if (show_) {
    RELIEVO_TRY_ASSIGN(pairs, show_(order_.board));
  } else {
    pairs = std::make_unique<GrabbedPairs>(grabber_, session_.slot(), device_, control.cancelled);
  }
  std::optional<pipeline::RigCameras> cameras;  // those of the first pair
  std::optional<Error> trouble;                 // since the last pair
  hal::Instant since;
  while (!live.state().done() && !finish_.load(std::memory_order_relaxed)) {
    if (control.cancelled.load(std::memory_order_relaxed))
      return Error{Errc::Cancelled, "the calibration was left"};
    const Result<bool> looked = look_at_next(*pairs, live);
    if (looked) {
      trouble.reset();
      if (!*looked) break;
      if (!cameras) cameras = grabber_.cameras();
      continue;
    }
    if (looked.error().code == Errc::Cancelled) return looked.error();
    const hal::Instant now = device_.clock().now();
    if (!trouble) since = now;
    trouble = looked.error();
    tell(*trouble);
    if (!may_pass(*trouble) || now - since > kPatience) break;
    std::this_thread::sleep_for(budget::kCameraRetryFirst);
  }
  auto made = live.finish();
  if (!made) return trouble.value_or(made.error());
  result_ = *std::move(made);
  if (cameras) result_->calibration.cameras = *std::move(cameras);
  return {};
}

Result<bool> CalibrateJob::look_at_next(LivePairs& pairs, pipeline::LiveCalibration& live) {
  RELIEVO_TRY_ASSIGN(const auto pair, pairs.next(live.state()));
  if (!pair) return false;
  RELIEVO_TRY(live.look(pair->left, pair->right, pair->at));
  publish(*pair, live.state());
  return true;
}

// One that is away may say anything when it is opened again; one that was away all the time is not found.
bool CalibrateJob::may_pass(const Error& trouble) const {
  return trouble.code == Errc::NotFound || trouble.code == Errc::Timeout ||
         trouble.code == Errc::Disconnected || trouble.code == Errc::IoFailed ||
         grabber_.watch() != CameraWatch::Well;
}

void CalibrateJob::tell(const Error& trouble) {
  const std::lock_guard lock(mutex_);
  figures_.problem = ui::fault_of(trouble);
}

void CalibrateJob::publish(const LivePair& pair, const pipeline::LiveState& state) {
  for (std::size_t i = 0; i < 2; ++i) {
    const ImageView& view = i == 0 ? pair.left : pair.right;
    const ImageView small = feeds_[i].fill(view);
    Drawing drawing(feeds_[i].filled(), small, double(small.width_px) / view.width_px);
    for (const pipeline::Vec2d& corner : state.corners[i]) {
      if (pipeline::seen(corner)) drawing.dot(corner, kSeen);
    }
    if (state.wanted) {
      const pipeline::BoardOutline& outline = (*state.wanted)[i];
      for (std::size_t k = 0; k < outline.size(); ++k)
        drawing.line(outline[k], outline[(k + 1) % outline.size()], kWanted);
    }
  }
  ui::TechnicianCalibration now;
  now.advice = state.advice;
  now.end = state.end;
  now.views = state.views;
  now.enough = state.views >= pipeline::kMinBoardPairs;
  now.disagreeing = state.disagreeing;
  now.bars = {float(state.bars.x), float(state.bars.y), float(state.bars.size), float(state.bars.skew)};
  for (std::size_t k = 0; k < 2; ++k) std::ranges::copy(state.maps[k], now.seen[k].begin());
  now.error_mm = float(state.error_mm);
  now.goal_mm = float(state.goal_mm);
  const std::lock_guard lock(mutex_);
  for (LiveFeed& feed : feeds_) feed.publish({});
  figures_ = now;
}

ui::TechnicianCalibration CalibrateJob::newest() {
  const std::lock_guard lock(mutex_);
  ui::TechnicianCalibration now = figures_;
  for (std::size_t i = 0; i < 2; ++i) {
    const ui::LiveView live = feeds_[i].newest();
    now.pictures[i] = {live.picture, live.number};
  }
  return now;
}

void CalibrateJob::wipe() {
  for (LiveFeed& feed : feeds_) feed.wipe();
}

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
