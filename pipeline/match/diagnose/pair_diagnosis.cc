// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/diagnose/pair_diagnosis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <utility>
#include <vector>

#include "pipeline/match/image/plane.h"

namespace relievo::pipeline {
namespace {

constexpr double kFaceWidthMm = 150;                   // a grown-up's, as in RectifiedPair::face_width_px
constexpr double kHalfWidth = 0.4, kHalfHeight = 0.5;  // of that width: an ellipse of skin, no background
constexpr int kEveryTexel = 2;                         // pixels looked at

Ellipse skin_at(double x, double y, double face_width) {
  return {x, y, kHalfWidth * face_width, kHalfHeight * face_width};
}

double white_share(const RectifiedView& view, const RectifiedPair& pair, const Ellipse& face) {
  long seen = 0, white = 0;
  for (int y = 0; y < pair.height_px; y += kEveryTexel)
    for (int x = 0; x < pair.width_px; x += kEveryTexel) {
      const std::size_t k = pair.index(x, y);
      if (!view.valid[k] || !face.holds(x, y)) continue;
      ++seen;
      if (view.grey[k] >= kWhiteGrey) ++white;
    }
  return seen > 0 ? double(white) / double(seen) : 0;
}

constexpr int kEvery = 4;               // pixels looked at for light
constexpr float kDark = 24;             // grey: the brightest thousandth of a lit face is far above it
constexpr double kTooMuchWhite = 0.25;  // share of what is lit, and of a face
constexpr float kLeastContrast = 8;     // grey, between the darkest and the brightest hundredth
constexpr double kSame = 0.5;           // mean difference in grey: the noise of two pictures alone is more
constexpr int kReducedWidth = 120;      // pixels: so few that a face's relief does not matter
constexpr double kAlike = 0.75;         // correlation of the patch at its best place
constexpr int kRowsApart = 1;           // reduced pixels; what is less matching copes with or judges itself

enum class Light : std::uint8_t { Good, Dark, Overexposed, Blank };

// Row y alone.
void read_row(const ImageView& picture, int y, std::pmr::vector<float>& to) {
  ImageView row = picture;
  row.bytes += std::ptrdiff_t(y) * picture.stride_bytes;
  row.height_px = 1;
  grey_row(row, 0, to.data());
}

Light judge_light(const ImageView& picture, std::pmr::memory_resource* memory) {
  std::array<long, 256> histogram{};
  std::pmr::vector<float> row(std::size_t(picture.width_px), memory);
  long all = 0;
  for (int y = 0; y < picture.height_px; y += kEvery) {
    read_row(picture, y, row);
    for (int x = 0; x < picture.width_px; x += kEvery, ++all)
      ++histogram[std::size_t(std::clamp(row[std::size_t(x)], 0.0F, 255.0F))];
  }
  const auto level = [&](double share) {
    long seen = 0;
    int grey = 0;
    while (grey < 255 && double(seen + histogram[std::size_t(grey)]) < share * double(all))
      seen += histogram[std::size_t(grey++)];
    return float(grey);
  };
  if (level(0.999) < kDark) return Light::Dark;
  long lit = 0, white = 0;
  for (int grey = int(kDark); grey < 256; ++grey) {
    lit += histogram[std::size_t(grey)];
    white += float(grey) >= kWhiteGrey ? histogram[std::size_t(grey)] : 0;
  }
  if (double(white) > kTooMuchWhite * double(lit)) return Light::Overexposed;
  return level(0.99) - level(0.01) < kLeastContrast ? Light::Blank : Light::Good;
}

bool same_picture(const StereoFrame& frame, std::pmr::memory_resource* memory) {
  if (frame.left.width_px != frame.right.width_px || frame.left.height_px != frame.right.height_px)
    return false;
  const auto width = std::size_t(frame.left.width_px);
  std::pmr::vector<float> left(width, memory), right(width, memory);
  double sum = 0;
  std::size_t count = 0;
  for (int y = 0; y < frame.left.height_px; y += kEvery) {
    read_row(frame.left, y, left);
    read_row(frame.right, y, right);
    for (std::size_t x = 0; x < width; ++x, ++count) sum += double(std::abs(left[x] - right[x]));
  }
  return count > 0 && sum / double(count) < kSame;
}

Plane<float> reduce(const std::pmr::vector<float>& grey, const RectifiedPair& pair,
                    std::pmr::memory_resource* memory) {
  const int by = std::max(1, pair.width_px / kReducedWidth);
  Plane<float> small(memory, pair.width_px / by, pair.height_px / by);
  for (int y = 0; y < small.height * by; ++y)
    for (int x = 0; x < small.width * by; ++x) small.row(y / by)[x / by] += grey[pair.index(x, y)];
  return small;
}

struct Box {
  int x, y, width, height;
};

double correlation(const Plane<float>& left, const Box& box, const Plane<float>& right, int dx, int dy) {
  double l = 0, r = 0, ll = 0, rr = 0, lr = 0;
  for (int y = box.y; y < box.y + box.height; ++y) {
    const float* a = left.row(y);
    const float* b = right.row(y + dy) + dx;
    for (int x = box.x; x < box.x + box.width; ++x) {
      const double p = double(a[x]), q = double(b[x]);
      l += p, r += q, ll += p * p, rr += q * q, lr += p * q;
    }
  }
  const double n = double(box.width) * box.height;
  const double spread = (ll - l * l / n) * (rr - r * r / n);
  return spread > 0 ? (lr - l * r / n) / std::sqrt(spread) : 0;
}

struct Place {
  double alike = -1;
  int dx = 0, dy = 0;
};

// Where the middle of the left view lies in the right one.
Place find_middle(const RectifiedPair& pair, std::pmr::memory_resource* memory) {
  const Plane<float> left = reduce(pair.left.grey, pair, memory);
  const Plane<float> right = reduce(pair.right.grey, pair, memory);
  const Box box{left.width / 3, left.height / 4, left.width / 3, left.height / 2};
  Place best;
  for (int dy = -box.y; dy + box.y + box.height <= right.height; ++dy)
    for (int dx = -box.x; dx + box.x + box.width <= right.width; ++dx)
      if (const double alike = correlation(left, box, right, dx, dy); alike > best.alike)
        best = {alike, dx, dy};
  return best;
}

std::optional<PairFault> fault_of_light(Light left, Light right) {
  constexpr std::array<std::pair<Light, std::array<PairFault, 3>>, 3> kFaults{{
      {Light::Dark, {PairFault::LeftDark, PairFault::RightDark, PairFault::BothDark}},
      {Light::Overexposed,
       {PairFault::LeftOverexposed, PairFault::RightOverexposed, PairFault::BothOverexposed}},
      {Light::Blank, {PairFault::LeftBlank, PairFault::RightBlank, PairFault::BothBlank}},
  }};
  for (const auto& [light, faults] : kFaults)
    if (left == light || right == light) return faults[left != light ? 1 : right != light ? 0 : 2];
  return std::nullopt;
}

struct Words {
  Errc code;
  Literal what;
};
constexpr std::array<Words, 12> kWords{{
    // In the order of PairFault.
    {Errc::InvalidInput, "left and right are the same picture: give one of each camera"},
    {Errc::NoFace,
     "the left picture is black: is its lens covered, its light off or the exposure too short?"},
    {Errc::NoFace,
     "the right picture is black: is its lens covered, its light off or the exposure too short?"},
    {Errc::NoFace, "both pictures are black: put light on the face, or expose longer"},
    {Errc::NoFace, "the left picture is over-exposed: less light, or a shorter exposure"},
    {Errc::NoFace, "the right picture is over-exposed: less light, or a shorter exposure"},
    {Errc::NoFace, "both pictures are over-exposed: less light, or a shorter exposure"},
    {Errc::NoFace, "the left picture shows nothing but one grey: is its lens covered or far out of focus?"},
    {Errc::NoFace, "the right picture shows nothing but one grey: is its lens covered or far out of focus?"},
    {Errc::NoFace, "both pictures show nothing but one grey: are the lenses covered or far out of focus?"},
    {Errc::NotCalibrated,
     "one picture lies higher than the other: a camera has moved since it was calibrated, or the pictures are not a pair; calibrate again"},
    {Errc::InvalidInput,
     "left and right are swapped: give the left camera's picture first, or calibrate anew if the cameras changed places"},
}};
static_assert(kWords.size() == std::size_t(PairFault::Swapped) + 1);

}  // namespace

Overexposure measure_overexposure(const RectifiedPair& pair, const MatchSet& matches) {
  if (pair.face_width_px <= 0) return {};
  const Ellipse left = skin_at(pair.face_centre_px.x, pair.face_centre_px.y, pair.face_width_px);
  double sum = 0;
  long count = 0;
  for (const Match& m : matches.matches) {
    if (m.rejected_by != 0 || !left.holds(double(m.left_px.x), double(m.left_px.y))) continue;
    sum += double(m.disparity_px);
    ++count;
  }
  Ellipse right = left;
  right.x -= count > 0 ? sum / double(count) : 0;
  return {white_share(pair.left, pair, left), white_share(pair.right, pair, right)};
}

Overexposure guess_overexposure(const RectifiedPair& pair) {
  const double px_per_mm = pair.focal_px / ((pair.near_mm + pair.far_mm) / 2);
  const double aside = px_per_mm * pair.baseline_mm / 2;
  const auto share = [&](const RectifiedView& view, double x) {
    return white_share(view, pair, skin_at(x, pair.height_px / 2.0, px_per_mm * kFaceWidthMm));
  };
  return {share(pair.left, pair.left_centre_px.x + aside), share(pair.right, pair.right_centre_px.x - aside)};
}

std::optional<PairFault> diagnose_pair(const StereoFrame& frame, const StereoCalibration& calibration,
                                       const RectifierOptions& volume, StageContext& context) {
  if (frame.left.empty() || frame.right.empty()) return std::nullopt;
  Arena::Mark products(context.output);
  Arena::Mark work(context.scratch);
  if (const auto light = fault_of_light(judge_light(frame.left, &context.scratch),
                                        judge_light(frame.right, &context.scratch)))
    return light;
  if (same_picture(frame, &context.scratch)) return PairFault::SamePicture;
  const auto pair = volume.rectify(frame, calibration, context);
  if (!pair) return std::nullopt;
  // A white face before a dark wall is little of the picture, and all that matters of it.
  const Overexposure white = guess_overexposure(*pair);
  const auto judge = [](double share) { return share > kTooMuchWhite ? Light::Overexposed : Light::Good; };
  if (const auto light = fault_of_light(judge(white.left), judge(white.right))) return light;
  const Place middle = find_middle(*pair, &context.scratch);
  return middle.alike > kAlike && std::abs(middle.dy) > kRowsApart ? std::optional(PairFault::Shifted)
                                                                   : std::nullopt;
}

Error error_of(PairFault fault) {
  const Words& words = kWords[std::size_t(fault)];
  return {words.code, words.what};
}

}  // namespace relievo::pipeline
