// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <charconv>
#include <optional>

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
    const PicturePairFiles& pair = pairs_[(number - 1) % pairs_.size()];
    RELIEVO_TRY_ASSIGN(Picture picture, read_picture(side == Side::Left ? pair.left : pair.right));
    return Exposure{std::move(picture), lateness(pair, side)};
  }

 private:
  // The recording's own lateness of each camera against the earlier of the two.
  std::chrono::nanoseconds lateness(const PicturePairFiles& pair, Side side) const {
    std::int64_t number = -1;
    const char* digits = pair.rest.c_str() + (pair.rest.starts_with('_') ? 1 : 0);
    std::from_chars(digits, pair.rest.c_str() + pair.rest.size(), number);
    for (const CaptureRecord& r : capture_.frames)
      if (r.number == number)
        return std::chrono::nanoseconds((side == Side::Left ? r.left_ns : r.right_ns) -
                                        std::min(r.left_ns, r.right_ns));
    return std::chrono::nanoseconds(0);
  }

  std::vector<PicturePairFiles> pairs_;
  CaptureFile capture_;
};

Result<CaptureFile> optional_capture_file(const std::filesystem::path& folder) {
  Result<CaptureFile> capture = read_capture_file(folder / "capture.json");
  if (!capture && capture.error().code == Errc::NotFound) return CaptureFile{};
  return capture;
}

}  // namespace

Result<std::unique_ptr<Device>> make_folder_device(const std::filesystem::path& folder) {
  RELIEVO_TRY_ASSIGN(std::vector<PicturePairFiles> pairs, find_picture_pairs(folder));
  RELIEVO_TRY_ASSIGN(CaptureFile capture, optional_capture_file(folder));
  RELIEVO_TRY_ASSIGN(const Picture left, read_picture(pairs.front().left));
  RELIEVO_TRY_ASSIGN(const Picture right, read_picture(pairs.front().right));
  if (left.width_px != right.width_px || left.height_px != right.height_px)
    return Error{Errc::InvalidInput, "the left and right pictures differ in size"}.at(
        pairs.front().right.native());
  const auto exposure = capture.frames.empty() ? 0 : capture.frames.front().exposure_us;
  const CaptureMode mode{left.width_px, left.height_px, std::chrono::microseconds(exposure)};
  return std::unique_ptr<Device>(std::make_unique<ReplayDevice>(
      "folder", std::make_unique<FolderSource>(std::move(pairs), std::move(capture)), mode, false));
}

}  // namespace relievo::hal
