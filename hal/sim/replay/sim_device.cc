// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <condition_variable>
#include <map>
#include <mutex>
#include <thread>

#include "hal/base/whole_file.h"
#include "hal/sim/base/noise.h"
#include "hal/sim/device.h"
#include "hal/sim/replay/replay_device.h"

namespace relievo::hal {
namespace {

// In the album: of every number that the pictures of a head depend on.
std::string album_name(const sim::SimulationOptions& o, double yaw_deg) {
  const auto& [yaw, pitch, roll, distance, right, down, follow] = o.pose;
  const auto& [width, height, focal, baseline, convergence, rig_seed, perturbation] = o.rig;
  const auto& [exposure, full_well, read_noise, noise, defocus, gamma, grey] = o.sensor;
  return "head_" + sim::name_of_numbers(std::array{
                       double(o.seed), yaw_deg,       yaw,         pitch,          roll,
                       distance,       right,         down,        double(follow), double(width),
                       double(height), focal,         baseline,    convergence,    double(rig_seed),
                       perturbation,   exposure,      full_well,   read_noise,     noise,
                       defocus,        double(gamma), double(grey)});
}

// Exposes both views of a scene once; each further frame only rolls new noise over the same light. Of a
// head a few rolls are made at the start and come by turns: a camera does not take a second for a picture. A
// head that turns is rendered beside the cameras, and kept.
class RenderedSource final : public PairSource {
 public:
  RenderedSource(const SimDeviceOptions& options, std::vector<sim::BodyPose> poses)
      : o_(options.simulation), album_(options.album), pool_(options.threads), poses_(std::move(poses)) {
    // Here, since a frame has a deadline, and a slow machine takes half a minute to make a head.
    if (poses_.empty()) shown_ = &photograph(0);
    else expose_both(0);
  }
  ~RenderedSource() override {
    {
      const std::lock_guard lock(mutex_);
      leaving_ = true;
    }
    asked_.notify_one();
    if (renderer_.joinable()) renderer_.join();
  }

  Result<Exposure> expose(Side side, std::uint32_t number) override {
    const std::lock_guard lock(mutex_);
    if (poses_.empty())
      return Exposure{(*shown_)[2 * (number % kRolls) + std::size_t(side)], std::chrono::nanoseconds(0)};
    const std::size_t pose = (number - 1) % poses_.size();
    if (pose != pose_) expose_both(pose);
    return Exposure{roll(side, number), std::chrono::nanoseconds(0)};
  }

  void turn_head(double yaw_deg) override {
    if (!poses_.empty()) return;
    {
      const std::lock_guard lock(mutex_);
      wanted_deg_ = yaw_deg;
    }
    asked_.notify_one();
    if (!renderer_.joinable()) renderer_ = std::thread([this] { render_what_is_asked(); });
  }

 private:
  static constexpr std::uint32_t kRolls = 2;
  using Rolls = std::vector<Picture>;

  void render_what_is_asked() {
    double shown_deg = 0;
    std::unique_lock lock(mutex_);
    for (;;) {
      asked_.wait(lock, [&] { return leaving_ || wanted_deg_ != shown_deg; });
      if (leaving_) return;
      const double yaw_deg = wanted_deg_;
      lock.unlock();
      const Rolls& made = photograph(yaw_deg);
      lock.lock();
      shown_ = &made;
      shown_deg = yaw_deg;
    }
  }

  // Only one thread makes them: first whoever makes the device, then the renderer.
  const Rolls& photograph(double yaw_deg) {
    Rolls& rolls = turned_[yaw_deg];
    if (!rolls.empty()) return rolls;
    const std::filesystem::path file = album_.empty() ? album_ : album_ / album_name(o_, yaw_deg);
    if (!file.empty() && read_rolls(file, rolls)) return rolls;
    if (!head_) head_ = sim::make_head(sim::traits_of(o_.seed), pool_);
    expose_both(*sim::make_head_scene(head_, sim::turned_about_neck(o_.pose, yaw_deg), pool_));
    Rolls made(2 * kRolls);
    pool_.for_each(int(made.size()), int(made.size()), [&](int i) {
      made[std::size_t(i)] = roll(i % 2 == 0 ? Side::Left : Side::Right, std::uint32_t(i / 2));
    });
    rolls = std::move(made);
    if (file.empty()) return rolls;
    std::vector<std::byte> bytes;
    for (const Picture& picture : rolls)
      bytes.insert(bytes.end(), picture.bytes.begin(), picture.bytes.end());
    static_cast<void>(write_whole_file(file, bytes));  // what cannot be kept is rendered again
    return rolls;
  }

  bool read_rolls(const std::filesystem::path& file, Rolls& rolls) const {
    const std::size_t size = 3 * std::size_t(rig_.left.width_px) * std::size_t(rig_.left.height_px);
    const auto bytes = read_whole_file(file, 2 * kRolls * size);
    if (!bytes || bytes->size() != 2 * kRolls * size) return false;
    for (auto from = bytes->begin(); from != bytes->end(); from += std::ptrdiff_t(size))
      rolls.push_back(
          {{from, from + std::ptrdiff_t(size)}, rig_.left.width_px, rig_.left.height_px, PixelFormat::Rgb8});
    return true;
  }

  Picture roll(Side side, std::uint32_t number) const {
    sim::SensorOptions sensor = o_.sensor;
    sensor.grey = o_.scene == sim::SceneKind::Board;
    const sim::LightPicture& light = side == Side::Left ? left_ : right_;
    return sim::read_sensor(light, sensor, o_.seed * 100000ULL + 2ULL * number + std::uint64_t(side));
  }

  void expose_both(std::size_t pose) {
    expose_both(sim::BoardScene(o_.board, poses_[pose], o_.board_look, 1 / rig_.left.fx_px));
    pose_ = pose;
  }
  void expose_both(const sim::Scene& scene) {
    left_ = sim::expose(scene, rig_.left, o_.sensor, pool_);
    right_ = sim::expose(scene, rig_.right, o_.sensor, pool_);
  }

  sim::SimulationOptions o_;
  sim::SimRig rig_{sim::make_rig(o_.rig)};
  std::filesystem::path album_;
  std::mutex mutex_;
  ThreadPool pool_;
  std::vector<sim::BodyPose> poses_;
  sim::LightPicture left_, right_;
  std::size_t pose_ = 0;
  std::shared_ptr<const sim::HeadModel> head_;
  std::map<double, Rolls> turned_;  // by yaw
  const Rolls* shown_ = nullptr;
  std::thread renderer_;
  std::condition_variable asked_;
  double wanted_deg_ = 0;
  bool leaving_ = false;
};

}  // namespace

void turn_simulated_head(Device& device, double yaw_deg) {
  if (auto* const played = dynamic_cast<ReplayDevice*>(&device)) played->source().turn_head(yaw_deg);
}

Result<std::unique_ptr<Device>> make_sim_device(const SimDeviceOptions& options) {
  const sim::SimulationOptions& o = options.simulation;
  RELIEVO_TRY(o.check());
  std::vector<sim::BodyPose> poses;
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
