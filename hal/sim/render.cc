// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/sim/render.h"

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <span>
#include <system_error>

#include "hal/base/whole_file.h"

namespace relievo::hal::sim {
namespace {

constexpr double kCosSixty = 0.5;

std::uint8_t flags_of(const Scene& scene, const SimRig& rig, const SolidPoint& s, Vec3 left_ray) {
  std::uint8_t flags = s.skin ? Truth::kSkin : std::uint8_t{0};
  const Vec3 to_right = rig.right.centre() - s.point;
  const double far = length(to_right);
  const Vec3 right_ray = to_right * (1 / far);
  const Pixel q = rig.right.project(s.point);
  const bool inside = q.x > 2 && q.y > 2 && q.x < rig.right.width_px - 3 && q.y < rig.right.height_px - 3;
  // A step back towards the left camera keeps the surface from hiding itself.
  if (!inside || scene.blocked(s.point - left_ray * 0.08, right_ray, far - 0.2)) return flags;
  flags |= Truth::kSeenByBoth;
  if (std::min(std::abs(dot(s.normal, left_ray)), std::abs(dot(s.normal, right_ray))) > kCosSixty)
    flags |= Truth::kNotGrazing;
  return flags;
}

template <typename T>
void append(std::string& out, std::span<const T> values) {
  out.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
}

Result<void> render_boards(const SimulationOptions& o, const SimRig& rig, const std::filesystem::path& folder,
                           ThreadPool& pool) {
  // Turned as a head in the same pose would be, its middle on the left camera's axis.
  const Vec3 aim = rig.left.ray((rig.left.width_px - 1) / 2.0, (rig.left.height_px - 1) / 2.0);
  const HeadPose& at = o.pose;
  std::vector<BodyPose> poses{
      with_middle_at(rig.left.centre() + aim * at.distance_mm + Vec3{at.right_mm, at.down_mm, 0},
                     rotation(radians(at.pitch_deg), radians(at.yaw_deg), radians(at.roll_deg)), o.board)};
  if (!o.board_in_this_pose) {
    RELIEVO_TRY_ASSIGN(poses, good_board_poses(rig, o.board, o.board_poses, o.seed, o.pose.distance_mm));
  }
  SensorOptions sensor = o.sensor;
  sensor.grey = true;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const BoardScene scene(o.board, poses[k], o.board_look, 1 / rig.left.fx_px);
    RELIEVO_TRY(write_pair(render_pair(scene, rig, sensor, o.seed * 1000ULL + k, pool), folder,
                           (k < 10 ? "_0" : "_") + std::to_string(k)));
  }
  return {};
}

// A head's pair with what is true of it.
Result<void> write_head(const Scene& scene, const SimulationOptions& o, const SimRig& rig,
                        std::uint64_t noise_seed, const std::filesystem::path& folder, ThreadPool& pool) {
  RELIEVO_TRY(write_pair(render_pair(scene, rig, o.sensor, noise_seed, pool), folder));
  if (!o.truth) return {};
  RELIEVO_TRY(write_truth(folder / "truth.bin", measure_truth(scene, rig, pool)));
  return write_mesh(folder / "head.ply", scene.solid_mesh());
}

Result<void> render_visit(const SimulationOptions& o, const SimRig& rig, const std::filesystem::path& folder,
                          ThreadPool& pool) {
  constexpr std::array<std::array<double, 2>, 6> kTurnsDeg{
      {{0, 0}, {-25, 0}, {25, 0}, {-45, 0}, {45, 0}, {0, 15}}};
  HeadTraits traits = traits_of(o.seed);
  if (o.alive == Alive::CastEyesClosed) traits.expression.lids_open = 0;
  std::shared_ptr<const HeadModel> head = make_head(traits, pool);
  std::mt19937 random(o.seed);
  for (std::size_t k = 0; k < kTurnsDeg.size(); ++k) {
    if (k > 0 && o.drift > 0 && o.alive == Alive::Person) {
      // Between two pairs somebody's lips, jaw and lids move a little.
      std::uniform_real_distribution<double> upto_one(0, 1);
      traits.expression.smile = 0.08 * o.drift * upto_one(random);
      traits.expression.jaw_mm = 0.8 * o.drift * upto_one(random);
      traits.expression.lids_open = 1 - 0.15 * o.drift * upto_one(random);
      head = make_head(traits, pool);
    }
    HeadPose pose = turned_about_neck(o.pose, kTurnsDeg[k][0]);
    pose.pitch_deg += kTurnsDeg[k][1];
    pose.eyes_follow = o.alive == Alive::Person;
    const std::filesystem::path own = folder / std::to_string(k);
    RELIEVO_TRY(make_folder(own));
    RELIEVO_TRY(write_rig(own / "rig.yml", rig));
    RELIEVO_TRY(write_head(*make_head_scene(head, pose, pool), o, rig, o.seed * 1000ULL + k, own, pool));
  }
  return {};
}

}  // namespace

Truth measure_truth(const Scene& scene, const SimRig& rig, ThreadPool& pool) {
  Truth truth;
  truth.width_px = rig.left.width_px;
  truth.height_px = rig.left.height_px;
  const std::size_t count = std::size_t(truth.width_px) * std::size_t(truth.height_px);
  truth.depth_mm.assign(count, std::numeric_limits<float>::quiet_NaN());
  truth.flags.assign(count, 0);
  const Vec3 eye = rig.left.centre();
  pool.for_each(truth.height_px, 60, [&](int y) {
    for (int x = 0; x < truth.width_px; ++x) {
      const Vec3 ray = rig.left.ray(x, y);
      SolidPoint s;
      if (!scene.solid(eye, ray, s)) continue;
      truth.depth_mm[truth.at(x, y)] = float(rig.left.depth_mm(s.point));
      truth.flags[truth.at(x, y)] = flags_of(scene, rig, s, ray);
    }
  });
  return truth;
}

Result<void> write_truth(const std::filesystem::path& file, const Truth& truth) {
  std::string out = std::to_string(truth.width_px) + ' ' + std::to_string(truth.height_px) + " z\n";
  append<float>(out, truth.depth_mm);
  append<std::uint8_t>(out, truth.flags);
  return write_whole_file(file, std::as_bytes(std::span(out)));
}

Result<void> write_mesh(const std::filesystem::path& file, const Mesh& mesh) {
  std::string out =
      "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(mesh.points.size()) +
      "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
      std::to_string(mesh.triangles.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
  out.reserve(out.size() + mesh.points.size() * 12 + mesh.triangles.size() * 13);
  append<std::array<float, 3>>(out, mesh.points);
  for (const auto& t : mesh.triangles) {
    out.push_back(3);
    append<std::uint32_t>(out, t);
  }
  return write_whole_file(file, std::as_bytes(std::span(out)));
}

Result<void> write_pair(const PicturePair& pair, const std::filesystem::path& folder,
                        const std::string& behind) {
  RELIEVO_TRY(write_picture(folder / ("left" + behind + ".png"), pair.left.view()));
  return write_picture(folder / ("right" + behind + ".png"), pair.right.view());
}

Result<void> make_folder(const std::filesystem::path& folder) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed) return Error{Errc::IoFailed, "cannot make this folder", failed.value()}.at(folder.native());
  return {};
}

Result<void> SimulationOptions::check() const {
  RELIEVO_TRY(rig.check());
  RELIEVO_TRY(board.check());
  RELIEVO_TRY(board_look.check());
  if (board_poses < 1 || board_poses > 200) return invalid("choose between 1 and 200 board poses");
  if (!(std::abs(pose.yaw_deg) <= 60) || !(std::abs(pose.pitch_deg) <= 45) ||
      !(std::abs(pose.roll_deg) <= 60))
    return invalid("a simulated head turns up to 60, nods up to 45 and leans up to 60 degrees");
  if (!(pose.distance_mm >= 250) || !(pose.distance_mm <= 2000))
    return invalid("a simulated scene stands between 250 and 2000 mm away");
  return {};
}

PicturePair render_pair(const Scene& scene, const SimRig& rig, const SensorOptions& sensor,
                        std::uint64_t noise_seed, ThreadPool& pool) {
  PicturePair pair;
  pair.left = read_sensor(expose(scene, rig.left, sensor, pool), sensor, 2 * noise_seed);
  pair.right = read_sensor(expose(scene, rig.right, sensor, pool), sensor, 2 * noise_seed + 1);
  return pair;
}

Result<void> render_to_folder(const SimulationOptions& options, const std::filesystem::path& folder,
                              int threads) {
  RELIEVO_TRY(options.check());
  RELIEVO_TRY(make_folder(folder));
  ThreadPool pool(threads);
  const SimRig rig = make_rig(options.rig);
  RELIEVO_TRY(write_rig(folder / "rig.yml", rig));
  switch (options.scene) {
    case SceneKind::Board: return render_boards(options, rig, folder, pool);
    case SceneKind::Visit: return render_visit(options, rig, folder, pool);
    case SceneKind::Head: break;
  }
  const auto scene = make_head_scene(make_head(traits_of(options.seed), pool), options.pose, pool);
  return write_head(*scene, options, rig, options.seed * 1000ULL, folder, pool);
}

}  // namespace relievo::hal::sim
