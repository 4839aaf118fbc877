// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/sim/held_board.h"

#include <algorithm>
#include <cmath>

#include "hal/sim/base/noise.h"

namespace relievo::hal::sim {
namespace {

constexpr double kWhite = 0.62, kBlack = 0.035, kRoom = 0.10;
constexpr int kBands = 60;
constexpr int kSamples = 32;  // of a pixel that sees an edge, spread over its area and the exposure
constexpr double kGolden = 0.6180339887498949, kPlastic = 0.7548776662466927;
constexpr int kTones = 4096;
constexpr std::size_t kNormals = 1U << 14U;
constexpr std::int64_t kNothing = -2;  // beside the paper

std::size_t index_of(int width, int x, int y) { return std::size_t(y) * std::size_t(width) + std::size_t(x); }

// From a camera's plane z = 1 to the board: the inverse of [first axis, second axis, origin].
struct ToBoard {
  Vec3 x, y, w;

  ToBoard(const SimView& view, const BodyPose& pose) {
    const Mat3 turn = view.view_from_world * pose.world_from_body;
    const Vec3 a{turn.row[0].x, turn.row[1].x, turn.row[2].x}, b{turn.row[0].y, turn.row[1].y, turn.row[2].y};
    const Vec3 c = view.view_from_world * pose.origin_mm + view.offset_mm;
    const double scale = 1 / dot(a, cross(b, c));
    x = cross(b, c) * scale;
    y = cross(c, a) * scale;
    w = cross(a, b) * scale;
  }
  Vec3 operator()(double u, double v) const {  // board x and y in mm, third: 0
    const double z = w.x * u + w.y * v + w.z;
    return {(x.x * u + x.y * v + x.z) / z, (y.x * u + y.y * v + y.z) / z, 0};
  }
};

BodyPose between(const BodyPose& a, const BodyPose& b, double t) {
  BodyPose pose;
  for (std::size_t i = 0; i < 3; ++i)
    pose.world_from_body.row[i] = mix(a.world_from_body.row[i], b.world_from_body.row[i], t);
  pose.origin_mm = mix(a.origin_mm, b.origin_mm, t);
  return pose;
}

void blur_row(const float* from, float* to, int count, std::size_t stride, std::span<const float> weight) {
  const int reach = int(weight.size()) - 1;
  for (int i = 0; i < count; ++i) {
    float sum = weight[0] * from[std::size_t(i) * stride];
    for (int k = 1; k <= reach; ++k)
      sum += weight[std::size_t(k)] * (from[std::size_t(std::max(i - k, 0)) * stride] +
                                       from[std::size_t(std::min(i + k, count - 1)) * stride]);
    to[std::size_t(i) * stride] = sum;
  }
}

}  // namespace

// One exposure by one camera.
class HeldBoard::Shot {
 public:
  Shot(const HeldBoard& board, const Eye& eye, const BodyPose& opened, const BodyPose& closed)
      : board_(board), eye_(eye), first_(eye.view, opened), last_(eye.view, closed) {
    for (int k = 0; k < kSamples; ++k)
      at_.emplace_back(eye.view, between(opened, closed, (k + 0.5) / kSamples));
    const BodyPose middle = between(opened, closed, 0.5);
    lit_ = 0.55 + 0.45 * std::abs(dot(middle.normal(), normalised(middle.origin_mm - Vec3{-200, -200, 0})));
    frame(opened);
    frame(closed);
  }

  int top() const { return std::clamp(top_ - 4, 0, eye_.view.height_px); }
  int bottom() const { return std::clamp(bottom_ + 5, top(), eye_.view.height_px); }
  int left() const { return std::clamp(left_ - 4, 0, eye_.view.width_px); }
  int right() const { return std::clamp(right_ + 5, left(), eye_.view.width_px); }

  float light(int x, int y) const {
    const std::size_t i = index_of(eye_.view.width_px, x, y);
    const double u = double(eye_.plane_x[i]), v = double(eye_.plane_y[i]);
    const double du = 0.5 / eye_.view.fx_px, dv = 0.5 / eye_.view.fy_px;
    const Spot middle = spot(at_[kSamples / 2], u, v);
    bool even = true;
    for (int k = 0; k < 8 && even; ++k)
      even = spot(k < 4 ? first_ : last_, u + (k % 2 == 0 ? -du : du), v + (k % 4 < 2 ? -dv : dv)).cell ==
             middle.cell;
    if (even) return middle.light;
    float sum = 0;
    // A lattice over area and time, with its mirror image: it pulls no edge to any side.
    for (int k = 0; k < kSamples / 2; ++k) {
      const auto share = [k](double step) { return 2 * (k * step - std::floor(k * step)) - 1; };
      const double a = du * share(kGolden), b = dv * share(kPlastic);
      const auto when = std::size_t(k);
      sum += spot(at_[when], u + a, v + b).light + spot(at_[kSamples - 1 - when], u - a, v - b).light;
    }
    return sum / kSamples;
  }

 private:
  struct Spot {
    std::int64_t cell;
    float light;
  };
  Spot spot(const ToBoard& to_board, double u, double v) const {
    const Vec3 p = to_board(u, v);
    if (!board_.pattern_.covers(p.x, p.y)) return {kNothing, float(kRoom)};
    const BoardPrint::Spot printed = board_.print_.at(p.x, p.y);
    return {printed.cell, float((printed.dark ? kBlack : kWhite) * lit_)};
  }
  void frame(const BodyPose& pose) {
    const BoardPattern& b = board_.pattern_;
    for (const double x : {-b.square_mm - b.margin_mm, b.corners_x * b.square_mm + b.margin_mm})
      for (const double y : {-b.square_mm - b.margin_mm, b.corners_y * b.square_mm + b.margin_mm}) {
        const Pixel p = eye_.view.project(pose.to_world({x, y, 0}));
        const auto whole = [](double value) { return int(std::clamp(value, -1e6, 1e6)); };
        left_ = std::min(left_, whole(p.x)), right_ = std::max(right_, whole(p.x));
        top_ = std::min(top_, whole(p.y)), bottom_ = std::max(bottom_, whole(p.y));
      }
  }

  const HeldBoard& board_;
  const Eye& eye_;
  ToBoard first_, last_;
  std::vector<ToBoard> at_;
  double lit_ = 1;
  int left_ = 1'000'000, right_ = -1'000'000, top_ = 1'000'000, bottom_ = -1'000'000;
};

BodyPose HeldPlace::pose(const BoardPattern& pattern) const {
  const Mat3 turn = rotation(0, -radians(yaw_deg), 0) *
                    (rotation(radians(pitch_deg), 0, 0) * rotation(0, 0, radians(roll_deg)));
  return with_middle_at({right_mm, down_mm, distance_mm}, turn, pattern);
}

HeldBoard::HeldBoard(const RigOptions& rig, const BoardPattern& pattern, const SensorOptions& sensor,
                     int threads)
    : rig_(make_rig(rig)), pattern_(pattern), print_(pattern), sensor_(sensor), pool_(threads) {
  prepare(rig_.left, left_);
  prepare(rig_.right, right_);
  for (int i = 0; i < kTones; ++i) {
    const double v = (i + 0.5) / kTones;
    tone_.push_back(std::uint8_t(std::lround(255 * (sensor.gamma ? srgb(v) : v))));
  }
  Random random(7);
  for (std::size_t i = 0; i < kNormals; ++i) normal_.push_back(float(random.normal()));
}

void HeldBoard::prepare(const SimView& view, Eye& eye) {
  eye.view = view;
  const std::size_t count = index_of(view.width_px, 0, view.height_px);
  eye.plane_x.resize(count);
  eye.plane_y.resize(count);
  pool_.for_each(view.height_px, kBands, [&](int y) {
    for (int x = 0; x < view.width_px; ++x) {
      const Vec3 ray = view.view_from_world * view.ray(x, y);
      eye.plane_x[index_of(view.width_px, x, y)] = float(ray.x / ray.z);
      eye.plane_y[index_of(view.width_px, x, y)] = float(ray.y / ray.z);
    }
  });
}

Picture HeldBoard::photograph(const Eye& eye, const BodyPose& opened, const BodyPose& closed,
                              std::uint64_t noise_seed) {
  const int width = eye.view.width_px, height = eye.view.height_px;
  std::vector<float> light(eye.plane_x.size(), float(kRoom));
  const Shot shot(*this, eye, opened, closed);
  pool_.for_each_band(shot.bottom() - shot.top(), kBands, [&](int begin, int end, int) {
    for (int y = shot.top() + begin; y < shot.top() + end; ++y)
      for (int x = shot.left(); x < shot.right(); ++x) light[index_of(width, x, y)] = shot.light(x, y);
  });
  const double deviation_px = sensor_.defocus_px;
  const int reach = std::max(1, int(std::ceil(3 * deviation_px)));
  std::vector<float> weight;
  double total = 0;
  for (int k = 0; k <= reach; ++k) {
    weight.push_back(float(deviation_px < 0.05 ? (k == 0 ? 1 : 0)
                                               : std::exp(-0.5 * k * k / (deviation_px * deviation_px))));
    total += (k == 0 ? 1 : 2) * double(weight.back());
  }
  for (float& w : weight) w = float(double(w) / total);
  std::vector<float> across(light.size());
  pool_.for_each(height, kBands, [&](int y) {
    blur_row(&light[index_of(width, 0, y)], &across[index_of(width, 0, y)], width, 1, weight);
  });
  pool_.for_each(width, kBands, [&](int x) {
    blur_row(&across[std::size_t(x)], &light[std::size_t(x)], height, std::size_t(width), weight);
  });
  return develop(light, eye, noise_seed);
}

Picture HeldBoard::develop(const std::vector<float>& light, const Eye& eye, std::uint64_t noise_seed) {
  Picture out{std::vector<std::byte>(light.size()), eye.view.width_px, eye.view.height_px,
              PixelFormat::Grey8};
  const auto well = float(sensor_.full_well_electrons);
  const auto read = float(sensor_.read_noise_electrons * sensor_.read_noise_electrons);
  const auto exposure = float(sensor_.exposure), noise = float(sensor_.noise);
  pool_.for_each(out.height_px, kBands, [&](int y) {
    // Stirred: neighbouring seeds give one sequence, shifted by one.
    Random random(Random(noise_seed * 65536 + std::uint64_t(y)).next());
    for (std::size_t i = index_of(out.width_px, 0, y); i < index_of(out.width_px, 0, y + 1); ++i) {
      const float electrons = light[i] * exposure * well;
      const float level =
          (electrons + noise * std::sqrt(electrons + read) * normal_[random.next() % kNormals]) / well;
      out.bytes[i] = std::byte{tone_[std::size_t(std::clamp(int(level * kTones), 0, kTones - 1))]};
    }
  });
  return out;
}

PicturePair HeldBoard::photograph(const BodyPose& opened, const BodyPose& closed, std::uint64_t noise_seed) {
  Picture left = photograph(left_, opened, closed, 2 * noise_seed);
  return {std::move(left), photograph(right_, opened, closed, 2 * noise_seed + 1)};
}

}  // namespace relievo::hal::sim
