// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "hal/base/statistics.h"
#include "pipeline/base/solving.h"
#include "pipeline/fuse/pose_residuals.h"

namespace relievo::pipeline {
namespace {

constexpr double kFewestMet = 80;
constexpr std::size_t kEveryNode = 16;
constexpr double kPlacingRidge = 1e-9;
constexpr double kSkinSamples = 2'500;
// People lean while they turn: where their own head frames do not tell, a start may be that far off.
constexpr RegistrationRound kFarRound{80, 40, 2, kFewSamples};
constexpr std::array<RegistrationRound, 5> kPlacingRounds{{{25, 12, 8, kFewSamples},
                                                           {12, 6, 6, kFewSamples},
                                                           {6, 2, 6, kFewSamples},
                                                           {3, 0.7, 8, kFewSamples},
                                                           {2, 0.25, 8, kFewSamples}}};
// A cheek lies well on the other one too, but then stands before other skin, where cameras would have seen
// it. Of what both see, so much stands before the other at most: .06 was seen where it was right, .12 and
// more where it was wrong.
constexpr double kBeforeMm = 5;
constexpr double kMostBeforeShare = 0.1;
// So much of what lies near another pose's surface lies on it: at once, and from the best of all starts.
constexpr double kMetMm = 1;
constexpr double kWellMetShare = 0.8, kMetShare = 0.5;
constexpr std::array<Vec2d, 9> kTurnsDeg{
    {{0, 0}, {-25, 0}, {25, 0}, {-45, 0}, {45, 0}, {-65, 0}, {65, 0}, {0, -20}, {0, 20}}};  // yaw, pitch

// A head turned about its middle. Head frame.
RigidTransform turned_by(const Vec2d& turn_deg) {
  constexpr double kRadian = std::numbers::pi / 180;
  const Eigen::Matrix3d r = (Eigen::AngleAxisd(turn_deg.x * kRadian, Eigen::Vector3d::UnitY()) *
                             Eigen::AngleAxisd(turn_deg.y * kRadian, Eigen::Vector3d::UnitX()))
                                .toRotationMatrix();
  RigidTransform turned;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) turned.rotation.m[3 * i + j] = r(i, j);
  const Vec3d middle{0, 20, -kHeadCentreMm}, moved = apply(turned.rotation, middle);
  turned.translation_mm = minus(middle, moved);
  return turned;
}

class Placer {
 public:
  Placer(std::span<HeadPose> poses, std::span<RegisteredPose> placed, PoseResiduals& residuals,
         StageContext& context)
      : poses_(poses), placed_(placed), residuals_(residuals), context_(context) {
    known_[0] = 1;
    for (std::size_t p = 1; p < poses.size(); ++p)
      if (const auto& laid = poses[p].first_from_pose) {
        placed[p].first_from_pose = *laid;
        known_[p] = 1;
      }
  }

  Result<void> place_all() {
    std::pmr::vector<std::size_t> left(&context_.scratch);
    for (std::size_t p = 1; p < poses_.size(); ++p)
      if (known_[p] == 0) left.push_back(p);
    for (const auto& [anywhere, least_share] : {std::pair{false, kWellMetShare}, {true, kMetShare}})
      for (bool more = true; more;) {
        more = false;
        for (std::size_t i = 0; i < left.size(); ++i) {
          if (context_.stop()) return stopped();
          if (!place(left[i], anywhere, least_share)) continue;
          left.erase(left.begin() + std::ptrdiff_t(i--));
          more = true;
        }
      }
    for (const std::size_t p : left) {
      placed_[p] = {};
      placed_[p].joined = false;
    }
    return {};
  }

  // Onto the known ones; false where that leads nowhere.
  bool place(std::size_t p, bool anywhere, double least_share) {
    const Laid laid = anywhere ? lay_from_anywhere(p) : lay_from_head(p);
    if (laid.count < kFewestMet || laid.share < least_share) return false;
    placed_[p].first_from_pose = laid.placed;
    find_shared_skin(p);
    known_[p] = 1;
    return true;
  }

 private:
  struct Laid {
    RigidTransform placed;
    double count = 0;  // of samples on another pose's surface, each by its say
    double share = 0;  // of those near one
  };
  struct Sum {
    Matrix6 normal = Matrix6::Zero();
    Vector6 right = Vector6::Zero();
    double near = 0, count = 0;
  };

  Laid lay_from_head(std::size_t p) {
    if (!poses_[p].has_head) return {};
    return lay(p, product(inverse(poses_[0].head_from_camera), poses_[p].head_from_camera));
  }
  // As if the head had turned before the same cameras; and where that is not it, as if other cameras had seen
  // it, the middles of both surfaces on each other.
  Laid lay_from_anywhere(std::size_t p) {
    Laid best = lay_from_head(p);
    const RigidTransform& head = poses_[0].head_from_camera;
    for (const bool other_cameras : {false, true}) {
      if (best.share >= kWellMetShare) break;
      for (const Vec2d& turn : kTurnsDeg) {
        if (context_.stop()) break;
        RigidTransform start = product(inverse(head), product(turned_by(turn), head));
        if (other_cameras) start.translation_mm = minus(middle_of(0), apply(start.rotation, middle_of(p)));
        placed_[p].first_from_pose = start;
        if (!come_nearer(p, kFarRound)) continue;
        const Laid laid = lay(p, placed_[p].first_from_pose);
        if (laid.count * laid.share > best.count * best.share) best = laid;
      }
    }
    return best;
  }
  // Of what a pose shows, its own frame.
  Vec3d middle_of(std::size_t p) const {
    const HeadPose& pose = poses_[p];
    Vec3d middle;
    for (double Vec3d::*axis : {&Vec3d::x, &Vec3d::y, &Vec3d::z}) {
      std::pmr::vector<double> values(&context_.scratch);
      for (std::size_t k = 0; k < pose.nodes.size(); k += kEveryNode)
        if (pose.nodes[k].trust > 0) values.push_back(wide(pose.nodes[k].at_mm).*axis);
      middle.*axis = values.empty() ? 0 : median(values);
    }
    return middle;
  }

  // One pose onto the known ones, which stay.
  Laid lay(std::size_t p, const RigidTransform& start) {
    placed_[p].first_from_pose = start;
    std::optional<Sum> sum;
    for (const RegistrationRound& round : kPlacingRounds)
      if (sum = come_nearer(p, round); !sum) return {};
    if (stands_before_others(p)) return {};
    return {placed_[p].first_from_pose, sum->count, sum->count / sum->near};
  }

  // By Gauss-Newton steps. What the last of them saw; none where it saw too little.
  std::optional<Sum> come_nearer(std::size_t p, const RegistrationRound& round) {
    Sum sum;
    for (int k = 0; k < round.times; ++k) {
      sum = against_known(p, round);
      if (sum.near < kFewestMet) return std::nullopt;
      sum.normal += kPlacingRidge * Matrix6::Identity();
      const Vector6 step = -solved<6>(sum.normal, sum.right);
      residuals_.move(p, {step[0], step[1], step[2]}, {step[3], step[4], step[5]});
      if (step.norm() <= round.still()) break;
    }
    return sum;
  }

  // A pose before the known ones, or they before it.
  bool stands_before_others(std::size_t p) const {
    std::array<int, 2> seen{}, before{};
    for (std::size_t b = 0; b < poses_.size(); ++b)
      if (known_[b] != 0 && b != p)
        for (const bool back : {false, true})
          residuals_.for_each_sample(
              back ? b : p, kFewSamples,
              [&](std::size_t, const Vec3d&, double, const PoseResidual& res) {
                const auto mm = residuals_.before_mm(res.at, back ? p : b);
                seen[back] += mm ? 1 : 0;
                before[back] += mm && *mm > kBeforeMm ? 1 : 0;
              },
              0, 1);
    return before[0] > kMostBeforeShare * seen[0] || before[1] > kMostBeforeShare * seen[1];
  }

  // What the known ones show of the skin of this one.
  void find_shared_skin(std::size_t p) {
    SharedArena memory(context_.scratch);
    std::pmr::vector<std::pmr::vector<SharedSkin>> parts(poses_.size() * PoseResiduals::kParts, &memory);
    residuals_.for_each_part(parts.size(), [&](std::size_t i) {
      const std::size_t b = i / PoseResiduals::kParts;
      if (known_[b] == 0) return;
      const HeadPose& surface = poses_[b];
      const RigidTransform& placed = placed_[b].first_from_pose;
      const Rotation back = transposed(placed.rotation);
      const RigidTransform here_from_there = product(inverse(placed_[p].first_from_pose), placed);
      const auto look = [&](std::size_t node, const Vec3d& normal, double, const PoseResidual&) {
        const Vec3d place = wide(surface.nodes[node].at_mm);
        if (!shows_skin(surface, place) || context_.stop()) return;
        const auto [right, up] = residuals_.along_skin(normal);
        if (const auto here =
                same_skin(surface, place, {apply(back, right), apply(back, up)}, poses_[p], here_from_there))
          parts[i].push_back({std::uint32_t(b), std::uint32_t(node), narrow(*here)});
      };
      residuals_.for_each_sample(b, kSkinSamples, look, i % PoseResiduals::kParts, PoseResiduals::kParts);
    });
    std::size_t count = 0;
    for (const auto& part : parts) count += part.size();
    std::pmr::vector<SharedSkin>& all = poses_[p].shared_skin;
    all.clear();
    all.reserve(count);
    for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  }

  Sum against_known(std::size_t p, const RegistrationRound& round) const {
    std::array<Sum, PoseResiduals::kParts> parts;
    residuals_.for_each_part(parts.size(), [&](std::size_t i) {
      Sum& sum = parts[i];
      const auto visit = [&](std::size_t node, const Vec3d& n, double say, PoseResidual& res) {
        for (std::size_t b = 0; b < poses_.size(); ++b) {
          if (known_[b] == 0 || b == p || !residuals_.meet(p, node, n, b, round, res)) continue;
          sum.normal += say * res.weight * res.toward * res.toward.transpose();
          sum.right += say * res.weight * res.value * res.toward;
          sum.near += say;
          sum.count += std::abs(res.value) < kMetMm ? say : 0;
        }
      };
      residuals_.for_each_sample(p, round.samples, visit, i, parts.size());
    });
    Sum all;
    for (const Sum& part : parts) {
      all.normal += part.normal;
      all.right += part.right;
      all.near += part.near;
      all.count += part.count;
    }
    return all;
  }

  std::span<HeadPose> poses_;
  std::span<RegisteredPose> placed_;
  PoseResiduals& residuals_;
  StageContext& context_;
  // Poses that others are laid onto.
  std::pmr::vector<std::uint8_t> known_{poses_.size(), 0, &context_.scratch};
};

}  // namespace

Result<void> place_poses(std::span<HeadPose> poses, std::span<RegisteredPose> placed,
                         PoseResiduals& residuals, StageContext& context) {
  return Placer(poses, placed, residuals, context).place_all();
}

void place_last_pose(std::span<HeadPose> poses, StageContext& context) {
  if (poses.size() < 2 || !poses[0].has_head) return;
  std::pmr::vector<RegisteredPose> placed(poses.size(), &context.scratch);
  PoseResiduals residuals(poses, placed, context);
  if (Placer(poses, placed, residuals, context).place(poses.size() - 1, true, kWellMetShare))
    poses.back().first_from_pose = placed.back().first_from_pose;
}

}  // namespace relievo::pipeline
