// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/memory/turning_rig.h"

#include <algorithm>
#include <cmath>

namespace relievo::test {
namespace {

constexpr double kDistanceMm = 560;
constexpr int kNobody = 255, kStraight = 100;

constexpr int kCutPx = (TurningPictures::kAlbumWidthPx - TurningPictures::kWidthPx) / 2;  // on either side

// Each pixel as often as the picture is enlarged, all moved by so many of the new ones.
hal::Picture enlarge(const hal::Picture& from, int right_px, int down_px) {
  constexpr int n = TurningPictures::kEnlarged;
  hal::Picture to{{}, n * TurningPictures::kWidthPx, n * TurningPictures::kHeightPx, from.format};
  const auto at = [](const hal::Picture& p, int x, int y) {
    return std::ptrdiff_t{3} * (std::ptrdiff_t{y} * p.width_px + x);
  };
  to.bytes.resize(std::size_t(at(to, 0, to.height_px)));
  const auto source = [](int i, int by, int size) { return std::clamp(i - by, 0, n * size - 1) / n; };
  for (int y = 0; y < to.height_px; ++y)
    for (int x = 0; x < to.width_px; ++x)
      std::copy_n(from.bytes.begin() + at(from, source(x + n * kCutPx, right_px, from.width_px),
                                          source(y, down_px, from.height_px)),
                  3, to.bytes.begin() + at(to, x, y));
  return to;
}

}  // namespace

pipeline::StereoCalibration TurningPictures::enlarged(pipeline::StereoCalibration of) {
  for (pipeline::CameraIntrinsics* camera : {&of.left, &of.right}) {
    camera->width_px = kWidthPx * kEnlarged, camera->height_px = kHeightPx * kEnlarged;
    camera->centre_px.x -= kCutPx;
    for (double* number : {&camera->focal_px.x, &camera->focal_px.y}) *number *= kEnlarged;
    for (double* number : {&camera->centre_px.x, &camera->centre_px.y})
      *number = (*number + 0.5) * kEnlarged - 0.5;
  }
  return of;
}

const std::array<hal::sim::PicturePair, 2>& TurningPictures::of(const Look& look) {
  const std::lock_guard lock(mutex_);
  const auto [at, fresh] = pictures_.try_emplace(look);
  if (!fresh) return at->second;
  const hal::sim::HeadPose front = standing(kDistanceMm), twin = behind(front);
  hal::sim::HeadPose nobody;
  nobody.distance_mm = 0;
  const Shot shot = look.gone
                        ? album_.shoot(look.person, nobody)
                        : album_.photograph(look.person, turned_about_neck(front, look.half_degrees / 2.0),
                                            look.company ? &twin : nullptr);
  for (std::size_t roll = 0; roll < 2; ++roll)
    at->second[roll] =
        album_.develop(shot, {.noise_seed = 2 * std::uint64_t(look.half_degrees + 999) + roll});
  return at->second;
}

Result<hal::PairSource::Exposure> TurningRig::Source::expose(Side side, std::uint32_t number) {
  if (number != number_) {
    number_ = number;
    const double passes_s = manners_.is_gone() ? kEmptyLookS : kLookS;
    clock_.advance(std::chrono::milliseconds(std::lround(1e3 * passes_s)));
    if (const auto advice = said.load()) manners_.hear(*advice, passes_s);
  }
  const TurningPictures::Look look{person_, manners_.is_gone() ? 0 : int(std::lround(2 * manners_.yaw_deg())),
                                   manners_.is_gone(), manners_.has_company()};
  const hal::sim::PicturePair& pair = pictures_.of(look)[number % 2];
  const double px_per_mm = pictures_.calibration().left.focal_px.x / kDistanceMm;
  hal::Picture picture = enlarge(side == Side::Left ? pair.left : pair.right,
                                 int(std::lround(px_per_mm * manners_.shift_mm().x)),
                                 int(std::lround(px_per_mm * manners_.shift_mm().y)));
  picture.bytes[0] = std::byte(look.gone ? kNobody : kStraight + int(std::lround(manners_.yaw_deg())));
  return Exposure{std::move(picture), std::chrono::nanoseconds(0)};
}

std::optional<int> TurningRig::true_yaw_deg(const pipeline::StereoFrame& frame) {
  const int mark = frame.left.row(0)[0];
  return mark == kNobody ? std::nullopt : std::optional(mark - kStraight);
}

}  // namespace relievo::test
