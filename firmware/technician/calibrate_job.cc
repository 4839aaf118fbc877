// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/technician/calibrate_job.h"

#include <algorithm>
#include <cmath>

#include "firmware/calibrate/calibrate_command.h"

namespace relievo::firmware {
namespace {

// The kiosk's own cameras.
class GrabbedPairs final : public LivePairs {
 public:
  GrabbedPairs(StereoGrabber& grabber, StereoSlot& slot, hal::Device& device,
               const std::atomic<bool>& cancelled)
      : grabber_(grabber), slot_(slot), device_(device), cancelled_(cancelled) {}
  Result<std::optional<LivePair>> next(const pipeline::LiveState&) override {
    RELIEVO_TRY_ASSIGN(const pipeline::StereoFrame frame, grabber_.grab(slot_, cancelled_));
    return std::optional<LivePair>({frame.left, frame.right, device_.clock().now().time_since_epoch()});
  }

 private:
  StereoGrabber& grabber_;
  StereoSlot& slot_;
  hal::Device& device_;
  const std::atomic<bool>& cancelled_;
};

// Rgb8, rows without padding.
class Drawing {
 public:
  Drawing(std::uint8_t* rgb, const ImageView& view, double scale)
      : rgb_(rgb), width_(view.width_px), height_(view.height_px), scale_(scale) {}
  void dot(const pipeline::Vec2d& at, std::array<std::uint8_t, 3> colour) {
    const int x = static_cast<int>(std::lround(at.x * scale_)),
              y = static_cast<int>(std::lround(at.y * scale_));
    for (int v = y - 2; v <= y + 2; ++v) {
      for (int u = x - 2; u <= x + 2; ++u) put(u, v, colour);
    }
  }
  void line(const pipeline::Vec2d& from, const pipeline::Vec2d& to, std::array<std::uint8_t, 3> colour) {
    const double dx = (to.x - from.x) * scale_, dy = (to.y - from.y) * scale_;
    const int steps =
        std::clamp(static_cast<int>(std::max(std::abs(dx), std::abs(dy))), 1, 4 * budget::kLiveSidePx);
    for (int i = 0; i <= steps; ++i) {
      const double t = static_cast<double>(i) / steps;
      const int x = static_cast<int>(std::lround(from.x * scale_ + t * dx)),
                y = static_cast<int>(std::lround(from.y * scale_ + t * dy));
      put(x, y, colour);
      put(x + 1, y, colour);
      put(x, y + 1, colour);
    }
  }

 private:
  void put(int x, int y, std::array<std::uint8_t, 3> colour) {
    if (x < 0 || y < 0 || x >= width_ || y >= height_) return;
    std::copy(colour.begin(), colour.end(),
              rgb_ + std::ptrdiff_t{3} * (static_cast<std::ptrdiff_t>(y) * width_ + x));
  }
  std::uint8_t* rgb_;
  int width_, height_;
  double scale_;
};

static_assert(static_cast<int>(ui::BoardAdvice::Done) == static_cast<int>(pipeline::LiveAdvice::Done) &&
              static_cast<int>(ui::BoardAdvice::HoldStill) ==
                  static_cast<int>(pipeline::LiveAdvice::HoldStill) &&
              static_cast<int>(ui::BoardAdvice::TiltBack) ==
                  static_cast<int>(pipeline::LiveAdvice::TiltBack) &&
              static_cast<int>(ui::BoardEnd::Full) == static_cast<int>(pipeline::LiveEnd::Full));
static_assert(ui::kCoverageCells == pipeline::kCoverageColumns &&
              ui::kCoverageCells == pipeline::kCoverageRows);

constexpr std::array<std::uint8_t, 3> kSeen{64, 240, 120}, kWanted{255, 170, 40};

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
  options.goal_mm = order_.goal_mm;
  RELIEVO_TRY_ASSIGN(auto live, pipeline::LiveCalibration::begin(pattern_of(order_.board), options, pool_));
  std::unique_ptr<LivePairs> pairs;
  if (show_) {
    RELIEVO_TRY_ASSIGN(pairs, show_(order_.board));
  } else {
    RELIEVO_TRY(grabber_.start(device_.preferred_mode()));
    pairs = std::make_unique<GrabbedPairs>(grabber_, session_.slot(), device_, control.cancelled);
  }
  while (!live.state().done() && !finish_.load(std::memory_order_relaxed)) {
    if (control.cancelled.load(std::memory_order_relaxed))
      return Error{Errc::Cancelled, "the calibration was left"};
    RELIEVO_TRY_ASSIGN(const auto pair, pairs->next(live.state()));
    if (!pair) break;
    RELIEVO_TRY(live.look(pair->left, pair->right, pair->at));
    publish(*pair, live.state());
  }
  RELIEVO_TRY_ASSIGN(result_, live.finish());
  result_->calibration.cameras = grabber_.cameras();
  return {};
}

void CalibrateJob::publish(const LivePair& pair, const pipeline::LiveState& state) {
  for (std::size_t i = 0; i < 2; ++i) {
    const ImageView& view = i == 0 ? pair.left : pair.right;
    const ImageView small = feeds_[i].fill(view);
    Drawing drawing(feeds_[i].filled(), small, static_cast<double>(small.width_px) / view.width_px);
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
  now.advice = static_cast<ui::BoardAdvice>(state.advice);
  now.end = static_cast<ui::BoardEnd>(state.end);
  now.a_little = state.how_far > 0 && state.how_far < 2;
  now.pairs = state.pairs;
  now.views = state.views;
  now.disagreeing = state.disagreeing;
  now.bars = {static_cast<float>(state.bars.x), static_cast<float>(state.bars.y),
              static_cast<float>(state.bars.size), static_cast<float>(state.bars.skew)};
  for (std::size_t k = 0; k < 2; ++k)
    std::copy(state.maps[k].count.begin(), state.maps[k].count.end(), now.seen[k].begin());
  now.error_mm = static_cast<float>(state.error_mm);
  now.goal_mm = static_cast<float>(state.goal_mm);
  const std::lock_guard lock(mutex_);
  for (LiveFeed& feed : feeds_) feed.publish({});
  figures_ = now;
}

ui::TechnicianCalibration CalibrateJob::newest() {
  const std::lock_guard lock(mutex_);
  ui::TechnicianCalibration now = figures_;
  for (std::size_t i = 0; i < 2; ++i) {
    const LivePicture live = feeds_[i].newest();
    now.pictures[i] = {live.picture, live.number};
  }
  return now;
}

void CalibrateJob::wipe() {
  for (LiveFeed& feed : feeds_) feed.wipe();
}

}  // namespace relievo::firmware
