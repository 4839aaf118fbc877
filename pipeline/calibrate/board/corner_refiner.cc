// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/board/corner_refiner.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

#include "hal/base/simd.h"

namespace relievo::pipeline {
namespace {

constexpr std::size_t kLanes = CornerWindow::kLanes;

struct Frame {
  float sin1, cos1, sin2, cos2;
  float width1, width2, per_width1, per_width2;
  float half1, half2, per_pixel1, per_pixel2;  // of a pixel across each edge
  float per_reach;
};

struct Step {
  float value, by_distance, by_width;
};

// The blurred step F is the integral of (1 - u²)⁴, nearly a normal curve of deviation width / 3.3, with
// an end: beyond its width an edge has no say. A pixel collects it over its own breadth, 2 half, as a
// difference of F's integral: a sharp edge is as well placed in it as a soft one.

inline __attribute__((always_inline)) Step step_at(float s, float width, float per_width, float half,
                                                   float per_pixel) {
  constexpr float kScale = 315.F / 128;
  float value[2] = {};
  float integral[2] = {};
  float inner[2] = {};
  for (int k = 0; k < 2; ++k) {
    const float u = (k == 0 ? s + half : s - half) * per_width;
    const float size = u < 0 ? -u : u;
    const float c = size > 1 ? 1.F : size;
    const float r = c * c;
    const float f = kScale * c * (1 + r * (-4.F / 3 + r * (6.F / 5 + r * (-4.F / 7 + r / 9))));
    integral[k] =
        kScale * r * (1.F / 2 + r * (-1.F / 3 + r * (1.F / 5 + r * (-1.F / 14 + r / 90)))) + size - c;
    inner[k] = integral[k] - size * f;
    value[k] = u < 0 ? -f : f;
  }
  return {width * (integral[0] - integral[1]) * per_pixel, (value[0] - value[1]) * per_pixel,
          (inner[0] - inner[1]) * per_pixel};
}

RELIEVO_SIMD void fill_columns(const float* x, const float* y, const float* value, const float* weight,
                               std::size_t count, const float* p, const Frame& f, float* const* out) {
  for (std::size_t i = 0; i < count; ++i) {
    const float dx = x[i] - p[CornerModel::X];
    const float dy = y[i] - p[CornerModel::Y];
    const Step one = step_at(f.cos1 * dy - f.sin1 * dx, f.width1, f.per_width1, f.half1, f.per_pixel1);
    const Step two = step_at(f.sin2 * dx - f.cos2 * dy, f.width2, f.per_width2, f.half2, f.per_pixel2);
    const float q = one.value * two.value;
    const float lx = x[i] * f.per_reach;
    const float ly = y[i] * f.per_reach;
    const float w = weight[i];
    const float swing = p[CornerModel::Swing] + p[CornerModel::SwingX] * lx + p[CornerModel::SwingY] * ly;
    const float by_q = w * (swing + 2 * p[CornerModel::Tone] * q);
    const float by_s1 = by_q * two.value * one.by_distance;
    const float by_s2 = by_q * one.value * two.by_distance;
    out[CornerModel::X][i] = by_s1 * f.sin1 - by_s2 * f.sin2;
    out[CornerModel::Y][i] = by_s2 * f.cos2 - by_s1 * f.cos1;
    out[CornerModel::Angle1][i] = -by_s1 * (f.cos1 * dx + f.sin1 * dy);
    out[CornerModel::Angle2][i] = by_s2 * (f.cos2 * dx + f.sin2 * dy);
    out[CornerModel::Width1][i] = by_q * two.value * one.by_width;
    out[CornerModel::Width2][i] = by_q * one.value * two.by_width;
    out[CornerModel::Light][i] = w;
    out[CornerModel::LightX][i] = w * lx;
    out[CornerModel::LightY][i] = w * ly;
    out[CornerModel::Swing][i] = w * q;
    out[CornerModel::SwingX][i] = w * q * lx;
    out[CornerModel::SwingY][i] = w * q * ly;
    out[CornerModel::Tone][i] = w * q * q;
    const float expected = p[CornerModel::Light] + p[CornerModel::LightX] * lx + p[CornerModel::LightY] * ly +
                           swing * q + p[CornerModel::Tone] * q * q;
    out[CornerModel::Count][i] = w * (value[i] - expected);
  }
}

// Lanes, because the order of a sum is the compiler's only where it is told so.
RELIEVO_SIMD float product(const float* a, const float* b, std::size_t count) {
  float lane[kLanes] = {};
  for (std::size_t i = 0; i < count; i += kLanes)
    for (std::size_t k = 0; k < kLanes; ++k) lane[k] += a[i + k] * b[i + k];
  float sum = 0;
  for (const float one : lane) sum += one;
  return sum;
}

// The window reaches this share of the way to the next corner: clear of its crossing edges. Beyond
// the most pixels the lens bends an edge more than its pixels are worth.
constexpr double kReachShare = 0.42;
constexpr double kMaxReachPx = 20;
constexpr double kMinReachPx = 2.5;
constexpr double kFirstWidthPx = 4;  // of the blurred step: a blur of 1.2 px
constexpr double kFirstWidthShare =
    0.5;  // at most, of what is plain beside the edge: the window must show its flanks
constexpr double kMinWidthPx = 1;
constexpr double kAngleDeviation = 0.04;  // rad: how far the neighbours' directions may err
constexpr double kWidthDeviation = 2;     // px
constexpr int kMaxRounds = 8;
constexpr double kNearPx = 0.1;  // where the window may be moved
constexpr double kSettledPx = 0.002;
// What a corner must be to be trusted.
constexpr double kMaxDriftShare = 0.2;   // of the distance to the next corner
constexpr double kMinSwing = 2.5;        // grey levels
constexpr double kMaxMisfit = 0.08;      // of a half edge's mean residual to the swing, beyond what
constexpr double kMisfitDeviations = 4;  // noise makes of it
constexpr double kMaxNoise = 0.6;        // of the residuals to the swing
// Light and contrast may change so much from the window's middle to its edge, as a share of the swing:
// a lamp from the side does less, a corner where only three squares meet does more.
constexpr double kMaxSlope = 0.6;
constexpr double kMaxSigmaPx = 0.25;

double length(const Vec2d& v) { return std::hypot(v.x, v.y); }
double cross(const Vec2d& a, const Vec2d& b) { return a.x * b.y - a.y * b.x; }

// The largest share of the steps within which the whole window lies in the picture.
double reach_inside(const ImageView& picture, const Vec2d& at, const CornerGuess& guess, double share) {
  const double wide = std::abs(guess.along_row.x) + std::abs(guess.along_column.x);
  const double high = std::abs(guess.along_row.y) + std::abs(guess.along_column.y);
  const double room_x = std::min(at.x, picture.width_px - 1 - at.x);
  const double room_y = std::min(at.y, picture.height_px - 1 - at.y);
  return std::min({share, room_x / std::max(wide, 1e-9), room_y / std::max(high, 1e-9)});
}

}  // namespace

void CornerRefiner::sum_up(bool information) {
  const std::size_t length = window_.x.size();
  std::array<float*, CornerModel::Count + 1> out{};
  for (std::size_t k = 0; k < out.size(); ++k) {
    if (scratch_[k].size() < length) scratch_[k].resize(length);
    out[k] = scratch_[k].data();
  }
  const auto& p = model_.p;
  Frame f{};
  f.sin1 = std::sin(p[CornerModel::Angle1]), f.cos1 = std::cos(p[CornerModel::Angle1]);
  f.sin2 = std::sin(p[CornerModel::Angle2]), f.cos2 = std::cos(p[CornerModel::Angle2]);
  f.width1 = p[CornerModel::Width1], f.width2 = p[CornerModel::Width2];
  f.per_width1 = 1 / f.width1, f.per_width2 = 1 / f.width2;
  f.half1 = std::max(std::abs(f.sin1), std::abs(f.cos1)) / 2,
  f.half2 = std::max(std::abs(f.sin2), std::abs(f.cos2)) / 2;
  f.per_pixel1 = 0.5F / f.half1, f.per_pixel2 = 0.5F / f.half2;
  f.per_reach = 1 / window_.reach_px;
  fill_columns(window_.x.data(), window_.y.data(), window_.value.data(), window_.weight.data(), length,
               p.data(), f, out.data());
  constexpr auto kResidual = std::size_t(CornerModel::Count);
  for (std::size_t a = 0; a < kResidual; ++a) {
    sums_.slope(int(a)) = double(product(out[a], out[kResidual], length));
    for (std::size_t b = a; information && b < kResidual; ++b)
      sums_.information(int(a), int(b)) = sums_.information(int(b), int(a)) =
          double(product(out[a], out[b], length));
  }
  sums_.squared = double(product(out[kResidual], out[kResidual], length));
  sums_.strip_mean.fill(0);
  sums_.strip_count.fill(0);
  for (std::size_t i = 0; i < window_.count(); ++i) {
    sums_.strip_mean[window_.strip[i]] += double(out[kResidual][i]);
    sums_.strip_count[window_.strip[i]] += 1;
  }
  for (std::size_t k = 0; k < sums_.strip_mean.size(); ++k)
    sums_.strip_mean[k] /= std::max(sums_.strip_count[k], 1.0);
}

CornerFit CornerRefiner::refine(const CornerGuess& guess) {
  const double area = cross(guess.along_row, guess.along_column);
  const double row = length(guess.along_row);
  const double column = length(guess.along_column);
  if (!(area > 0.2 * row * column)) return {};
  first_angle_ = {float(std::atan2(guess.along_row.y, guess.along_row.x)),
                  float(std::atan2(guess.along_column.y, guess.along_column.x))};
  model_.p[CornerModel::Angle1] = first_angle_[0];
  model_.p[CornerModel::Angle2] = first_angle_[1];
  // A coarse fit may move the window; the second has it in the middle of the corner.
  Vec2d at = guess.at;
  const double plain_px = clear_share_ * area / std::max(row, column);
  const double width = std::clamp(kFirstWidthShare * plain_px, kMinWidthPx, kFirstWidthPx);
  model_.p[CornerModel::Width1] = model_.p[CornerModel::Width2] = float(width);
  for (const bool coarse : {true, false}) {
    if (!gather(guess, at) || !solve(coarse)) return {};
    at = {at.x + double(model_.p[CornerModel::X]), at.y + double(model_.p[CornerModel::Y])};
    if (length({at.x - guess.at.x, at.y - guess.at.y}) > kMaxDriftShare * std::min(row, column)) return {};
    if (coarse && !plausible(guess)) return {};
  }
  return judged(guess, at);
}

// The pixels beside the two edges, within reach of both squares' plain parts.
bool CornerRefiner::gather(const CornerGuess& guess, const Vec2d& at) {
  const double width = double(std::max(model_.p[CornerModel::Width1], model_.p[CornerModel::Width2]));
  const Vec2d& u = guess.along_row;
  const Vec2d& v = guess.along_column;
  const double area = cross(u, v);
  const double longest = std::max(length(u), length(v));
  const double reach =
      reach_inside(picture_, at, guess, std::min(kReachShare, kMaxReachPx / std::min(length(u), length(v))));
  if (!(reach * std::min(length(u), length(v)) >= kMinReachPx)) return false;
  const double reach_u = std::min(reach, kMaxReachPx / length(u));
  const double reach_v = std::min(reach, kMaxReachPx / length(v));
  // Half the strip along each edge: past the blur, before the markers' own blur.
  const auto strip = [&](double height) {
    return std::min(1.2 * width + 1.5, std::max(2.0, clear_share_ * height - 0.7 * width));
  };
  const double beside_u = strip(area / length(u)) * length(u) / area;  // in steps
  const double beside_v = strip(area / length(v)) * length(v) / area;
  for (auto* column : window_.columns()) column->clear();
  window_.strip.clear();
  window_.reach_px = float(reach * longest);
  const double wide = reach_u * std::abs(u.x) + reach_v * std::abs(v.x);
  const double high = reach_u * std::abs(u.y) + reach_v * std::abs(v.y);
  const int left = std::max(0, int(std::ceil(at.x - wide)));
  const int right = std::min(picture_.width_px - 1, int(std::floor(at.x + wide)));
  const int top = std::max(0, int(std::ceil(at.y - high)));
  const int bottom = std::min(picture_.height_px - 1, int(std::floor(at.y + high)));
  for (int y = top; y <= bottom; ++y)
    for (int x = left; x <= right; ++x) {
      const Vec2d d{x - at.x, y - at.y};
      const double a = cross(d, v) / area;
      const double b = cross(u, d) / area;
      if (std::abs(a) > reach_u || std::abs(b) > reach_v) continue;
      if (std::abs(b) > beside_u && std::abs(a) > beside_v) continue;
      const bool along_u = std::abs(b) * beside_v < std::abs(a) * beside_u;
      const int part = (along_u ? 0 : 4) + ((along_u ? a : b) > 0 ? 2 : 0) + ((along_u ? b : a) > 0 ? 1 : 0);
      window_.x.push_back(float(d.x));
      window_.y.push_back(float(d.y));
      window_.value.push_back(float(picture_.row(y)[x]));
      window_.weight.push_back(1);
      window_.strip.push_back(static_cast<unsigned char>(part));
    }
  const std::size_t whole = (window_.count() + kLanes - 1) / kLanes * kLanes;
  for (auto* column : window_.columns()) column->resize(whole, 0.F);
  return window_.count() >= 3 * CornerModel::Count;
}

bool CornerRefiner::solve(bool coarse) {
  auto& p = model_.p;
  if (coarse) {
    std::fill(p.begin() + CornerModel::Light, p.end(), 0.F);
    p[CornerModel::X] = p[CornerModel::Y] = 0;
    sum_up(true);
    constexpr int kLinear = CornerModel::Count - CornerModel::kShapes;
    Eigen::Matrix<double, kLinear, kLinear> n = sums_.information.bottomRightCorner<kLinear, kLinear>();
    n.diagonal().array() += 1e-3;
    const Eigen::Matrix<double, kLinear, 1> step = n.ldlt().solve(sums_.slope.tail<kLinear>());
    for (int i = 0; i < kLinear; ++i) p[std::size_t(CornerModel::kShapes + i)] += float(step(i));
  }
  p[CornerModel::X] = p[CornerModel::Y] = 0;  // the window has moved there
  for (int round = 0; round < kMaxRounds; ++round) {
    sum_up(coarse || round == 0);
    const double moved = step_all();
    if (!(moved < 1e3)) return false;
    if (moved < (coarse ? kNearPx : kSettledPx)) return true;
  }
  return true;
}

// One Gauss-Newton step with weak beliefs about directions and blur; returns how far the corner moved.
double CornerRefiner::step_all() {
  auto& p = model_.p;
  CornerMatrix n = sums_.information;
  CornerVector g = sums_.slope;
  const double variance = std::max(sums_.squared / double(window_.count()), 0.1);
  const auto believe = [&](int i, double difference, double deviation) {
    n(i, i) += variance / (deviation * deviation);
    g(i) -= variance / (deviation * deviation) * difference;
  };
  believe(CornerModel::Angle1, double(p[CornerModel::Angle1] - first_angle_[0]), kAngleDeviation);
  believe(CornerModel::Angle2, double(p[CornerModel::Angle2] - first_angle_[1]), kAngleDeviation);
  // Of the blur's two widths only the difference is doubted: a lens is round.
  const double apart = double(p[CornerModel::Width1] - p[CornerModel::Width2]);
  believe(CornerModel::Width1, apart, kWidthDeviation);
  believe(CornerModel::Width2, -apart, kWidthDeviation);
  n.diagonal().array() += 1e-3;
  const CornerVector step = n.ldlt().solve(g);
  if (!step.allFinite()) return 1e9;
  const double moved = std::hypot(step(CornerModel::X), step(CornerModel::Y));
  const double widest = double(std::max(p[CornerModel::Width1], p[CornerModel::Width2]));
  const double scale = std::min(1.0, 0.4 * widest / std::max(moved, 1e-9));
  for (int i = 0; i < CornerModel::Count; ++i) p[std::size_t(i)] += float(scale * step(i));
  const auto most = std::max(float(kMinWidthPx), 0.9F * window_.reach_px);
  for (const int i : {CornerModel::Width1, CornerModel::Width2})
    p[std::size_t(i)] = std::clamp(p[std::size_t(i)], float(kMinWidthPx), most);
  return moved;
}

// What needs no second look.
bool CornerRefiner::plausible(const CornerGuess& guess) const {
  const double swing = double(model_.p[CornerModel::Swing]) * (guess.dark ? -1 : 1);
  if (!(swing >= kMinSwing)) return false;
  for (const int i : {CornerModel::LightX, CornerModel::LightY, CornerModel::SwingX, CornerModel::SwingY})
    if (!(std::abs(double(model_.p[std::size_t(i)])) <= kMaxSlope * swing)) return false;
  return true;
}

CornerFit CornerRefiner::judged(const CornerGuess& guess, const Vec2d& at) const {
  if (!plausible(guess)) return {};
  const double swing = std::abs(double(model_.p[CornerModel::Swing]));
  const double variance = sums_.squared / double(window_.count() - CornerModel::Count);
  if (!(variance <= kMaxNoise * kMaxNoise * swing * swing)) return {};
  for (std::size_t k = 0; k < sums_.strip_mean.size(); ++k) {
    const double noise = kMisfitDeviations * std::sqrt(variance / std::max(sums_.strip_count[k], 1.0));
    if (!(std::abs(sums_.strip_mean[k]) <= kMaxMisfit * swing + noise)) return {};
  }
  CornerMatrix n = sums_.information;
  n.diagonal().array() += 1e-3;
  const CornerMatrix covariance = n.ldlt().solve(CornerMatrix::Identity());
  const double worst =
      std::max(covariance(CornerModel::X, CornerModel::X), covariance(CornerModel::Y, CornerModel::Y));
  const double sigma = std::sqrt(variance * worst);
  if (!(sigma <= kMaxSigmaPx)) return {};
  return {at, double(model_.p[CornerModel::Light]), swing};
}

}  // namespace relievo::pipeline
