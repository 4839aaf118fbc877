// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <map>
#include <mutex>

#include "hal/sim/device.h"
#include "hal/sim/replay/replay_device.h"

namespace relievo::hal {
namespace {

// Exposes both views of a scene once; each further frame only rolls new noise over the same light. Of a
// head a few rolls are made at the start and come by turns: a camera does not take a second for a picture.
class RenderedSource final : public PairSource {
 public:
  RenderedSource(const SimDeviceOptions& options, std::vector<sim::BoardPose> poses)
      : o_(options.simulation),
        rig_(sim::make_rig(o_.rig)),
        pool_(options.threads),
        poses_(std::move(poses)) {
    expose_both(
        0);  // here, since a frame has a deadline, and a slow machine takes half a minute to make a head
    if (!poses_.empty()) return;
    rolls_.resize(2 * kRolls);
    pool_.for_each_band(
        static_cast<int>(rolls_.size()), static_cast<int>(rolls_.size()), [this](int begin, int end, int) {
          for (int i = begin; i < end; ++i)
            rolls_[static_cast<std::size_t>(i)] =
                roll(i % 2 == 0 ? Side::Left : Side::Right, static_cast<std::uint32_t>(i / 2));
        });
  }

  Result<Exposure> expose(Side side, std::uint32_t number) override {
    if (poses_.empty())
      return Exposure{rolls_[2 * (number % kRolls) + (side == Side::Left ? 0 : 1)],
                      std::chrono::nanoseconds(0)};
    const std::lock_guard lock(mutex_);
    const std::size_t pose = (number - 1) % poses_.size();
    if (pose != pose_) expose_both(pose);
    return Exposure{roll(side, number), std::chrono::nanoseconds(0)};
  }

 private:
  static constexpr std::uint32_t kRolls = 2;

  Picture roll(Side side, std::uint32_t number) const {
    sim::SensorOptions sensor = o_.sensor;
    sensor.grey = o_.scene == sim::SceneKind::Board;
    const sim::LightPicture& light = side == Side::Left ? left_ : right_;
    return sim::read_sensor(light, sensor,
                            o_.seed * 100000ULL + 2ULL * number + (side == Side::Left ? 0 : 1));
  }

  void expose_both(std::size_t pose) {
    std::unique_ptr<sim::Scene> scene;
    if (o_.scene == sim::SceneKind::Board)
      scene = std::make_unique<sim::BoardScene>(o_.board, poses_[pose], o_.board_look, 1 / rig_.left.fx_px);
    else scene = sim::make_head_scene(sim::make_head(sim::traits_of(o_.seed), pool_), o_.pose, pool_);
    left_ = sim::expose(*scene, rig_.left, o_.sensor, pool_);
    right_ = sim::expose(*scene, rig_.right, o_.sensor, pool_);
    pose_ = pose;
  }

  sim::SimulationOptions o_;
  sim::SimRig rig_;
  std::mutex mutex_;
  ThreadPool pool_;
  std::vector<sim::BoardPose> poses_;
  sim::LightPicture left_, right_;
  std::vector<Picture> rolls_;
  std::size_t pose_ = 0;
};

}  // namespace

Result<std::unique_ptr<Device>> make_sim_device(const SimDeviceOptions& options) {
  const sim::SimulationOptions& o = options.simulation;
  RELIEVO_TRY(o.check());
  std::vector<sim::BoardPose> poses;
  if (o.scene == sim::SceneKind::Board) {
    RELIEVO_TRY_ASSIGN(poses, sim::good_board_poses(sim::make_rig(o.rig), o.board, o.board_poses, o.seed,
                                                    o.pose.distance_mm));
  }
  const CaptureMode mode{o.rig.width_px, o.rig.height_px, std::chrono::microseconds(4000)};
  auto device = std::make_unique<ReplayDevice>(
      "sim", std::make_unique<RenderedSource>(options, std::move(poses)), mode, true);
  if (options.media_folder) device->folder_media().plug(*options.media_folder);
  return std::unique_ptr<Device>(std::move(device));
}

}  // namespace relievo::hal
