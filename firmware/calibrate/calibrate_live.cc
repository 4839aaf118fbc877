// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/calibrate/calibrate_command.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "firmware/base/budget.h"
#include "firmware/capture/stereo_grabber.h"
#include "firmware/jobs/job_thread.h"
#include "hal/base/words.h"
#include "pipeline/calibrate/file/calibration_file.h"
#include "pipeline/calibrate/live/live_calibration.h"

namespace relievo::firmware {
namespace {

constexpr std::chrono::milliseconds kPeriod{100};  // of a folder's pairs
constexpr std::string_view kFolder = "folder:";

class DevicePairs final : public LivePairs {
 public:
  // most: pairs; shown: how often each is.
  DevicePairs(std::unique_ptr<hal::Device> device, int most, int shown, bool timed)
      : device_(std::move(device)),
        memory_(budget::kStereoSlotBytes),
        slot_(memory_),
        grabber_(*device_),
        most_(most),
        shown_(shown),
        timed_(timed) {}

  Result<std::optional<LivePair>> next(const pipeline::LiveState&) override {
    if (count_ == 0) RELIEVO_TRY(grabber_.start(device_->preferred_mode()));
    if (count_ / shown_ == most_) return std::optional<LivePair>();
    if (count_ % shown_ == 0) {
      RELIEVO_TRY_ASSIGN(frame_, grabber_.grab(slot_, interrupted()));
    }
    ++count_;
    const std::chrono::nanoseconds at = timed_ ? device_->clock().now().time_since_epoch() : count_ * kPeriod;
    return std::optional<LivePair>({frame_.left, frame_.right, at});
  }
  pipeline::RigCameras cameras() const override { return grabber_.cameras(); }

 private:
  std::unique_ptr<hal::Device> device_;
  std::vector<std::byte> memory_;
  StereoSlot slot_;
  StereoGrabber grabber_;
  pipeline::StereoFrame frame_;
  int most_;
  int shown_;
  bool timed_;
  int count_ = 0;
};

using pipeline::LiveState;
using pipeline::PairVerdict;
using Steady = std::chrono::steady_clock;

std::string line_of_pair(const LiveState& s) {
  std::string line = "pair " + std::to_string(s.pairs) + ": " + pipeline::name_of(s.verdict);
  if (s.verdict == PairVerdict::Moving && s.moved_px[0] > 0)
    line += " " + decimal(std::max(s.moved_px[0], s.moved_px[1]), 1) + " px";
  if (s.verdict == PairVerdict::Blurred)
    line += ", edges of " + decimal(std::max(s.edge_px[0], s.edge_px[1]), 1) + " px";
  if (s.verdict == PairVerdict::Taken) {
    line += " as view " + std::to_string(s.views);
    if (s.error_mm > 0) line += ", predicted error " + decimal(s.error_mm, 3) + " mm";
    line += ", X " + decimal(s.bars.x, 2) + " Y " + decimal(s.bars.y, 2) + " size " +
            decimal(s.bars.size, 2) + " skew " + decimal(s.bars.skew, 2);
  }
  line += std::string("; ") + pipeline::name_of(s.advice);
  if (s.how_far > 0 && s.how_far < 2) line += " a little";
  if (s.way.size() > 1) line += ", then " + pipeline::words_of(std::span(s.way).subspan(1));
  return line;
}

std::string line_of_end(const LiveState& s, Steady::duration busy, Steady::duration slowest) {
  const double seconds = std::chrono::duration<double>(busy).count();
  return printed(
      "%s: %d of %d pairs taken, predicted error %.3f mm (goal %.3f mm), %.1f pairs a second, the slowest took %.0f ms",
      s.done() ? pipeline::name_of(s.end) : "no more pairs", s.views, s.pairs, s.error_mm, s.goal_mm,
      s.pairs / std::max(seconds, 1e-9), std::chrono::duration<double, std::milli>(slowest).count());
}

}  // namespace

Result<std::unique_ptr<LivePairs>> make_device_pairs(std::unique_ptr<hal::Device> device,
                                                     std::string_view name) {
  int most = std::numeric_limits<int>::max();
  int shown = 1;
  const bool folder = name.starts_with(kFolder);
  if (folder) {
    const Path pictures = name.substr(kFolder.size());
    RELIEVO_TRY_ASSIGN(const auto pairs, hal::find_picture_pairs(pictures));
    most = int(pairs.size());
    std::error_code error;
    if (!std::filesystem::exists(pictures / "capture.json", error)) shown = 2;
  }
  return std::unique_ptr<LivePairs>(std::make_unique<DevicePairs>(std::move(device), most, shown, !folder));
}

Result<pipeline::CalibratorOutput> run_calibrate_live(const CalibrateLiveArgs& args, LivePairs& pairs,
                                                      const Tell& tell, const RigToday& today) {
  RELIEVO_TRY(check_calibration_output(args.output));
  pipeline::LiveOptions options;
  options.goal_mm = args.goal_mm;
  options.expected_baseline_mm = args.baseline_mm.value_or(0);
  if (!args.baseline_mm) options.in_use = today.in_use;
  ThreadPool pool(pool_size());
  RELIEVO_TRY_ASSIGN(auto live, pipeline::LiveCalibration::begin(pattern_of(args.board), options, pool));
  Steady::duration busy{0};
  Steady::duration slowest{0};
  while (!live.state().done()) {
    RELIEVO_TRY_ASSIGN(const auto pair, pairs.next(live.state()));
    if (!pair) break;
    const auto begin = Steady::now();
    RELIEVO_TRY(live.look(pair->left, pair->right, pair->at));
    const auto took = Steady::now() - begin;
    busy += took;
    slowest = std::max(slowest, took);
    RELIEVO_TRY(tell(line_of_pair(live.state())));
  }
  RELIEVO_TRY(tell(line_of_end(live.state(), busy, slowest)));
  auto result = live.finish();
  if (!result) return result.error().at(args.cameras + ": " + std::string(result.error().where()));
  RELIEVO_TRY(tell_quality(result->quality, tell));
  if (result->quality.verdict == pipeline::CalibrationVerdict::Refuse)
    return Error{Errc::PoorGeometry, "the calibration is refused for the reasons above and was not written"}
        .at(args.cameras);
  result->calibration.cameras = pairs.cameras();
  RELIEVO_TRY(pipeline::write_calibration(args.output, result->calibration));
  return result;
}

}  // namespace relievo::firmware
