// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/capture/stereo_grabber.h"

#include <algorithm>
#include <cmath>

namespace relievo::firmware {
namespace {

// Pairs are equally sharp within this share.
constexpr double kAlike = 0.1;

bool is_better(const BurstPair& pair, const BurstPair& best, double sharpest) {
  if (pair.sharpness > (1 + kAlike) * best.sharpness) return true;
  return pair.sharpness >= (1 - kAlike) * sharpest && pair.movement < best.movement;
}

}  // namespace

Result<Thumbnail> thumbnail(const ImageView& view, const FaceBox& box) {
  const int left = std::max(box.x_px, 0);
  const int top = std::max(box.y_px, 0);
  const int width = std::min(box.x_px + box.width_px, view.width_px) - left;
  const int height = std::min(box.y_px + box.height_px, view.height_px) - top;
  if (view.empty() || width < Thumbnail::kWidth || height < Thumbnail::kHeight)
    return invalid("the face is not in the picture: whether it moves cannot be seen");
  Thumbnail small;
  for (int v = 0; v < Thumbnail::kHeight; ++v)
    for (int u = 0; u < Thumbnail::kWidth; ++u) {
      const int x0 = left + u * width / Thumbnail::kWidth;
      const int x1 = left + (u + 1) * width / Thumbnail::kWidth;
      const int y0 = top + v * height / Thumbnail::kHeight;
      const int y1 = top + (v + 1) * height / Thumbnail::kHeight;
      long sum = 0;
      for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x) sum += level_of(view.row(y), x, view.format);
      const auto cell = std::size_t(v * Thumbnail::kWidth + u);
      small.level[cell] = float(sum) / (255.0F * float((x1 - x0) * (y1 - y0)));
    }
  return small;
}

double movement(const Thumbnail& a, const Thumbnail& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.level.size(); ++i) sum += std::abs(double(a.level[i]) - double(b.level[i]));
  return sum / double(a.level.size());
}

Result<BurstResult> take_burst(StereoGrabber& grabber, StereoSlot& first, StereoSlot& second,
                               const BurstOptions& options, const std::atomic<bool>& cancelled) {
  if (options.pairs < 1 || options.pairs > kMostBurstPairs) return invalid("a burst is of 1 to 16 pairs");
  BurstResult result;
  StereoSlot* free = &first;
  StereoSlot* best = &second;
  std::optional<Thumbnail> before;
  int taken = 0;
  double sharpest = 0;
  for (int i = 0; i < options.pairs; ++i) {
    const auto frame = grabber.grab(*free, cancelled, options.light);
    if (!frame) {
      const bool over =
          frame.error().code == Errc::Cancelled || (frame.error().code == Errc::Disconnected && taken == 0);
      if (over || (i + 1 == options.pairs && taken == 0)) return frame.error();
      if (frame.error().code == Errc::Disconnected) break;  // what has been taken stands
      continue;
    }
    const FaceBox box = options.face.value_or(middle_box(frame->left));
    RELIEVO_TRY_ASSIGN(const FaceLight left, face_light(frame->left, box));
    RELIEVO_TRY_ASSIGN(const FaceLight right, face_light(frame->right, box));
    RELIEVO_TRY_ASSIGN(const Thumbnail now, thumbnail(frame->left, box));
    BurstPair& pair = result.pairs[std::size_t(i)];
    pair.sharpness = std::min(left.sharpness, right.sharpness);
    if (before) pair.movement = movement(*before, now);
    sharpest = std::max(sharpest, pair.sharpness);
    BurstPair& leader = result.pairs[std::size_t(result.best)];
    if (taken == 1) leader.movement = pair.movement;  // the first had none before it
    before = now;
    if (++taken > 1 && !is_better(pair, leader, sharpest)) continue;
    result.frame = *frame;
    result.best = i;
    std::swap(free, best);
  }
  return result;
}

}  // namespace relievo::firmware
