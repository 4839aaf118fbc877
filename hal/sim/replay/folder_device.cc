// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <atomic>
#include <charconv>

#include "hal/recording/capture_file.h"
#include "hal/sim/device.h"
#include "hal/sim/replay/replay_device.h"

namespace relievo::hal {
namespace {

class FolderSource final : public PairSource {
 public:
  FolderSource(std::vector<PicturePairFiles> pairs, CaptureFile capture)
      : pairs_(std::move(pairs)), capture_(std::move(capture)) {}

  Result<Exposure> expose(Side side, std::uint32_t number) override {
    // Both cameras see the same pair, whenever the head is asked to turn.
    if (number != number_) at_ = capture_.head ? wanted_.load() : (number - 1) % pairs_.size();
    number_ = number;
    const PicturePairFiles& pair = pairs_[at_];
    RELIEVO_TRY_ASSIGN(Picture picture, read_picture(side == Side::Left ? pair.left : pair.right));
    return Exposure{std::move(picture), lateness(pair, side)};
  }

  // Of a recorded head: its next side, whichever that is; in front at 0, and after the last from the first
  // on.
  void turn_head(double yaw_deg) override {
    const std::size_t sides = pairs_.size() - 1;
    wanted_.store(yaw_deg == 0 || sides == 0 ? 0 : wanted_.load() % sides + 1);
  }

 private:
  // The recording's own lateness of each camera against the earlier of the two.
  std::chrono::nanoseconds lateness(const PicturePairFiles& pair, Side side) const {
    std::int64_t number = -1;
    std::from_chars(pair.name.data(), pair.name.data() + pair.name.size(), number);
    for (const CaptureRecord& r : capture_.frames)
      if (r.number == number)
        return std::chrono::nanoseconds((side == Side::Left ? r.left_ns : r.right_ns) -
                                        std::min(r.left_ns, r.right_ns));
    return std::chrono::nanoseconds(0);
  }

  std::vector<PicturePairFiles> pairs_;
  CaptureFile capture_;
  std::atomic<std::size_t> wanted_ = 0;  // from main to capture
  std::size_t at_ = 0;                   // capture, as the next
  std::uint32_t number_ = 0;
};

}  // namespace

Result<std::unique_ptr<Device>> make_folder_device(const std::filesystem::path& folder) {
  RELIEVO_TRY_ASSIGN(std::vector<PicturePairFiles> pairs, find_picture_pairs(folder));
  RELIEVO_TRY_ASSIGN(CaptureFile capture, capture_file_in(folder));
  if (capture.head) RELIEVO_TRY(recorded_pictures(folder));
  RELIEVO_TRY_ASSIGN(const Picture left, read_picture(pairs.front().left));
  RELIEVO_TRY_ASSIGN(const Picture right, read_picture(pairs.front().right));
  if (left.width_px != right.width_px || left.height_px != right.height_px)
    return invalid("the left and right pictures differ in size").at(pairs.front().right.native());
  const auto exposure = capture.frames.empty() ? 0 : capture.frames.front().exposure_us;
  const CaptureMode mode{left.width_px, left.height_px, std::chrono::microseconds(exposure)};
  return std::unique_ptr<Device>(std::make_unique<ReplayDevice>(
      "folder", std::make_unique<FolderSource>(std::move(pairs), std::move(capture)), mode, false));
}

}  // namespace relievo::hal
