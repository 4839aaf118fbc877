// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/board/saddle_finder.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "hal/base/simd.h"

namespace relievo::pipeline {
namespace {

// A board in a smaller picture than this has squares too small to be found.
constexpr int kMinSidePx = 160;
// Of all 16 bit pixels, this share may lie outside the 8 bit range: one hot pixel must not decide it.
constexpr double kClippedShare = 1e-3;

RELIEVO_SIMD void grey_of_rgb(const std::uint8_t* rgb, int count, std::uint8_t* grey) {
  for (int x = 0; x < count; ++x)
    grey[x] = std::uint8_t((77 * rgb[3 * x] + 150 * rgb[3 * x + 1] + 29 * rgb[3 * x + 2] + 128) >> 8);
}

int value_of(const std::uint8_t* row, int x) { return row[2 * x] | row[2 * x + 1] << 8; }

// The range that holds all but the clipped shares of a 16 bit picture, in steps of 256 at most.
std::array<int, 2> range_of(const ImageView& picture) {
  std::vector<std::size_t> count(65536);
  for (int y = 0; y < picture.height_px; ++y)
    for (int x = 0; x < picture.width_px; ++x) ++count[std::size_t(value_of(picture.row(y), x))];
  const double pixels = double(picture.width_px) * picture.height_px;
  std::array<int, 2> range{0, 65535};
  for (double sum = 0; range[0] < 65535; ++range[0])
    if ((sum += double(count[std::size_t(range[0])])) > kClippedShare * pixels) break;
  for (double sum = 0; range[1] > range[0]; --range[1])
    if ((sum += double(count[std::size_t(range[1])])) > kClippedShare * pixels) break;
  return range;
}

std::vector<std::uint8_t> grey_of(const ImageView& picture) {
  const auto width = std::size_t(picture.width_px);
  std::vector<std::uint8_t> grey(width * std::size_t(picture.height_px));
  if (picture.format == PixelFormat::Rgb8) {
    for (int y = 0; y < picture.height_px; ++y)
      grey_of_rgb(picture.row(y), picture.width_px, &grey[std::size_t(y) * width]);
    return grey;
  }
  const auto [low, high] = range_of(picture);
  const double scale = high > low ? 255.0 / (high - low) : 0;
  for (int y = 0; y < picture.height_px; ++y)
    for (int x = 0; x < picture.width_px; ++x)
      grey[std::size_t(y) * width + std::size_t(x)] =
          std::uint8_t(std::lround(std::clamp((value_of(picture.row(y), x) - low) * scale, 0.0, 255.0)));
  return grey;
}

RELIEVO_SIMD void weigh_rows(const std::uint8_t* const* rows, int width, std::uint16_t* sum) {
  for (int x = 0; x < width; ++x)
    sum[x] = std::uint16_t(rows[0][x] + 4 * rows[1][x] + 6 * rows[2][x] + 4 * rows[3][x] + rows[4][x]);
}

RELIEVO_SIMD void weigh_columns(const std::uint16_t* sum, int half_width, std::uint8_t* out) {
  for (int x = 0; x < half_width; ++x) {
    const std::uint16_t* s = sum + 2 * x;
    out[x] = std::uint8_t((s[0] + 4 * s[1] + 6 * s[2] + 4 * s[3] + s[4] + 128) >> 8);
  }
}

// The binomial filter 1 4 6 4 1 down the columns about row y, times 16; the picture's edges repeat. `sum` has
// two places more to either side: the filter along the row needs them.
void smooth_columns(const ImageView& picture, int y, std::vector<std::uint16_t>& sum) {
  std::array<const std::uint8_t*, 5> rows{};
  for (int k = 0; k < 5; ++k)
    rows[std::size_t(k)] = picture.row(std::clamp(y + k - 2, 0, picture.height_px - 1));
  weigh_rows(rows.data(), picture.width_px, sum.data() + 2);
  sum[0] = sum[1] = sum[2];
  sum.end()[-1] = sum.end()[-2] = sum.end()[-3];
}

constexpr float kUnit = 16;        // of SmoothPicture
constexpr float kMinContrast = 6;  // grey levels: less is not told from noise and texture
// Mixed derivative at a corner of contrast 1 after the smoothing, as hessian_row() scales it.
constexpr float kCornerDerivative = 0.6F * kUnit;
constexpr float kMaxShiftPx = 1.2F;   // from the pixel to the saddle
constexpr float kMaxOddShare = 0.3F;  // of the circle's odd part to its even range
constexpr float kMinOpening = 0.35F;  // rad, between two edges
constexpr int kMargin = 7;            // px, that the circle needs
constexpr int kSamples = 32;          // on the circle

RELIEVO_SIMD void smooth_row(const std::uint16_t* sum, int width, std::int16_t* out) {
  for (int x = 0; x < width; ++x)
    out[x] = std::int16_t((sum[x] + 4 * sum[x + 1] + 6 * sum[x + 2] + 4 * sum[x + 3] + sum[x + 4]) >> 4);
}

// Minus the determinant of the Hessian, from pixel 2 to width - 3. Rows: y-2 … y+2.
RELIEVO_SIMD void hessian_row(const std::int16_t* const* rows, int width, float* out) {
  const std::int16_t* a = rows[0];
  const std::int16_t* b = rows[1];
  const std::int16_t* c = rows[2];
  const std::int16_t* d = rows[3];
  const std::int16_t* e = rows[4];
  for (int x = 2; x < width - 2; ++x) {
    const auto xx = float(c[x - 2] - 2 * c[x] + c[x + 2]);
    const auto yy = float(a[x] - 2 * c[x] + e[x]);
    const auto xy = float(b[x - 1] - b[x + 1] - d[x - 1] + d[x + 1]);
    out[x] = xy * xy - xx * yy;
  }
}

struct Peak {
  float strength;
  int x, y;
};

bool highest(const std::array<const float*, 5>& rows, int x) {
  const float here = rows[2][x];
  for (const int dx : {-1, 0, 1})
    if (rows[1][x + dx] > here || rows[3][x + dx] >= here) return false;
  if (rows[2][x - 1] > here || rows[2][x + 1] >= here) return false;
  for (int dx = -2; dx <= 2; ++dx)
    if (rows[0][x + dx] > here || rows[4][x + dx] >= here) return false;
  for (std::size_t k = 1; k < 4; ++k)
    if (rows[k][x - 2] > here || rows[k][x + 2] >= here) return false;
  return true;
}

std::vector<Peak> find_peaks(const SmoothPicture& picture) {
  const int width = picture.width_px();
  const float corner = kMinContrast * kCornerDerivative;
  const float least = corner * corner;
  std::vector<Peak> peaks;
  std::array<std::vector<float>, 5> ring;
  for (auto& row : ring) row.assign(std::size_t(width), 0.F);
  for (int y = kMargin - 2; y < picture.height_px() - kMargin + 2; ++y) {
    std::array<const std::int16_t*, 5> from{};
    for (int k = 0; k < 5; ++k) from[std::size_t(k)] = picture.row(y + k - 2);
    hessian_row(from.data(), width, ring[std::size_t(y % 5)].data());
    if (y < kMargin + 2) continue;
    const int middle = y - 2;
    std::array<const float*, 5> rows{};
    for (int k = 0; k < 5; ++k) rows[std::size_t(k)] = ring[std::size_t((middle + k + 3) % 5)].data();
    for (int x = kMargin; x < width - kMargin; ++x)
      if (rows[2][x] > least && highest(rows, x)) peaks.push_back({rows[2][x], x, middle});
  }
  return peaks;
}

// To the place where the brightness has no slope. False where that is another pixel's affair.
bool settle(const SmoothPicture& picture, const Peak& peak, Saddle& out) {
  const std::int16_t* a = picture.row(peak.y - 1) + peak.x;
  const std::int16_t* b = picture.row(peak.y) + peak.x;
  const std::int16_t* c = picture.row(peak.y + 1) + peak.x;
  const float gx = float(a[1] - a[-1] + 2 * (b[1] - b[-1]) + c[1] - c[-1]) / 8;
  const float gy = float(c[-1] - a[-1] + 2 * (c[0] - a[0]) + c[1] - a[1]) / 8;
  const float xx =
      float(a[1] - 2 * a[0] + a[-1] + 2 * (b[1] - 2 * b[0] + b[-1]) + c[1] - 2 * c[0] + c[-1]) / 4;
  const float yy =
      float(a[-1] - 2 * b[-1] + c[-1] + 2 * (a[0] - 2 * b[0] + c[0]) + a[1] - 2 * b[1] + c[1]) / 4;
  const float xy = float(a[-1] - a[1] - c[-1] + c[1]) / 4;
  const float determinant = xx * yy - xy * xy;
  if (!(determinant < 0)) return false;
  const float dx = -(yy * gx - xy * gy) / determinant;
  const float dy = -(xx * gy - xy * gx) / determinant;
  if (!(std::abs(dx) < kMaxShiftPx && std::abs(dy) < kMaxShiftPx)) return false;
  out.x = float(peak.x) + dx;
  out.y = float(peak.y) + dy;
  return true;
}

struct Compass {
  std::array<float, kSamples> x{}, y{};
  Compass() {
    for (std::size_t k = 0; k < kSamples; ++k) {
      const double angle = 2 * std::numbers::pi * double(k) / kSamples;
      x[k] = float(std::cos(angle));
      y[k] = float(std::sin(angle));
    }
  }
};

// The directions where the even part of the circle crosses its middle: exactly one fall and one rise.
bool cross(const std::array<float, kSamples / 2>& even, float middle, Saddle& out) {
  constexpr int kHalf = kSamples / 2;
  constexpr float kStep = std::numbers::pi_v<float> / kHalf;
  int falls = 0;
  int rises = 0;
  float fall = 0;
  float rise = 0;
  for (int k = 0; k < kHalf; ++k) {
    const float here = even[std::size_t(k)] - middle;
    const float next = even[std::size_t((k + 1) % kHalf)] - middle;
    if ((here > 0) == (next > 0)) continue;
    const float at = (float(k) + here / (here - next)) * kStep;
    if (here > 0) ++falls, fall = at;
    else ++rises, rise = at;
  }
  if (falls != 1 || rises != 1) return false;
  constexpr float kTurn = std::numbers::pi_v<float>;
  if (rise < fall) rise += kTurn;
  if (rise - fall < kMinOpening || rise - fall > kTurn - kMinOpening) return false;
  out.edge = {Vec2f{std::cos(fall), std::sin(fall)}, Vec2f{std::cos(rise), std::sin(rise)}};
  return true;
}

bool look_around(const SmoothPicture& picture, float radius, Saddle& saddle) {
  static const Compass compass;
  constexpr std::size_t kHalf = kSamples / 2;
  std::array<float, kHalf> even{};
  float odd = 0;
  for (std::size_t k = 0; k < kHalf; ++k) {
    const float dx = radius * compass.x[k];
    const float dy = radius * compass.y[k];
    const float one = picture.at(saddle.x + dx, saddle.y + dy);
    const float other = picture.at(saddle.x - dx, saddle.y - dy);
    even[k] = (one + other) / 2;
    odd += (one - other) * (one - other) / 4;
  }
  const auto [low, high] = std::minmax_element(even.begin(), even.end());
  const float range = *high - *low;
  saddle.contrast = range / kUnit;
  if (saddle.contrast < kMinContrast || odd > kMaxOddShare * kMaxOddShare * range * range * kHalf)
    return false;
  return cross(even, (*low + *high) / 2, saddle);
}

}  // namespace

GreyPyramid::GreyPyramid(const ImageView& picture) {
  if (picture.format == PixelFormat::Grey8) views_.push_back(picture);
  else keep(grey_of(picture), picture.width_px, picture.height_px);
  // Every second pixel of every second row after the binomial filter 1 4 6 4 1; the edges repeat.
  while (std::min(views_.back().width_px, views_.back().height_px) >= 2 * kMinSidePx) {
    const ImageView from = views_.back();
    const int width = (from.width_px + 1) / 2, height = (from.height_px + 1) / 2;
    std::vector<std::uint8_t> half(std::size_t(width) * std::size_t(height));
    std::vector<std::uint16_t> sum(std::size_t(from.width_px) + 4);
    for (int y = 0; y < height; ++y) {
      smooth_columns(from, 2 * y, sum);
      weigh_columns(sum.data(), width, &half[std::size_t(y) * std::size_t(width)]);
    }
    keep(std::move(half), width, height);
  }
}

void GreyPyramid::keep(std::vector<std::uint8_t> grey, int width_px, int height_px) {
  own_.push_back(std::move(grey));
  views_.push_back({reinterpret_cast<const std::byte*>(own_.back().data()), width_px, height_px, width_px});
}

SmoothPicture::SmoothPicture(const ImageView& grey) : width_px_(grey.width_px), height_px_(grey.height_px) {
  const auto width = std::size_t(width_px_);
  values_.resize(width * std::size_t(height_px_));
  std::vector<std::uint16_t> sum(width + 4);
  for (int y = 0; y < height_px_; ++y) {
    smooth_columns(grey, y, sum);
    smooth_row(sum.data(), width_px_, &values_[std::size_t(y) * width]);
  }
}

float SmoothPicture::at(float x, float y) const {
  const int column = int(x);
  const int line = int(y);
  const float u = x - float(column);
  const float v = y - float(line);
  const std::int16_t* a = row(line) + column;
  const std::int16_t* b = a + width_px_;
  const float top = float(a[0]) + u * float(a[1] - a[0]);
  const float bottom = float(b[0]) + u * float(b[1] - b[0]);
  return top + v * (bottom - top);
}

std::vector<Saddle> find_saddles(const SmoothPicture& picture, std::size_t most) {
  constexpr float kWideRadius = 5;
  constexpr float kNarrowRadius = 3;  // where squares are small
  std::vector<Saddle> saddles;
  for (const Peak& peak : find_peaks(picture)) {
    Saddle saddle;
    if (settle(picture, peak, saddle) &&
        (look_around(picture, kWideRadius, saddle) || look_around(picture, kNarrowRadius, saddle)))
      saddles.push_back(saddle);
  }
  if (saddles.size() <= most) return saddles;
  std::nth_element(saddles.begin(), saddles.begin() + std::ptrdiff_t(most), saddles.end(),
                   [](const Saddle& a, const Saddle& b) { return a.contrast > b.contrast; });
  saddles.resize(most);
  return saddles;
}

}  // namespace relievo::pipeline
