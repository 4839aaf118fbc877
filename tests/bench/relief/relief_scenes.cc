// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/relief/relief_scenes.h"

#include <cmath>
#include <cstdio>

#include "hal/sim/base/noise.h"

namespace relievo::bench {
namespace {

namespace sim = hal::sim;
using sim::Random;

constexpr double kAheadDeg = 7;  // a face that looks between the cameras is turned by this for the left one

sim::RigOptions rig_of(Random& random) {
  sim::RigOptions rig;
  rig.width_px = 960, rig.height_px = 600;
  if (random.uniform() < 0.3) std::swap(rig.width_px, rig.height_px);
  rig.seed = static_cast<std::uint32_t>(1 + 1000 * random.uniform());
  return rig;
}

sim::SensorOptions sensor_of(Random& random) {
  sim::SensorOptions sensor;
  sensor.exposure = std::exp(random.uniform(std::log(0.3), std::log(1.3)));
  sensor.noise = random.uniform(0.5, 2.5);
  sensor.defocus_px = random.uniform(0.4, 0.9);
  return sensor;
}

sim::HeadLighting lamps_of(Random& random) {
  return {random.uniform(0.2, 1.4), random.uniform(0.2, 2), random.uniform(0, 3)};
}

sim::HeadPose pose_of(Random& random, double most_yaw_deg, double most_pitch_deg) {
  sim::HeadPose pose;
  pose.yaw_deg = kAheadDeg + random.uniform(-most_yaw_deg, most_yaw_deg);
  pose.pitch_deg = random.uniform(-most_pitch_deg, most_pitch_deg);
  pose.roll_deg = random.uniform(-10, 10);
  pose.distance_mm = random.uniform(480, 680);
  pose.right_mm = random.uniform(-20, 20);
  pose.down_mm = random.uniform(-15, 15);
  return pose;
}

sim::SheetBend bend_of(Random& random) {
  sim::SheetBend bend;
  // Between a roll of 50 mm and what can hardly be told from flat, as often towards the cameras as not.
  bend.radius_mm = 1 / random.uniform(1 / 600., 1 / 50.) * (random.uniform() < 0.6 ? 1 : -1);
  const double kind = random.uniform();
  bend.axis_deg = kind < 0.3 ? 0 : (kind < 0.5 ? 90 : random.uniform(0, 180));
  if (random.uniform() < 0.3) bend.apex_mm = random.uniform(250, 700) * (random.uniform() < 0.5 ? 1 : -1);
  else if (random.uniform() < 0.2) bend.wave_mm = random.uniform(120, 300);
  return bend;
}

sim::SheetLook look_of(Shown shown, Random& random) {
  sim::SheetLook look;
  look.screen = shown == Shown::Screen;
  look.brightness = look.screen ? random.uniform(0.3, 0.9) : random.uniform(0.6, 0.95);
  const bool matt = random.uniform() < (look.screen ? 0.25 : 0.5);
  look.gloss = matt ? 0 : random.uniform(0.005, look.screen ? 0.045 : 0.04);
  look.roughness = look.screen ? random.uniform(0.005, 0.04) : random.uniform(0.04, 0.2);
  return look;
}

std::string text_of(const sim::HeadPose& p, const sim::SensorOptions& s) {
  char text[160];
  std::snprintf(text, sizeof text,
                "yaw %.0f pitch %.0f roll %.0f distance %.0f exposure %.2f noise %.1f blur %.2f", p.yaw_deg,
                p.pitch_deg, p.roll_deg, p.distance_mm, s.exposure, s.noise, s.defocus_px);
  return text;
}

std::string text_of(const sim::SheetOptions& o) {
  char text[200];
  std::snprintf(text, sizeof text, " width %.0f radius %.0f axis %.0f apex %.0f wave %.0f gloss %.3f",
                o.width_mm, o.bend.radius_mm, o.bend.axis_deg, o.bend.apex_mm, o.bend.wave_mm, o.look.gloss);
  return text;
}

// The middle part of a picture: paper is cut to what the hand likes to hold.
hal::Picture trimmed(const hal::Picture& from, double across, double down) {
  hal::Picture out;
  out.width_px = static_cast<int>(from.width_px * across),
  out.height_px = static_cast<int>(from.height_px * down);
  out.format = from.format;
  const int left = (from.width_px - out.width_px) / 2, top = (from.height_px - out.height_px) / 2,
            bytes = bytes_per_pixel(from.format);
  for (int y = 0; y < out.height_px; ++y) {
    const auto row =
        from.bytes.begin() + static_cast<std::ptrdiff_t>(bytes) * ((y + top) * from.width_px + left);
    out.bytes.insert(out.bytes.end(), row, row + static_cast<std::ptrdiff_t>(bytes) * out.width_px);
  }
  return out;
}

}  // namespace

const char* name_of(Shown shown) {
  switch (shown) {
    case Shown::Face: return "face";
    case Shown::PrintedFlat: return "printed flat";
    case Shown::PrintedBent: return "printed and bent";
    case Shown::Screen: return "on a screen";
    case Shown::TurningPerson: return "turning person";
    case Shown::TurningMask: break;
  }
  return "turning mask";
}

Album::Album(std::uint32_t first_person, int count, ThreadPool& pool) {
  // 270 mm of the plane through the face are as wide as the picture.
  sim::RigOptions camera;
  camera.width_px = 900, camera.height_px = 1200;
  camera.focal_px = 900 / 270.0 * 560 * 1920 / 1200;
  camera.perturbation = 0;
  const sim::SimView view = make_rig(camera).left;
  for (int k = 0; k < count; ++k) {
    const auto person = first_person + static_cast<std::uint32_t>(k);
    Random random(person * 77ULL + 5);
    sim::HeadPose pose;
    pose.yaw_deg = random.uniform(-8, 8), pose.pitch_deg = random.uniform(-6, 6);
    const auto scene = make_head_scene(sim::make_head(sim::traits_of(person), pool), pose, pool);
    sim::SensorOptions sensor;
    sensor.noise = 0.5;
    photographs_.push_back(read_sensor(expose(*scene, view, sensor, pool), sensor, person));
  }
}

Trial show_picture(Shown shown, const Album& album, std::uint64_t number) {
  Random random(Random(number * 4 + static_cast<std::uint64_t>(shown)).next());
  Trial trial;
  trial.rig = rig_of(random);
  trial.sensor = sensor_of(random);
  trial.noise_seed = random.next();
  sim::SheetOptions sheet;
  sheet.pose = pose_of(random, 30, 20);
  sheet.lamps = lamps_of(random);
  sheet.look = look_of(shown, random);
  if (shown == Shown::PrintedBent) sheet.bend = bend_of(random);
  const double across = random.uniform(0.65, 1), down = random.uniform(0.7, 1),
               size = random.uniform(0.8, 1.15);
  sheet.width_mm = 270 * across * size;
  auto scene = make_sheet_scene(
      trimmed(album.of(static_cast<std::size_t>(random.next() % album.size())), across, down), sheet);
  if (scene) trial.scene = *std::move(scene);
  trial.what = text_of(sheet.pose, trial.sensor) + text_of(sheet);
  return trial;
}

Trial People::show(std::uint64_t number) {
  Random random(Random(number * 4).next());
  Trial trial;
  trial.rig = rig_of(random);
  trial.sensor = sensor_of(random);
  trial.noise_seed = random.next();
  const sim::HeadPose pose = pose_of(random, 25, 15);
  const auto person = first_ + static_cast<std::uint32_t>(number / kStands % 1000);
  if (head_ == nullptr || made_ != person)
    head_ = sim::make_head(sim::traits_of(person), pool_), made_ = person;
  trial.scene = make_head_scene(head_, pose, pool_, lamps_of(random));
  trial.what = "person " + std::to_string(person) + " " + text_of(pose, trial.sensor);
  return trial;
}

std::array<Trial, 3> show_turning(Shown shown, std::uint32_t first_person, std::uint64_t number,
                                  ThreadPool& pool) {
  Random random(Random(number * 8 + static_cast<std::uint64_t>(shown)).next());
  const bool mask = shown == Shown::TurningMask;
  sim::HeadTraits traits = sim::traits_of(first_person + static_cast<std::uint32_t>(number));
  if (mask) traits.expression.lids_open = 0;
  auto head = sim::make_head(traits, pool);
  const sim::HeadPose front = pose_of(random, 5, 5);
  const sim::HeadLighting lamps = lamps_of(random);
  const sim::SensorOptions sensor = sensor_of(random);
  std::array<Trial, 3> trials;
  for (std::size_t k = 0; k < trials.size(); ++k) {
    sim::HeadPose pose = turned_about_neck(front, k == 0 ? 0 : k == 1 ? -25 : 25);
    pose.eyes_follow = !mask;
    if (k == 1 && !mask) {
      traits.expression.lids_open = 1 - random.uniform(0, 0.15);
      traits.expression.jaw_mm = random.uniform(0, 0.8);
      head = sim::make_head(traits, pool);
    }
    Trial& trial = trials.at(k);
    trial.rig.width_px = 960, trial.rig.height_px = 600;
    trial.sensor = sensor;
    trial.noise_seed = random.next();
    trial.scene = make_head_scene(head, pose, pool, lamps);
    trial.what = "person " + std::to_string(first_person + number) + " " + text_of(pose, sensor);
  }
  return trials;
}

}  // namespace relievo::bench
