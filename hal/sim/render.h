// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The simulated rig's pictures as files: what `relievo simulate` writes. Thread: any; one at a time per pool.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "hal/base/result.h"
#include "hal/base/thread_pool.h"
#include "hal/sim/board_scene.h"
#include "hal/sim/head/head_scene.h"
#include "hal/sim/optics/exposure.h"
#include "hal/sim/optics/rig.h"
#include "hal/sim/optics/scene.h"

namespace relievo::hal::sim {

// What is really there, for every pixel of the left picture. For tests and benchmarks
// only: nothing that reconstructs may include this.
struct Truth {
  static constexpr std::uint8_t kSkin = 1;        // face skin, not under hair
  static constexpr std::uint8_t kSeenByBoth = 2;  // in the right picture too, and not hidden
  static constexpr std::uint8_t kNotGrazing = 4;  // both viewing angles below 60 degrees
  int width_px = 0, height_px = 0;
  std::vector<float> depth_mm;  // z in the left camera's frame; NaN: nothing there
  std::vector<std::uint8_t> flags;
  std::size_t at(int x, int y) const { return std::size_t(y) * std::size_t(width_px) + std::size_t(x); }
};

Truth measure_truth(const Scene& scene, const SimRig& rig, ThreadPool& pool);

// "w h z" and a new line, then all depths as float32, then all flags as bytes.
Result<void> write_truth(const std::filesystem::path& file, const Truth& truth);
// Binary PLY, camera frame, mm.
Result<void> write_mesh(const std::filesystem::path& file, const Mesh& mesh);

// Visit: a head that turns, pair by pair.
enum class SceneKind : std::uint8_t { Head, Board, Visit };

// A cast does not move; its eyes are closed, or painted.
enum class Alive : std::uint8_t { Person, CastEyesOpen, CastEyesClosed };

struct SimulationOptions {
  SceneKind scene = SceneKind::Head;
  std::uint32_t seed = 1;  // the person, or the set of board poses
  HeadPose pose;
  BoardPattern board;
  BoardLook board_look;
  int board_poses = 14;
  bool board_in_this_pose = false;  // one pair, of the board in `pose`, instead of many poses by seed
  RigOptions rig;
  SensorOptions sensor;
  bool truth = false;           // heads only: also truth.bin, head.ply
  Alive alive = Alive::Person;  // of a visit
  double drift = 1;  // of a visit: how much the face moves between the pairs; 1: the jaw by up to 0.8 mm
  Result<void> check() const;  // InvalidInput
};

struct PicturePair {
  Picture left, right;
};

PicturePair render_pair(const Scene& scene, const SimRig& rig, const SensorOptions& sensor,
                        std::uint64_t noise_seed, ThreadPool& pool);

// left.png and right.png, something behind left and right.
Result<void> write_pair(const PicturePair& pair, const std::filesystem::path& folder,
                        const std::string& behind = {});
Result<void> make_folder(const std::filesystem::path& folder);  // with the way to it

// Head: left.png right.png rig.yml; board: left_NN.png right_NN.png rig.yml; visit: a folder each for the
// front, 25 and 45 degrees to both sides, and 15 down, `0` to `5`, as of a head. Makes the folder. `threads`
// counts the caller. Errors: InvalidInput, PoorGeometry, IoFailed, MediaFull.
Result<void> render_to_folder(const SimulationOptions& options, const std::filesystem::path& folder,
                              int threads = 2);

}  // namespace relievo::hal::sim
