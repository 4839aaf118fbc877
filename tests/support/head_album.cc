// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/head_album.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>

#include "hal/base/whole_file.h"
#include "hal/sim/base/noise.h"
#include "hal/sim/head/shape/head_traits.h"
#include "hal/sim/target/target_photo.h"
#include "pipeline/gate/head/head_measurement.h"
#include "tests/support/head_landmarks.h"
#include "tests/support/rig_calibration.h"
#include "tests/support/small_device.h"

namespace relievo::test {
namespace {

namespace sim = hal::sim;
constexpr double kDegree = std::numbers::pi / 180;
constexpr int kWidth = 480, kHeight = 300;

// The nearer of two; neither throws a shadow on the other.
class Both final : public sim::Scene {
 public:
  Both(std::unique_ptr<sim::Scene> a, std::unique_ptr<sim::Scene> b) : a_(std::move(a)), b_(std::move(b)) {}
  sim::RayHit look(sim::Vec3 o, sim::Vec3 d) const override {
    sim::RayHit a = a_->look(o, d), b = b_->look(o, d);
    if (b.body < 0) return a;
    if (a.body >= 0 && a.distance_mm <= b.distance_mm) return a;
    b.body += 100000;
    return b;
  }
  bool solid(sim::Vec3 o, sim::Vec3 d, sim::SolidPoint& out) const override { return a_->solid(o, d, out); }
  bool blocked(sim::Vec3 from, sim::Vec3 d, double far_mm) const override {
    return a_->blocked(from, d, far_mm) || b_->blocked(from, d, far_mm);
  }
  sim::Mesh solid_mesh() const override { return a_->solid_mesh(); }

 private:
  std::unique_ptr<sim::Scene> a_, b_;
};

// Nobody: the room, which the head's scene shows where its rays meet nothing.
class Room final : public sim::Scene {
 public:
  sim::RayHit look(sim::Vec3, sim::Vec3 d) const override {
    const double grey = 0.035 + 0.010 * sim::value_noise(d * 6, 99) - 0.02 * d.y;
    return {{grey, grey * 1.02, grey * 1.06}, sim::RayCaster::kFar, -1, false};
  }
  bool solid(sim::Vec3, sim::Vec3, sim::SolidPoint&) const override { return false; }
  bool blocked(sim::Vec3, sim::Vec3, double) const override { return false; }
  sim::Mesh solid_mesh() const override { return {}; }
};

sim::RigOptions rig_options() {
  sim::RigOptions options;
  options.width_px = kWidth, options.height_px = kHeight;
  return options;
}

std::vector<std::uint16_t> kept(const sim::LightPicture& light) {
  std::vector<std::uint16_t> out(light.rgb.size());
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = static_cast<std::uint16_t>(
        std::clamp(kLightUnit * static_cast<double>(light.rgb[i]) + 0.5, 0.0, 65535.0));
  return out;
}

// Whom a head was made for: every number it depends on.
std::vector<double> numbers_of(std::uint32_t seed, const sim::Expression& expression, double shine) {
  const auto& [lids, jaw, smile, tongue] = expression;
  return {double(seed), lids, jaw, smile, tongue, shine};
}

std::vector<double> numbers_of(const Shot& s) {
  std::vector<double> out = numbers_of(s.seed, s.guise.expression, s.guise.shine);
  const auto& [yaw, pitch, roll, distance, right, down, follow] = s.pose;
  const auto& [curve, half_width, half_height, tilt, passes, rim] = s.guise.glasses;
  out.insert(out.end(), {yaw, pitch, roll, distance, right, down, double(follow), double(s.extra),
                         double(s.guise.wears_glasses), curve, half_width, half_height, tilt, passes, rim});
  return out;
}

void smear(sim::LightPicture& light, double length_px) {
  const int n = std::max(1, static_cast<int>(std::lround(length_px)));
  if (n <= 1) return;
  const std::vector<float> from = light.rgb;
  for (int y = 0; y < light.height_px; ++y)
    for (int x = 0; x < light.width_px; ++x)
      for (int c = 0; c < 3; ++c) {
        float sum = 0;
        for (int k = 0; k < n; ++k)
          sum += from[static_cast<std::size_t>(
              3 * (y * light.width_px + std::clamp(x + k - n / 2, 0, light.width_px - 1)) + c)];
        light.rgb[static_cast<std::size_t>(3 * (y * light.width_px + x) + c)] = sum / static_cast<float>(n);
      }
}

// The noise of read_sensor(), out of a drawer of deviates: drawing them took a third of a look's time.
void add_noise(sim::LightPicture& light, const sim::SensorOptions& sensor, std::uint64_t seed) {
  static const std::vector<float> drawer = [] {
    sim::Random random(1);
    std::vector<float> out(65536);
    for (float& v : out) v = static_cast<float>(random.normal());
    return out;
  }();
  sim::Random random(sim::Random(seed).next());
  const auto well = static_cast<float>(sensor.full_well_electrons * sensor.exposure),
             full = static_cast<float>(sensor.full_well_electrons);
  const auto read = static_cast<float>(sensor.read_noise_electrons * sensor.read_noise_electrons);
  std::uint64_t draw = 0;
  for (std::size_t i = 0; i < light.rgb.size(); ++i, draw >>= 16) {
    if (i % 4 == 0) draw = random.next();
    const float deviation = std::sqrt(std::max(light.rgb[i], 0.0F) * well + read);
    light.rgb[i] += static_cast<float>(sensor.noise) * deviation * drawer[draw & 65535] / full /
                    static_cast<float>(sensor.exposure);
  }
}

// In the frame of the head; of one sought before, remembered.
sim::Vec3 pronasale(std::uint32_t seed) {
  static std::map<std::uint32_t, sim::Vec3> known;
  const auto [at, fresh] = known.try_emplace(seed);
  if (!fresh) return at->second;
  for (const sim::HeadLandmark& landmark : sim::landmarks_of(sim::HeadField(sim::traits_of(seed))))
    if (landmark.name == "pronasale") at->second = landmark.at;
  return at->second;
}

double roomier_side(const sim::HeadPose& pose) { return pose.right_mm > 0 ? -1 : 1; }

void blur(sim::LightPicture& light, double deviation_px) {
  if (deviation_px < 0.05) return;
  // Three boxes make a bell (Wells 1986).
  // Odd widths only, the nearest one.
  const int n =
      1 + 2 * static_cast<int>(std::lround((std::sqrt(4 * deviation_px * deviation_px + 1) - 1) / 2));
  for (int round = 0; round < 3; ++round) {
    smear(light, n);
    const std::vector<float> from = light.rgb;
    for (int y = 0; y < light.height_px; ++y)
      for (int i = 0; i < 3 * light.width_px; ++i) {
        float sum = 0;
        for (int k = -(n / 2); k <= n / 2; ++k)
          sum += from[static_cast<std::size_t>(
              3 * light.width_px * std::clamp(y + k, 0, light.height_px - 1) + i)];
        light.rgb[static_cast<std::size_t>(3 * light.width_px * y + i)] = sum / static_cast<float>(n);
      }
  }
}

}  // namespace

Album::Album(std::filesystem::path cache)
    : cache_(std::move(cache)), rig_(sim::make_rig(rig_options())), calibration_(true_calibration(rig_)) {
  if (!cache_.empty()) std::filesystem::create_directories(cache_);
}

std::shared_ptr<const sim::HeadModel> Album::person(std::uint32_t seed, const sim::Expression& expression,
                                                    double shine) {
  auto& model = heads_[numbers_of(seed, expression, shine)];
  if (!model) {
    sim::HeadTraits traits = sim::traits_of(seed);
    traits.expression = expression;
    traits.shine *= shine;
    model = sim::make_head(traits, pool_);
  }
  return model;
}

void Album::expose(Shot& shot) {
  std::unique_ptr<sim::Scene> scene;
  if (shot.pose.distance_mm <= 0) {
    scene = std::make_unique<Room>();
  } else {
    const auto model = person(shot.seed, shot.guise.expression, shot.guise.shine);
    scene = sim::make_head_scene(model, shot.pose, pool_);
    if (shot.guise.wears_glasses)
      scene =
          sim::make_glasses_scene(std::move(scene), sim::wearer_of(*model), shot.pose, shot.guise.glasses);
  }
  if (shot.extra == Extra::HandBefore || shot.extra == Extra::HandOnCheek) {
    const bool mouth = shot.extra == Extra::HandBefore;
    const sim::Vec3 by = mouth ? sim::Vec3{4, 30, -75} : sim::Vec3{34, -18, -42};
    const sim::BodyPose place{mouth ? sim::rotation(0.1, 0.15, 0.3) : sim::rotation(0.1, -0.3, -0.4),
                              sim::Vec3{shot.pose.right_mm, shot.pose.down_mm, shot.pose.distance_mm} + by};
    scene = std::make_unique<Both>(std::move(scene),
                                   std::make_unique<sim::PlateScene>(sim::FlatPlate{70, 90, 7}, place));
  }
  const double side = roomier_side(shot.pose);
  if (shot.extra == Extra::BagBeside || shot.extra == Extra::WallBehind) {
    const bool bag = shot.extra == Extra::BagBeside;
    const sim::Vec3 by = bag ? sim::Vec3{side * 158, -25, 35} : sim::Vec3{0, -20, 480};
    const sim::BodyPose place{bag ? sim::rotation(0.1, side * 0.2, 0.15) : sim::rotation(0, 0, 0),
                              sim::Vec3{shot.pose.right_mm, shot.pose.down_mm, shot.pose.distance_mm} + by};
    scene = std::make_unique<Both>(
        std::move(scene), std::make_unique<sim::PlateScene>(
                              bag ? sim::FlatPlate{125, 170, 9} : sim::FlatPlate{1200, 900, 11}, place));
  }
  if (shot.extra == Extra::Friend || shot.extra == Extra::Twin) {
    scene = std::make_unique<Both>(
        std::move(scene),
        sim::make_head_scene(person(shot.seed + (shot.extra == Extra::Friend ? 1 : 0), {}, 1),
                             behind(shot.pose), pool_));
  }
  const sim::SensorOptions lens;
  shot.left = kept(sim::expose(*scene, rig_.left, lens, pool_));
  shot.right = kept(sim::expose(*scene, rig_.right, lens, pool_));
}

const Shot& Album::shoot(std::uint32_t seed, const sim::HeadPose& pose, Extra extra, const Guise& guise) {
  Shot shot{seed, pose, extra, guise, {}, {}};
  const std::vector<double> numbers = numbers_of(shot);
  if (const auto known = shots_.find(numbers); known != shots_.end()) return known->second;
  constexpr std::size_t kValues = 3 * static_cast<std::size_t>(kWidth) * static_cast<std::size_t>(kHeight);
  const std::filesystem::path file = cache_ / ("light_" + sim::name_of_numbers(numbers));
  std::ifstream in;
  if (!cache_.empty()) in.open(file, std::ios::binary);
  shot.left.resize(kValues), shot.right.resize(kValues);
  const auto bytes = static_cast<std::streamsize>(2 * kValues);
  if (!(in && in.read(reinterpret_cast<char*>(shot.left.data()), bytes) &&
        in.read(reinterpret_cast<char*>(shot.right.data()), bytes))) {
    expose(shot);
    if (!cache_.empty()) {  // whole or not there: other tests read it at the same time
      std::vector<std::uint16_t> both = shot.left;
      both.insert(both.end(), shot.right.begin(), shot.right.end());
      static_cast<void>(write_whole_file(file, std::as_bytes(std::span(both))));
    }
  }
  return shots_.emplace(numbers, std::move(shot)).first->second;
}

Shot Album::photograph(std::uint32_t seed, const sim::HeadPose& pose, const sim::HeadPose* twin) {
  if (left_room_.rgb.empty()) {
    left_room_ = sim::expose(Room(), rig_.left, {}, pool_);
    right_room_ = sim::expose(Room(), rig_.right, {}, pool_);
  }
  const PastedHead& head = pasted_.try_emplace(seed, person(seed, {}, 1), pool_).first->second;
  Shot shot{seed, pose, Extra::None, {}, {}, {}};
  const auto photograph = [&](const sim::SimView& view, sim::LightPicture picture) {
    if (twin != nullptr) head.draw(*twin, view, picture);
    head.draw(pose, view, picture);
    return kept(picture);
  };
  shot.left = photograph(rig_.left, left_room_);
  shot.right = photograph(rig_.right, right_room_);
  return shot;
}

sim::PicturePair Album::develop(const Shot& shot, const Developing& how) const {
  sim::SensorOptions sensor;
  sensor.exposure = how.exposure;
  const auto one = [&](const std::vector<std::uint16_t>& kept_light, const sim::SimView& view,
                       std::uint64_t seed) {
    sim::LightPicture light{kWidth, kHeight, std::vector<float>(kept_light.size())};
    const sim::Pixel middle =
        view.project({shot.pose.right_mm, shot.pose.down_mm, std::max(shot.pose.distance_mm, 300.0)});
    const double reach = 60 * view.fx_px / std::max(shot.pose.distance_mm, 300.0);
    for (std::size_t i = 0; i < kept_light.size(); ++i) {
      const double x = static_cast<double>(i / 3 % kWidth),
                   share = std::clamp(0.5 + (x - middle.x) / (2 * reach), 0.0, 1.0);
      light.rgb[i] = static_cast<float>(kept_light[i] / kLightUnit * (1 + (how.one_sided - 1) * share));
    }
    blur(light, how.defocus_px);
    smear(light, how.motion_px);
    add_noise(light, sensor, seed);
    sim::SensorOptions quiet = sensor;
    quiet.noise = 0;
    return sim::read_sensor(light, quiet, seed);
  };
  return {one(shot.left, rig_.left, 2 * how.noise_seed), one(shot.right, rig_.right, 2 * how.noise_seed + 1)};
}

Album& shared_album() {
  static Album once(album_folder());
  return once;
}

sim::HeadPose standing(double distance_mm, double right_mm, double down_mm, double yaw_deg, double pitch_deg,
                       double roll_deg) {
  // Frame: x along the baseline, z the mean of both optical axes, origin in the left camera; then into the
  // left camera's.
  static const sim::SimRig rig = sim::make_rig(rig_options());
  const sim::Vec3 baseline = rig.right.centre(), x = sim::normalised(baseline);
  const sim::Vec3 right_axis = rig.right.view_from_world.transposed() * sim::Vec3{0, 0, 1};
  sim::Vec3 z = sim::Vec3{0, 0, 1} + right_axis;
  z = sim::normalised(z - x * sim::dot(z, x));
  const sim::Vec3 y = sim::cross(z, x), middle = baseline * 0.5;
  const sim::Vec3 at = middle + x * right_mm + y * down_mm + z * distance_mm;
  const sim::Vec3 to = sim::normalised(middle - at);
  sim::HeadPose pose;
  pose.right_mm = at.x, pose.down_mm = at.y, pose.distance_mm = at.z;
  pose.yaw_deg = std::atan2(to.x, -to.z) / kDegree + yaw_deg;
  pose.pitch_deg = std::asin(to.y) / kDegree + pitch_deg;
  pose.roll_deg = roll_deg;
  return pose;
}

sim::HeadPose behind(sim::HeadPose pose) {
  const double side = roomier_side(pose);
  pose.right_mm += side * 175, pose.distance_mm += 260, pose.yaw_deg += side * 14;
  return pose;
}

TrueHead true_head(const Shot& shot, const pipeline::Relief& relief) {
  const sim::Vec3 tip = shot.pose.origin_mm() + shot.pose.world_from_head() * pronasale(shot.seed);
  const auto in_relief = [&](sim::Vec3 v) {
    return pipeline::apply(relief.rectified_from_left, {v.x, v.y, v.z});
  };
  const sim::Mat3 turn = shot.pose.world_from_head();
  const pipeline::Vec3d out = in_relief(turn * sim::Vec3{0, 0, 1}), up = in_relief(turn * sim::Vec3{0, 1, 0});
  const pipeline::Vec3d at = in_relief({shot.pose.right_mm, shot.pose.down_mm, shot.pose.distance_mm});
  const pipeline::HeadAxes axes = pipeline::axes_facing_the_rig(at, relief.baseline_mm);
  const auto dot = [](const pipeline::Vec3d& a, const pipeline::Vec3d& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
  };
  return {std::atan2(dot(out, axes.right), -dot(out, axes.away)) / kDegree,
          std::asin(dot(out, axes.down)) / kDegree,
          std::atan2(-dot(up, axes.right), -dot(up, axes.down)) / kDegree, in_relief(tip)};
}

}  // namespace relievo::test
