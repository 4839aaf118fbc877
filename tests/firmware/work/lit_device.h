// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A device of two cameras that add up light as sensors do: what a camera shows is its scene's light, times
// the lamp, the time and the gain it was set to. Thread: one caller. Errors: none.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "tests/support/played_device.h"

namespace relievo::test {

class LitCamera final : public hal::Camera {
 public:
  // `light`: row by row, 1 is white at 10 ms and gain 1.
  LitCamera(const hal::Instant& pulsed_at, double gain, std::vector<double> light, int width)
      : pulsed_at_(pulsed_at), own_(gain), light_(std::move(light)), width_(width), pixels_(light_.size()) {}
  double lamp = 1;
  hal::Exposure set;
  int sets = 0, pictures = 0;
  std::function<void()> on_picture;
  std::vector<hal::Exposure> exposed;  // of each picture
  void show(std::vector<double> light) { light_ = std::move(light); }
  // What of the light a picture turns into 255.
  double factor() const { return lamp * own_ * static_cast<double>(set.time.count()) * set.gain / 10'000; }

 private:
  Result<void> do_open(const hal::CaptureMode&) override { return {}; }
  Result<void> do_start() override { return {}; }
  void do_stop() override {}
  Result<hal::Frame> do_next_frame(hal::Instant) override {
    ++pictures;
    if (on_picture) on_picture();
    exposed.push_back(set);
    for (std::size_t i = 0; i < light_.size(); ++i)
      pixels_[i] = static_cast<std::byte>(std::min(255.0, 255 * light_[i] * factor()));
    const int height = static_cast<int>(light_.size()) / width_;
    return hal::Frame(
        {pixels_.data(), pixels_.size(), width_, height, width_, {}}, {pulsed_at_, ++sequence_},
        [](void*, int) {}, this, 0);
  }
  Result<void> do_set_exposure(const hal::Exposure& exposure) override {
    set = exposure;
    ++sets;
    return {};
  }
  Result<hal::ExposureLimits> do_exposure_limits() const override {
    return hal::ExposureLimits{{std::chrono::microseconds(50), 1}, {std::chrono::microseconds(30'000), 16}};
  }

  const hal::Instant& pulsed_at_;
  double own_;  // how much more than the other it sees
  std::vector<double> light_;
  int width_;
  std::vector<std::byte> pixels_;
  std::uint32_t sequence_ = 0;
};

class LitDevice final : public hal::Device, hal::RemovableMedia, hal::Watchdog {
 public:
  struct Scene {
    std::vector<double> left, right;
    int width;
  };
  explicit LitDevice(const Scene& scene, double right_gain = 1.2)
      : left_camera(line.pulsed_at, 1, scene.left, scene.width),
        right_camera(line.pulsed_at, right_gain, scene.right, scene.width),
        width_(scene.width),
        height_(static_cast<int>(scene.left.size()) / scene.width) {}
  PlayedWorld world;
  PlayedClock time{world};
  PlayedLine line{time};
  LitCamera left_camera, right_camera;
  std::string_view name() const override { return "lit"; }
  hal::CaptureMode preferred_mode() const override { return {width_, height_, std::chrono::microseconds(1)}; }
  hal::Camera& left() override { return left_camera; }
  hal::Camera& right() override { return right_camera; }
  hal::TriggerLine& trigger() override { return line; }
  hal::RemovableMedia& media() override { return *this; }
  hal::Clock& clock() override { return time; }
  hal::Watchdog& watchdog() override { return *this; }

 private:
  std::optional<std::filesystem::path> current() override { return std::nullopt; }
  Result<void> flush_and_eject() override { return {}; }
  void kick() override {}
  int width_, height_;
};

}  // namespace relievo::test
