// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Skin moves in patches of 20 mm: one whose mean lies off between two poses, by more than 0.05 mm and more
// than is usual, has moved, and loses its say in how the skull stands. Head frame. Memory: `scratch`. Thread:
// one caller.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "pipeline/base/stage.h"
#include "pipeline/fuse/pose_registration.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {

inline constexpr double kHeadCentreMm = 95;  // behind the tip of the nose

// How far the skin of one patch lies before that of another pose, in the mean: `a` before `b`, a < b.
struct PatchMean {
  std::size_t patch, a, b;
  double mm;
  double weight;  // 1 / mm^2, as measured
};

class SkinPatches {
 public:
  static constexpr int kAcross = 24;
  static constexpr std::size_t kPatches = std::size_t{kAcross} * kAcross * kAcross, kRegions = kPatches / 8;

  SkinPatches(std::size_t poses, std::pmr::memory_resource* scratch) : poses_(poses), say_(scratch) {}

  static std::size_t at(const Vec3d& in_head);
  // Skin moves in regions of two patches each way.
  static std::size_t region_of(std::size_t patch);
  // How far patches lie off, one standard deviation, robustly.
  struct Usual {
    double off_mm = 0, slid_mm = 0;  // along the normal; along the surface
  };
  static Usual usual(std::span<const PatchMean> means, std::pmr::memory_resource& memory);
  // What a patch counts, as a share of its weight: less where it moved, and the less the better it was
  // measured.
  static double say(const PatchMean& mean, const Usual& usual);
  // Numbers of the same patch where the means tell how far it slid along the surface, `k` 0 or 1.
  static std::size_t sliding(std::size_t patch, std::size_t k) { return patch + (k + 1) * kPatches; }

  void watch() { take({}); }
  bool watched() const { return !say_.empty(); }
  void take(std::span<const PatchMean> means);
  // 1 where nothing was said of a patch.
  double say(std::size_t patch, std::size_t a, std::size_t b) const {
    return double(say_[between(patch, a, b)]);
  }
  // Of a patch of one pose's skin, about where it should be: half of that between two poses.
  double variance_mm2() const { return variance_mm2_; }

 private:
  std::size_t between(std::size_t patch, std::size_t a, std::size_t b) const {
    return (patch * poses_ + std::min(a, b)) * poses_ + std::max(a, b);
  }

  std::size_t poses_;
  std::pmr::vector<float> say_;
  double variance_mm2_ = 0;
};

// What the samples of one pose say against the surfaces of the others: their distance along the normal, what
// it counts, and its derivative by a small motion. Samples lie where a pose was measured, and count by how
// well skin there tells how the skull stands. First pose's frame, millimetres, radians. Memory: `scratch`.
// Thread: reading by any number, changing by one.

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

// How far apart two surfaces may lie to be taken for the same skin, and the scale beyond which a distance
// loses its say; how often the round is made, and how many nodes of a lattice are laid onto the other poses,
// at most.
struct RegistrationRound {
  double reach_mm = 0, scale_mm = 0;
  int times = 0;
  double samples = 18'000;

  // A step, millimetres and radians together, after which the next round brings more.
  double still() const { return 0.01 * scale_mm; }
};
inline constexpr double kFewSamples = 4'500;  // enough to come near

// What one sample of a pose says against another one's surface.
struct PoseResidual {
  double value, weight;
  Vector6 toward;  // derivative by a motion of the sample's pose; of the other one it is the opposite
  Vec3d at;
  std::size_t patch;
};

class PoseResiduals {
 public:
  static constexpr std::size_t kParts = 4;    // of a pose's samples, for the threads
  static constexpr float kLeastTrust = 0.2F;  // of a node that is laid onto another pose's: less is a rim

  // All three outlive it. `placed` is what is solved for.
  PoseResiduals(std::span<const HeadPose> poses, std::span<RegisteredPose> placed, StageContext& context)
      : poses_(poses), placed_(placed), context_(context) {}

  // Middle of the head, about which small motions turn.
  const Vec3d& pivot() const { return pivot_; }
  // To the right and upwards along the skin, unit length.
  std::array<Vec3d, 2> along_skin(const Vec3d& normal) const;
  std::size_t patch_at(const Vec3d& place) const;
  const HeadPose& surface(std::size_t pose) const { return poses_[pose]; }
  SkinPatches& skin() { return skin_; }
  // Surfaces of calibrations that differ lie off everywhere: no scale is narrower than what is usual.
  void set_usual_mm(double mm) { usual_mm_ = mm; }
  void move(std::size_t pose, const Vec3d& rotation, const Vec3d& translation_mm);

  // Sums are made by parts, each by one thread, and put together in their order: the same for any number of
  // threads.
  template <typename Work>
  void for_each_part(std::size_t parts, Work&& work) const {
    context_.pool.for_each(int(parts), int(parts), [&](int i) { work(std::size_t(i)); });
  }

  // Places of a pose that say something of how the skull stands, in every `parts`-th row of those looked at:
  // visit(node, normal, say, residual with its place and patch).
  template <typename Visit>
  void for_each_sample(std::size_t a, double most, Visit&& visit, std::size_t part, std::size_t parts) const {
    const HeadPose& from = poses_[a];
    const int every = std::max(1, int(std::sqrt(double(from.nodes.size()) / most)));
    const RigidTransform& placed = placed_[a].first_from_pose;
    const int step = every * int(parts);
    for (int r = every / 2 + every * int(part); r < from.rows; r += step)
      for (int c = every / 2; c < from.columns; c += every) {
        const std::size_t k = std::size_t(r) * std::size_t(from.columns) + std::size_t(c);
        if (from.nodes[k].trust < kLeastTrust) continue;
        PoseResidual res{};
        res.at = apply(placed, wide(from.nodes[k].at_mm));
        const double say = say_of(res);
        if (say > 0) visit(k, apply(placed.rotation, wide(from.nodes[k].normal)), say, res);
      }
  }

  // What a pose's samples say against all others: visit(pose, other pose, residual).
  template <typename Visit>
  void for_each_residual_of(std::size_t a, std::size_t part, std::size_t parts,
                            const RegistrationRound& round, Visit&& visit) const {
    const auto against_others = [&](std::size_t k, const Vec3d& normal, double say, PoseResidual& res) {
      for (std::size_t b = 0; b < poses_.size(); ++b)
        if (b != a && meet(a, k, normal, b, round, res)) {
          res.weight *= say;
          visit(a, b, res);
        }
    };
    for_each_sample(a, round.samples, against_others, part, parts);
  }

  // Node `k` of pose `a`, with its normal, onto pose `b`. False where that shows nothing near, or the other
  // side of something.
  bool meet(std::size_t a, std::size_t k, const Vec3d& normal, std::size_t b, const RegistrationRound& round,
            PoseResidual& res) const;

  // How far a place stands before what pose `b` measured on its line of sight, if it measured anything there.
  std::optional<double> before_mm(const Vec3d& at, std::size_t b) const;

 private:
  // How much the skin at `res.at` has to say of how the skull stands; sets its patch.
  double say_of(PoseResidual& res) const;

  std::span<const HeadPose> poses_;
  std::span<RegisteredPose> placed_;
  StageContext& context_;
  double usual_mm_ = 0;                                 // distance between the surfaces, in the step before
  SkinPatches skin_{poses_.size(), &context_.scratch};  // watched as soon as the poses lie on each other
  Vec3d pivot_ = apply(inverse(poses_[0].head_from_camera), Vec3d{0, 20, -kHeadCentreMm});
};

// Lays each pose onto those before it: from its own head frame, or, where that leads nowhere, from a head
// turned by up to 65 degrees, the best of all. Where one would stand before skin that another measured, it
// does not lie. One that meets no other is not `joined`. Finds the skin it shares with them. Errors:
// Cancelled.
Result<void> place_poses(std::span<HeadPose> poses, std::span<RegisteredPose> placed,
                         PoseResiduals& residuals, StageContext& context);

// Fills `meets` of the poses, and `residuals`, of what is registered.
void measure_agreement(std::span<const HeadPose> poses, Registration& registration, StageContext& context);

// Where the same skin lies in two poses, by their photographs: shape alone hardly tells whether a head slid
// along its own surface. A window on one surface is found on the other one (Lucas, Kanade 1981), first at
// half the resolution; light that differs evenly does not matter. Thread: any. No memory is allocated.

// Whether a pixel is narrow enough to show skin.
bool shows_skin(const HeadPose& pose, const Vec3d& place_mm);

// Where the other pose's photograph shows what `pose` shows at `place_mm`, each in its own frame. `along`:
// two directions along the surface, unit length, in the frame of `pose`. None where the other does not show
// it, or not alike.
std::optional<Vec3d> same_skin(const HeadPose& pose, const Vec3d& place_mm, const std::array<Vec3d, 2>& along,
                               const HeadPose& other, const RigidTransform& other_from_pose);

}  // namespace relievo::pipeline
